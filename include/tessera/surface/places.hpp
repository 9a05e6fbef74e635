// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/triangle_surface.hpp"

namespace tessera::surface {

/// @brief What keeps triangles from bounding a body.
enum class PlaceKind : int {
  open_edge,     ///< It has one triangle.
  crowded_edge,  ///< It has more than two.
  crossing,      ///< Two triangles cut each other there.
};
[[nodiscard]] constexpr PlaceKind last_value(PlaceKind /*type*/) { return PlaceKind::crossing; }
inline constexpr std::size_t kNumPlaceKinds = static_cast<std::size_t>(last_value(PlaceKind{})) + 1;

/// @brief For people: "edges with one triangle" and the like. Local.
[[nodiscard]] std::string words_of(PlaceKind kind);

/// @brief One such place; of a crossing both ends are one point.
struct Place {
  PlaceKind kind = PlaceKind::open_edge;
  Vec3 from{};
  Vec3 to{};

  static auto fields(auto& self) { return std::tie(self.kind, self.from, self.to); }
  [[nodiscard]] Vec3 middle() const { return midpoint(from, to); }
};

/// @brief The triangles of a file and where they bound no body. File length unit.
struct SurfacePlaces {
  std::vector<double> vertex_xyz{};             ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> triangle_vertices{};  ///< Shape (num_triangles, 3).
  /// Shape (num_triangles, kNumPlaceKinds): how many places of each kind are at a triangle.
  std::vector<std::int32_t> triangle_counts{};
  std::vector<Place> places{};  ///< By kind; edges by their vertices, crossings by their triangles.

  static auto fields(auto& self)
  {
    return std::tie(self.vertex_xyz, self.triangle_vertices, self.triangle_counts, self.places);
  }
  /// @throws InputError if sizes do not match, or an index or a count is out of range.
  void require_sound() const;
  [[nodiscard]] std::size_t num_triangles() const { return triangle_vertices.size() / 3; }
  [[nodiscard]] std::size_t count(PlaceKind kind) const;
};

/// @brief Finds them. Local.
/// @param[in] surface Of model::welded_surface().
[[nodiscard]] SurfacePlaces find_places(const model::TriangleSurface& surface);

}  // namespace tessera::surface

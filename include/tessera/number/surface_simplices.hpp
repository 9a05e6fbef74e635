// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/host_layout.hpp"

/// Ids for pieces that are split further. A piece numbers the points of each vertex, edge and
/// triangle of its surface that no lower piece has. The counts are closed forms, so the ids are
/// known before the pieces are split.
namespace tessera::number {

/// @brief The vertices, edges and triangles that a piece may share with others, by the names of
/// their vertices. All lists ascend, and so do the names of an edge or triangle.
struct SurfaceSimplices {
  std::vector<mesh::HostPoint> vertices{};
  std::vector<std::array<mesh::HostPoint, 2>> edges{};
  std::vector<std::array<mesh::HostPoint, 3>> triangles{};

  static auto fields(auto& self) { return std::tie(self.vertices, self.edges, self.triangles); }

  /// @brief Number of points with `n` intervals an edge. They are numbered in the order of the
  /// lists: vertices, then those inside edges, then those inside triangles.
  [[nodiscard]] GlobalIndex num_points(LocalIndex n) const;
};

/// @brief What one piece says of its surface.
struct SurfaceList {
  LocalIndex subdomain = kNoIndex;
  LocalIndex material = 0;
  SurfaceSimplices simplices{};

  static auto fields(auto& self) { return std::tie(self.subdomain, self.material, self.simplices); }
};

/// @brief What the lists of its neighbours say of a piece's surface.
struct SharedSurface {
  SurfaceSimplices owned{};  ///< Those that no lower piece has.
  // Whether two pieces of one material have it; one entry for each of the piece's own.
  std::vector<char> vertex_on_seam{};
  std::vector<char> edge_on_seam{};
  std::vector<char> triangle_on_seam{};

  static auto fields(auto& self)
  {
    return std::tie(self.owned, self.vertex_on_seam, self.edge_on_seam, self.triangle_on_seam);
  }
};

/// @brief Compares a piece's list with those of all pieces that may share a vertex with it. Local;
/// linear in the lists.
[[nodiscard]] SharedSurface compare_surfaces(const SurfaceList& own,
                                             std::span<const SurfaceList> neighbours);

/// @brief What a piece owns.
struct OwnedSurface {
  LocalIndex subdomain = kNoIndex;
  SurfaceSimplices simplices{};
};

/// @brief Who numbers the points of a simplex: point i of it is number `first` + i of those that
/// `owner` owns.
struct SimplexPlace {
  LocalIndex owner = kNoIndex;
  LocalIndex first = 0;

  static auto fields(auto& self) { return std::tie(self.owner, self.first); }

  friend bool operator==(const SimplexPlace&, const SimplexPlace&) = default;
};

/// @brief The places of a piece's surface; shapes as those of its SurfaceSimplices.
struct SurfacePlaces {
  std::vector<SimplexPlace> vertices{};
  std::vector<SimplexPlace> edges{};
  std::vector<SimplexPlace> triangles{};

  static auto fields(auto& self) { return std::tie(self.vertices, self.edges, self.triangles); }
};

/// @brief Finds the owner of every simplex. @param[in] owners What the piece itself and its lower
/// neighbours own. @param[in] n Intervals of an edge.
/// @throws MeshError if nobody owns one. @note Local; O(m log m).
[[nodiscard]] SurfacePlaces place_surface(const SurfaceSimplices& own,
                                          std::span<const OwnedSurface> owners, LocalIndex n);

/// @brief The same of any simplices; those that none of the owners has get no owner.
[[nodiscard]] SurfacePlaces find_places(const SurfaceSimplices& simplices,
                                        std::span<const OwnedSurface> owners, LocalIndex n);

}  // namespace tessera::number

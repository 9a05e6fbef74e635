// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::pipeline {

/// @brief A number for each triangle, by what it means.
using CellValues = std::map<std::string, std::vector<std::uint32_t>>;

/// @brief A surface of triangles to be turned in a page.
struct Surface {
  /// In a page there is room for so many; above, it would have more than 8 MB.
  static constexpr GlobalIndex kMostTriangles = 300'000;

  std::vector<double> point_xyz{};    ///< Shape (num_points, 3).
  std::vector<LocalIndex> corners{};  ///< Shape (num_triangles, 3), seen from outside.
  /// "face" (patch of a mesh, row of a model's faces), "subdomain", "quality" (quality_byte() of
  /// the tet behind), whatever is there.
  CellValues cells{};
  std::vector<double>
      line_xyz{};          ///< Shape (num_lines, 2, 3); lines of its own, inside of its box.
  bool is_coarse = false;  ///< Coarse triangles stand for those of the mesh.

  [[nodiscard]] std::size_t num_triangles() const { return corners.size() / 3; }
};

/// @brief A mean ratio in steps of 1/250; kUnknownQuality stands for one that is not known.
[[nodiscard]] std::uint8_t quality_byte(double mean_ratio);
inline constexpr std::uint8_t kUnknownQuality = 255;

/// @brief What one boundary file has of a surface.
struct SurfacePart {
  LocalIndex number = 0;                 ///< Of the file.
  std::vector<GlobalIndex> point_ids{};  ///< Points of two parts with one id are one.
  std::vector<double> point_xyz{};
  std::vector<LocalIndex> corners{};
  CellValues cells{};  ///< As of Surface.

  static auto fields(auto& self)
  {
    return std::tie(self.number, self.point_ids, self.point_xyz, self.corners, self.cells);
  }
};

/// @brief The triangles of a boundary file; of second order four for each. Local.
/// @param[in] tets Of the same piece, for the quality of the tets behind; nullptr: not known.
[[nodiscard]] SurfacePart surface_part(LocalIndex number, const mesh::MeshArrays& boundary,
                                       const mesh::MeshArrays* tets);

/// @brief One surface of all parts, whatever their order. Local.
[[nodiscard]] Surface joined(std::vector<SurfacePart> parts);

/// @brief The coarse triangles around pieces that were made, and between their materials; the
/// quality is the average of the piece. Local.
[[nodiscard]] Surface coarse_surface(const subdomain::PartitionedMesh& cut,
                                     const std::vector<subdomain::PieceSummary>& pieces);

}  // namespace tessera::pipeline

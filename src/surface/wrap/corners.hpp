// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/surface/patch_surface.hpp"

#include "surface/wrap/lattice.hpp"

namespace tessera::surface {

/// @brief The triangles of a file, to be looked for.
struct FileTriangles {
  explicit FileTriangles(std::vector<std::array<Vec3, 3>> of_file)
      : triangles(std::move(of_file)), search(triangles)
  {
  }
  std::vector<std::array<Vec3, 3>> triangles;
  model::TriangleSearch search;

  [[nodiscard]] double distance(const Vec3& point) const
  {
    return norm(search.nearest(point).xyz - point);
  }
};

/// @brief Where the corner in a cell of a boundary may be, best place first.
struct CornerPlaces {
  Vec3 sharp{};   ///< Where the planes of the triangles meet: on edges and corners of the file.
  Vec3 smooth{};  ///< The point of the file that is nearest to the next one.
  Vec3 mean{};    ///< Of where the boundary goes through the edges of the cell; in the cell.
  Vec3 middle{};  ///< Of the cell.
};

/// @brief These places for each cell. Where no triangle is as near as half of `spacing`, the first
/// three are one. Local.
[[nodiscard]] std::vector<CornerPlaces> corner_places(const LatticeBoundary& boundary,
                                                      double spacing, const FileTriangles& file);

/// @brief The squares of a boundary as triangles that cut each other nowhere and look where the
/// squares do. Each corner is at the first of its places at which nothing is wrong; with all of
/// them in the middles of their cells nothing can be. Local.
/// @return One patch without curves.
[[nodiscard]] PatchSurface sound_triangles(const LatticeBoundary& boundary, double spacing,
                                           const std::vector<CornerPlaces>& places,
                                           const FileTriangles& file);

/// @brief The same with edges flipped that cut an edge of the file short, where the flipped ones
/// are nearer to it. Local.
[[nodiscard]] PatchSurface flipped_to_file(const PatchSurface& surface, double spacing,
                                           const FileTriangles& file);

}  // namespace tessera::surface

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "tessera/base/types.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::pipeline {

/// @brief The flat triangles that stand for a boundary cell, as rows of its points: of second order
/// one at each corner, and the one between the nodes of the sides. Local.
[[nodiscard]] inline std::span<const std::array<std::size_t, 3>> flat_parts(
    const mesh::MeshArrays& boundary)
{
  static constexpr std::array<std::array<std::size_t, 3>, 4> kParts{
      {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  static constexpr std::array<std::array<std::size_t, 3>, 1> kWhole{{{0, 1, 2}}};
  if (boundary.vertices_per_cell == 6) return kParts;
  return kWhole;
}

/// @brief Calls `use(cell, points)` for each flat triangle of a boundary. Local.
template <class Use>
void for_each_flat_triangle(const mesh::MeshArrays& boundary, const Use& use)
{
  const auto width = static_cast<std::size_t>(boundary.vertices_per_cell);
  const auto parts = flat_parts(boundary);
  for (std::size_t cell = 0; cell < static_cast<std::size_t>(boundary.num_cells()); ++cell) {
    const LocalIndex* const v = &boundary.cell_points[width * cell];
    for (const auto& [a, b, c] : parts) use(cell, std::array<LocalIndex, 3>{v[a], v[b], v[c]});
  }
}

}  // namespace tessera::pipeline

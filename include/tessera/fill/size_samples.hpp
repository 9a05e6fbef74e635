// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/fill/kernel.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"

namespace tessera::fill {

/// @brief The size field of the split coarse edges: at every vertex the mean length of what the
/// edges that meet there are split into. Shape (num_vertices), output length unit; 0 at unused
/// vertices. Local.
[[nodiscard]] std::vector<double> vertex_sizes(const mesh::CoarseMesh& coarse,
                                               const mesh::EdgeLevels& levels);

/// @brief Puts the background size into a fill: samples about one wanted edge apart in every coarse
/// tet of the subdomain. Each has the interpolated vertex size.
///
/// Without it NETGEN grows the tets inside a skin by grading alone. Then the result depends on how
/// many skins there are: 11.8 k tets with 1 and 38.1 k with 32 (circle_on_cube, 2 levels). Sizes
/// are interpolated because NETGEN takes the smallest of neighbouring samples. With one size a tet
/// the smallest tets around would decide everywhere.
/// @param[in] vertex_size vertex_sizes() of the mesh.
/// @param[in] tets The coarse tets of the subdomain.
/// @note Local.
void add_size_samples(const mesh::CoarseMesh& coarse, std::span<const LocalIndex> tets,
                      std::span<const double> vertex_size, const mesh::EdgeLevels& levels,
                      FillInput& input);

}  // namespace tessera::fill

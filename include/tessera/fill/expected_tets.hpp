// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::fill {

/// @brief How many tets NETGEN will make of a subdomain whose background size is that of
/// add_size_samples(): so many a cube of that size, and some more along the skin. Local.
///
/// A weight of decompose::predicted_fine_tets() balances subdomains; this foretells their number:
/// with a size that varies inside a coarse tet, its smaller end decides. On bracket, core, torus,
/// blocks and shaft (L = 2, 72 subdomains) it was 0.95 to 1.13 of the truth for the whole mesh,
/// with a relative standard deviation of 5 % to 11 % between the subdomains of one mesh; on torus
/// about 0.89, 1.04 and 0.95 with 0, 1 and 2 levels.
/// @param[in] tets The coarse tets of the subdomain.
/// @param[in] num_skin_triangles Coarse triangles of its skin.
/// @param[in] vertex_size vertex_sizes().
[[nodiscard]] double expected_tets(const mesh::CoarseMesh& coarse, std::span<const LocalIndex> tets,
                                   LocalIndex num_skin_triangles,
                                   const std::vector<double>& vertex_size, int levels);

}  // namespace tessera::fill

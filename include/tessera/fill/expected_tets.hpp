// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::fill {

/// @brief How many tets NETGEN will make of a subdomain whose background size is that of
/// add_size_samples(): the integral of 1 / size^3, times a measured factor. Local.
///
/// A weight of decompose::predicted_fine_tets() balances subdomains; this foretells their number:
/// with a size that varies inside a coarse tet, its smaller end decides. On bracket, core, torus,
/// blocks and shaft (L = 2, 72 subdomains) it was 0.95 to 1.10 of the truth for the whole mesh,
/// with a relative standard deviation of 5 % to 12 % between the subdomains of one mesh.
/// @param[in] tets The coarse tets of the subdomain. @param[in] vertex_size vertex_sizes().
[[nodiscard]] double expected_tets(const mesh::CoarseMesh& coarse, std::span<const LocalIndex> tets,
                                   const std::vector<double>& vertex_size, int levels);

}  // namespace tessera::fill

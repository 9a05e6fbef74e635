// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/decomposition.hpp"

namespace tessera::mesh {

/// @brief The coarse tets of every subdomain, in CSR form.
struct SubdomainTets {
  std::vector<LocalIndex> offsets{};  ///< Shape (num_subdomains + 1).
  std::vector<LocalIndex> tets{};     ///< Shape (num_tets); ascending in each subdomain.

  [[nodiscard]] std::span<const LocalIndex> of(LocalIndex subdomain) const
  {
    const auto first = at(offsets[at(subdomain)]);
    return std::span(tets).subspan(first, at(offsets[at(subdomain) + 1]) - first);
  }
};

/// @brief Inverts Decomposition::tet_subdomain. Local; linear.
[[nodiscard]] SubdomainTets subdomain_tets(const Decomposition& decomposition);

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/subdomain_tets.hpp"

#include <numeric>

namespace tessera::mesh {

SubdomainTets subdomain_tets(const Decomposition& decomposition)
{
  const auto& subdomain_of = decomposition.tet_subdomain;
  SubdomainTets result;
  result.offsets.assign(at(decomposition.num_subdomains()) + 1, 0);
  for (const LocalIndex s : subdomain_of) ++result.offsets[at(s) + 1];
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  std::vector<LocalIndex> next(result.offsets.begin(), result.offsets.end() - 1);
  result.tets.resize(subdomain_of.size());
  for (std::size_t t = 0; t < subdomain_of.size(); ++t) {
    result.tets[at(next[at(subdomain_of[t])]++)] = static_cast<LocalIndex>(t);
  }
  return result;
}

}  // namespace tessera::mesh

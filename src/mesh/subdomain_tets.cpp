// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/subdomain_tets.hpp"

namespace tessera::mesh {

IndexLists subdomain_tets(const Decomposition& decomposition)
{
  return rows_by_key(decomposition.tet_subdomain, decomposition.num_subdomains());
}

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#include "check/components.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "tessera/base/union_find.hpp"

namespace tessera::check {
namespace {

LocalIndex row_of(const std::vector<GlobalIndex>& names, GlobalIndex name)
{
  return static_cast<LocalIndex>(std::lower_bound(names.begin(), names.end(), name)
                                 - names.begin());
}

// By how many components fewer there are with the links than without.
GlobalIndex count_joins(const std::vector<Link>& links)
{
  std::vector<GlobalIndex> names;
  for (const Link& link : links) names.insert(names.end(), {link.first, link.second});
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());

  UnionFind sets(static_cast<LocalIndex>(names.size()));
  GlobalIndex num_joins = 0;
  for (const Link& link : links)
    if (sets.join(row_of(names, link.first), row_of(names, link.second))) ++num_joins;
  return num_joins;
}

}  // namespace

void sort_unique(std::vector<Link>& links)
{
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  links.shrink_to_fit();
}

GlobalIndex count_components(GlobalIndex num_local_components, std::vector<Link> links,
                             const comm::Communicator& comm)
{
  sort_unique(links);
  std::vector<Link> all = comm.all_gather_rows(links);
  sort_unique(all);
  return comm.sum(num_local_components) - count_joins(all);
}

}  // namespace tessera::check

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/worst_tets.hpp"

#include <algorithm>

#include "tessera/base/error.hpp"

namespace tessera::quality {

void WorstTets::add(const WorstTet& tet)
{
  const auto rank = [](const WorstTet& one) { return std::tie(one.mean_ratio, one.subdomain); };
  const auto is_worse = [&](const WorstTet& a, const WorstTet& b) { return rank(a) < rank(b); };
  tets_.insert(std::ranges::upper_bound(tets_, tet, is_worse), tet);
  if (tets_.size() > kMost) tets_.pop_back();
}

void WorstTets::add(const WorstTets& other)
{
  for (const WorstTet& tet : other.tets_) add(tet);
}

void WorstTets::require_sound() const
{
  if (tets_.size() > kMost) throw InputError("a list of worst tets is too long");
}

}  // namespace tessera::quality

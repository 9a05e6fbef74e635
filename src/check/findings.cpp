// SPDX-License-Identifier: BSD-3-Clause
#include "check/findings.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace tessera::check {

void Findings::keep(Entry& entry, Finding finding)
{
  const auto at = std::upper_bound(entry.kept.begin(), entry.kept.end(), finding);
  entry.kept.insert(at, std::move(finding));
  if (entry.kept.size() > kNumKept) entry.kept.pop_back();
}

void Findings::merge(Entry& into, const Entry& from)
{
  into.count += from.count;
  for (const Finding& finding : from.kept) keep(into, finding);
}

void Findings::merge(const Findings& other, std::span<const Kind> kinds)
{
  for (const Kind kind : kinds) {
    const auto k = static_cast<std::size_t>(kind);
    merge(entries_[k], other.entries_[k]);
  }
}

void Findings::merge(const Findings& other)
{
  for (std::size_t k = 0; k < kNumKinds; ++k) merge(entries_[k], other.entries_[k]);
}

std::vector<Defect> Findings::to_defects() const
{
  std::vector<Defect> defects;
  for (std::size_t k = 0; k < kNumKinds; ++k) {
    const Entry& entry = entries_[k];
    if (entry.count == 0) continue;
    Defect& defect =
        defects.emplace_back(Defect{std::string(word_of(static_cast<Kind>(k))), entry.count, {}});
    for (const Finding& finding : entry.kept) defect.offenders.push_back(finding.text);
  }
  return defects;
}

std::string to_text(std::span<const double, 3> position)
{
  return fmt::format("({:.17g})", fmt::join(position, ", "));
}

}  // namespace tessera::check

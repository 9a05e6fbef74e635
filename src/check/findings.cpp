// SPDX-License-Identifier: BSD-3-Clause
#include "check/findings.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

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

Bytes Findings::to_bytes() const
{
  ByteWriter writer;
  for (const Entry& entry : entries_) {
    writer.put(entry.count);
    writer.put(static_cast<std::uint64_t>(entry.kept.size()));
    for (const Finding& finding : entry.kept) {
      writer.put(finding.place);
      writer.put(finding.text);
    }
  }
  return std::move(writer).take();
}

Findings Findings::from_bytes(std::span<const std::byte> bytes)
{
  Findings findings;
  ByteReader reader(bytes);
  for (Entry& entry : findings.entries_) {
    entry.count = reader.get<GlobalIndex>();
    const auto num_kept = reader.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < num_kept; ++i) {
      const auto place = reader.get<Place>();
      entry.kept.push_back({place, reader.get_string()});
    }
  }
  return findings;
}

std::string to_text(std::span<const double, 3> position)
{
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "(%.17g, %.17g, %.17g)", position[0], position[1],
                position[2]);
  return text.data();
}

}  // namespace tessera::check

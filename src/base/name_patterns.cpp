// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/name_patterns.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fnmatch.h>

#include "tessera/base/edit_distance.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"

namespace tessera {

std::string nearest_first(const std::string& pattern, std::span<const std::string> names)
{
  constexpr std::size_t kMost = 12;
  std::vector<std::string> sorted(names.begin(), names.end());
  sort_unique(sorted);
  std::ranges::stable_sort(sorted, {},
                           [&](const std::string& name) { return edit_distance(pattern, name); });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), kMost); ++i) {
    text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", sorted[i]);
  }
  if (sorted.size() > kMost) text += fmt::format(" and {} more", sorted.size() - kMost);
  return text;
}

bool matches_pattern(const std::string& pattern, const std::string& name)
{
  return name == pattern || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::vector<bool> matching_names(std::string_view kind, const std::string& pattern,
                                 std::span<const std::string> names)
{
  std::vector<bool> matches;
  for (const std::string& name : names) {
    matches.push_back(matches_pattern(pattern, name));
  }
  if (std::ranges::find(matches, true) != matches.end()) return matches;
  throw ConfigError(fmt::format("{} = \"{}\": the model has no such {}; it has {}", kind, pattern,
                                kind, nearest_first(pattern, names)));
}

std::vector<LocalIndex> matching_solids(const std::string& pattern,
                                        std::span<const std::string> names)
{
  std::vector<LocalIndex> solids;
  for (std::size_t m = 0; m < names.size(); ++m) {
    const std::string number = std::to_string(m + 1);
    if (matches_pattern(pattern, number) || matches_pattern(pattern, names[m])) {
      solids.push_back(static_cast<LocalIndex>(m) + 1);
    }
  }
  if (!solids.empty()) return solids;
  throw ConfigError(fmt::format("no solid is or fits \"{}\"; there are {}, numbered from 1 to {}",
                                pattern, nearest_first(pattern, names), names.size()));
}

}  // namespace tessera

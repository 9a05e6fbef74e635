// SPDX-License-Identifier: BSD-3-Clause
#include "formats/labels.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>

#include "formats/plain_name.hpp"

namespace tessera::formats {
namespace {

constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::string_view kOthers = "0123456789_-";

bool is_one_of(std::string_view characters, char c)
{
  return characters.find(c) != std::string_view::npos;
}

// Not as std::toupper, which asks the locale.
char label_character(char c)
{
  if (c >= 'a' && c <= 'z') return static_cast<char>(c - 'a' + 'A');
  const bool is_allowed = is_one_of(kLetters, c) || is_one_of(kOthers, c);
  return is_allowed ? c : '_';
}

}  // namespace

std::vector<std::string> labels_of(const std::vector<std::string>& names,
                                   const std::vector<std::string>& reserved, std::size_t longest)
{
  std::set<std::string> taken(reserved.begin(), reserved.end());
  std::vector<std::string> labels;
  for (const std::string& name : names) {
    std::string start = name;
    std::ranges::transform(start, start.begin(), label_character);
    if (start.empty() || !is_one_of(kLetters, start.front())) start.insert(0, "X_");
    labels.push_back(unique_name(start, std::identity{}, taken, longest));
  }
  return labels;
}

}  // namespace tessera::formats

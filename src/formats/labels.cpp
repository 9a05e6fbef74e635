// SPDX-License-Identifier: BSD-3-Clause
#include "formats/labels.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

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
  std::vector<std::string> labels;
  const auto is_taken = [&](const std::string& label) {
    return std::ranges::find(labels, label) != labels.end()
           || std::ranges::find(reserved, label) != reserved.end();
  };
  for (const std::string& name : names) {
    std::string start = name;
    std::ranges::transform(start, start.begin(), label_character);
    if (start.empty() || !is_one_of(kLetters, start.front())) start.insert(0, "X_");
    start.resize(std::min(start.size(), longest));
    std::string label = start;
    for (int number = 2; is_taken(label); ++number) {
      const std::string suffix = fmt::format("_{}", number);
      label = start.substr(0, longest - suffix.size()) + suffix;
    }
    labels.push_back(label);
  }
  return labels;
}

std::string one_line(std::string text)
{
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, '_');
  return text;
}

}  // namespace tessera::formats

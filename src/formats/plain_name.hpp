// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace tessera::formats {

/// @brief A name for one line of a text file: control characters, and those that mean something
/// there, become "_". Local.
[[nodiscard]] inline std::string plain_name(std::string name, std::string_view not_allowed = {})
{
  const auto is_bad = [&](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == '\x7f'
           || not_allowed.find(c) != std::string_view::npos;
  };
  std::ranges::replace_if(name, is_bad, '_');
  return name;
}

/// @brief A name that nothing else has: `wanted`, or with "_2", "_3", … behind it. Local.
/// @param[in] key_of What names must differ in, such as their form in lower case.
/// @param[in,out] taken Keys of all names so far.
template <class KeyOf>
[[nodiscard]] std::string unique_name(const std::string& wanted, const KeyOf& key_of,
                                      std::set<std::string>& taken)
{
  std::string name = wanted;
  for (int number = 2; !taken.insert(key_of(name)).second; ++number)
    name = fmt::format("{}_{}", wanted, number);
  return name;
}

}  // namespace tessera::formats

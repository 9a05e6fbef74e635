// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
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

/// @brief Cut to so many bytes, not within a character of UTF-8. Local.
[[nodiscard]] inline std::string shortened(std::string name, std::size_t num_bytes)
{
  if (name.size() <= num_bytes) return name;
  while (num_bytes > 0 && (static_cast<unsigned char>(name[num_bytes]) & 0xC0U) == 0x80U)
    --num_bytes;
  name.resize(num_bytes);
  return name;
}

/// @brief A name that nothing else has: `wanted`, or with "_2", "_3", … behind it. Local.
/// @param[in] key_of What names must differ in, such as their form in lower case.
/// @param[in,out] taken Keys of all names so far.
/// @param[in] longest Bytes of a name at most.
template <class KeyOf>
[[nodiscard]] std::string unique_name(const std::string& wanted, const KeyOf& key_of,
                                      std::set<std::string>& taken,
                                      std::size_t longest = std::string::npos)
{
  std::string name = shortened(wanted, longest);
  for (int number = 2; !taken.insert(key_of(name)).second; ++number) {
    const std::string suffix = fmt::format("_{}", number);
    name = shortened(wanted, longest - suffix.size()) + suffix;
  }
  return name;
}

}  // namespace tessera::formats

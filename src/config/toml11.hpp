// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <istream>
#include <map>
#include <string>

#include <toml.hpp>

/// What differs between toml11 3 (Debian 12) and 4 (Debian 13). Version 3 tells no version.
namespace tessera::config {

#if defined(TOML11_VERSION_MAJOR) && TOML11_VERSION_MAJOR >= 4

struct TomlTypes : toml::type_config {
  using comment_type = toml::discard_comments;
  template <class Key, class Value>
  using table_type = std::map<Key, Value>;
};
using TomlValue = toml::basic_value<TomlTypes>;

[[nodiscard]] inline TomlValue parse_stream(std::istream& stream, const std::string& file_name)
{
  return toml::parse<TomlTypes>(stream, file_name);
}

/// @brief Where a value begins, from 1.
[[nodiscard]] inline std::size_t line_of(const TomlValue& value)
{
  return value.location().first_line_number();
}

[[nodiscard]] inline const std::string& text_of(const TomlValue& value)
{
  return value.as_string();
}

#else

using TomlValue = toml::basic_value<toml::discard_comments, std::map>;

[[nodiscard]] inline TomlValue parse_stream(std::istream& stream, const std::string& file_name)
{
  return toml::parse<toml::discard_comments, std::map>(stream, file_name);
}

[[nodiscard]] inline std::size_t line_of(const TomlValue& value) { return value.location().line(); }

[[nodiscard]] inline const std::string& text_of(const TomlValue& value)
{
  return value.as_string().str;
}

#endif

}  // namespace tessera::config

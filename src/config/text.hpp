// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace tessera::config {

/// @brief The text as a TOML basic string, quotes and escapes included. @pre It is UTF-8.
[[nodiscard]] std::string toml_string(std::string_view text);

/// @brief The shortest TOML float that reads back as the same number. @pre `value` is finite.
[[nodiscard]] std::string number_text(double value);

/// @brief The text with control characters replaced, so that it cannot break a one-line message.
[[nodiscard]] std::string printable(std::string_view text);

/// @brief The text without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

namespace tessera::check {

/// @brief The parts as text, one after the other.
template <class... Parts>
[[nodiscard]] std::string concat(const Parts&... parts)
{
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace tessera::check

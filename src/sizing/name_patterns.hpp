// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::sizing {

/// @brief Of each name whether it is the pattern or matches it, see PatchPattern.
/// @param[in] kind What has the names: "patch" or "material".
/// @throws ConfigError if none does, with the names that there are, nearest first.
[[nodiscard]] std::vector<bool> matching_names(std::string_view kind, const std::string& pattern,
                                               std::span<const std::string> names);

}  // namespace tessera::sizing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera {

/// @brief Whether the name is the pattern, or matches it as one of the shell: `*` stands for any
/// characters, `?` for one, `[ab]` for one of these. Local.
[[nodiscard]] bool matches_pattern(const std::string& pattern, const std::string& name);

/// @brief Some of the names for a message, quoted, those most like the pattern first. Local.
[[nodiscard]] std::string nearest_first(const std::string& pattern,
                                        std::span<const std::string> names);

/// @brief Of each name whether it matches_pattern(). Local.
/// @param[in] kind What has the names: "patch" or "material".
/// @throws ConfigError if none does, with the names that there are, nearest first.
[[nodiscard]] std::vector<bool> matching_names(std::string_view kind, const std::string& pattern,
                                               std::span<const std::string> names);

/// @brief Numbers from 1 of the solids whose number or name is the pattern or matches it,
/// ascending. Local. @param[in] names Of all solids.
/// @throws ConfigError if none does, with the names that there are, nearest first.
[[nodiscard]] std::vector<LocalIndex> matching_solids(const std::string& pattern,
                                                      std::span<const std::string> names);

}  // namespace tessera

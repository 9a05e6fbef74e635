// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tessera::formats {

/// @brief Names as labels of Abaqus and CalculiX: upper-case letters, digits, "_" and "-", a letter
/// first. None twice, and none that is reserved. Local.
/// @param[in] longest Characters of a label at most. @pre longest >= 12
[[nodiscard]] std::vector<std::string> labels_of(const std::vector<std::string>& names,
                                                 const std::vector<std::string>& reserved,
                                                 std::size_t longest);

}  // namespace tessera::formats

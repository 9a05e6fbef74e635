// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace tessera {

/// @brief Least number of characters to insert, delete or replace to turn `a` into `b`. Local.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace tessera

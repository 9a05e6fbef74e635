// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace tessera {

/// @brief Version of this library, e.g. "0.1.0".
[[nodiscard]] std::string_view version() noexcept;

}  // namespace tessera

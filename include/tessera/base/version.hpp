// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace tessera {

/// @brief Version of this library, e.g. "1.2.3".
[[nodiscard]] std::string_view version() noexcept;

/// @brief The version of a library and the layout of the records that it writes, e.g. "1.2.3,
/// records 2": who does not write the same cannot read them.
/// @param[in] library version() of who writes.
[[nodiscard]] std::string record_version(std::string_view library = version());

}  // namespace tessera

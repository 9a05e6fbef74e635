// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace tessera::pipeline {

/// @brief The data in zlib's format. Equal data give equal bytes. Local.
[[nodiscard]] std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& data);

}  // namespace tessera::pipeline

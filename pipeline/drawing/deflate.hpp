// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::pipeline {

/// @brief Compresses bytes into a zlib stream (RFC 1950) of one block with the fixed codes of
/// RFC 1951. Equal bytes give equal streams. Made for pictures with few colours, which become a
/// tenth or less. Local.
[[nodiscard]] std::vector<std::uint8_t> to_zlib(std::span<const std::uint8_t> data);

}  // namespace tessera::pipeline

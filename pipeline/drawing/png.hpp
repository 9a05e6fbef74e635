// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tessera/base/bytes.hpp"

namespace tessera::pipeline {

/// @brief A picture of at most 256 colours, row by row from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::array<std::uint8_t, 3>> palette{};  ///< Red, green, blue.
  std::vector<std::uint8_t> pixels{};                  ///< Shape (height, width); rows of palette.

  [[nodiscard]] std::uint8_t& pixel(int x, int y)
  {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)
                  + static_cast<std::size_t>(x)];
  }
};

/// @brief The picture as a PNG file. Equal pictures give equal bytes. Local.
[[nodiscard]] Bytes to_png(const Picture& picture);

}  // namespace tessera::pipeline

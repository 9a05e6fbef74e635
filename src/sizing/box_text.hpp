// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <fmt/format.h>

#include "tessera/base/box.hpp"

namespace tessera::sizing {

/// @brief "(0, 0, 0) to (1, 2, 3)".
[[nodiscard]] inline std::string box_text(const tessera::Box& box)
{
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", box.low[0], box.low[1],
                     box.low[2], box.high[0], box.high[1], box.high[2]);
}

}  // namespace tessera::sizing

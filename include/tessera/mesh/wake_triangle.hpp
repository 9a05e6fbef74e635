// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief A triangle between two tets of a coarse mesh that goes on from a sharp edge of walls.
struct WakeTriangle {
  std::array<LocalIndex, 3> vertices{};  ///< Of the coarse mesh, ascending.
  LocalIndex wall = kNoIndex;            ///< A patch whose layers go on along it.
};

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::sizing {

/// @brief That a point of a field has a size. @throws InputError
inline void require_size(double size, const Vec3& position)
{
  const bool is_finite = std::ranges::all_of(position, [](double x) { return std::isfinite(x); });
  if (!is_finite) throw InputError("a point of it has no finite coordinates");
  if (size > 0.0 && std::isfinite(size)) return;
  throw InputError(fmt::format("its size at ({:.6g}, {:.6g}, {:.6g}) is {}; sizes must be > 0",
                               position[0], position[1], position[2], size));
}

}  // namespace tessera::sizing

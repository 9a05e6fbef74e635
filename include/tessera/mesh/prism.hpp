// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/vec3.hpp"

namespace tessera::mesh {

/// @brief Whether a prism is positive however it is cut into tets. A corner may be without a
/// column. Local.
/// @param[in] low, high Corners of both ends; `low`, seen from `high`, turns counter-clockwise.
[[nodiscard]] bool is_positive_prism(const std::array<Vec3, 3>& low,
                                     const std::array<Vec3, 3>& high);

/// @brief The same of all parts of a prism, too, when its triangle is refined on any number of
/// levels, and cut in two where one of its sides is finer. Local.
///
/// The volumes of such parts are linear in the column that they stand on, so it is enough to take
/// the columns of the corners.
[[nodiscard]] bool has_positive_parts(const std::array<Vec3, 3>& low,
                                      const std::array<Vec3, 3>& high);

}  // namespace tessera::mesh

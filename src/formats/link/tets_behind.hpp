// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::formats {

/// @brief The tets of a piece behind the faces of its tets. Local; linear in time.
/// @param[in] tet_points Shape (num_tets, 4).
/// @return Shape (num_tets, 4), face c being opposite to corner c; kNoIndex where there is none.
/// @throws InputError if a face is on more than two tets.
[[nodiscard]] std::vector<LocalIndex> tets_behind(LocalIndex num_points,
                                                  const std::vector<LocalIndex>& tet_points);

}  // namespace tessera::formats

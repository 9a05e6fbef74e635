// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "tessera/check/check_mesh.hpp"

namespace tessera::check {

/// @brief How many of the triangles that are open at the end a rank treats at once. What is
/// reported does not depend on it. At least 1 each.
struct CheckLimits {
  /// For each reading of the boundary file: 88 bytes each are held.
  std::uint64_t num_triangles_in_reading = std::uint64_t{1} << 19;
  /// For each exchange: several times as much.
  std::uint64_t num_triangles_in_round = std::uint64_t{1} << 17;
};

/// @brief As the check_mesh() that all call, with limits of one's own. @note Collective.
[[nodiscard]] CheckReport check_mesh(const PieceSource& tets, const PieceSource* boundary,
                                     const comm::Communicator& comm, const CheckOptions& options,
                                     const CheckLimits& limits);

}  // namespace tessera::check

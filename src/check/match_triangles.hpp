// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/comm/communicator.hpp"

#include "check/components.hpp"
#include "check/findings.hpp"
#include "check/records.hpp"

namespace tessera::check {

/// @brief Different triangles among those sent; of this rank's share of the keys.
struct TriangleCounts {
  GlobalIndex num_triangles = 0;
  GlobalIndex num_outside = 0;
  GlobalIndex num_seam = 0;
  GlobalIndex num_interface = 0;
  GlobalIndex num_unlisted = 0;  ///< On one tet, but not in the boundary file.
};

/// @brief What the boundary file must hold: nothing, all triangles on one tet, or, if only some
/// pieces of the mesh were made, nothing but such triangles.
enum class BoundaryFile { kNone, kComplete, kPartial };

struct TriangleMatch {
  std::vector<TriangleRole> roles{};  ///< Parallel to the records sent.
  std::vector<Link> links{};          ///< Components of tets joined across pieces.
  TriangleCounts counts{};
};

/// @brief Brings the sides of each triangle together, and the boundary file's triangles with them.
/// @note Collective.
[[nodiscard]] TriangleMatch match_triangles(std::span<const TriangleRecord> records,
                                            BoundaryFile boundary, const comm::Communicator& comm,
                                            Findings& findings);

}  // namespace tessera::check

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
  GlobalIndex num_unlisted = 0;  ///< Outside, but not in the boundary file.
};

struct TriangleMatch {
  std::vector<TriangleRole> roles{};  ///< Parallel to the records sent.
  std::vector<Link> links{};          ///< Components of tets joined across pieces.
  TriangleCounts counts{};
};

/// @brief Brings the sides of each triangle together, and the boundary file's triangles with them.
/// @note Collective.
/// @param[in] has_boundary Whether there is a boundary file, which must then be complete.
[[nodiscard]] TriangleMatch match_triangles(std::span<const TriangleRecord> records,
                                            bool has_boundary, const comm::Communicator& comm,
                                            Findings& findings);

}  // namespace tessera::check

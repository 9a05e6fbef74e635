// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"

#include "check/findings.hpp"

namespace tessera::check {

/// @brief An id and the lowest piece that has it.
struct PointId {
  GlobalIndex id = 0;
  LocalIndex piece = 0;

  friend auto operator<=>(const PointId&, const PointId&) = default;
};

/// @brief Consecutive ids of one piece. Writers number pieces in ranges, so a mesh has few runs.
struct IdRun {
  GlobalIndex begin = 0;
  GlobalIndex end = 0;
  LocalIndex piece = 0;

  static auto fields(auto& self) { return std::tie(self.begin, self.end, self.piece); }

  friend auto operator<=>(const IdRun&, const IdRun&) = default;
};

/// @brief What the ids are of, and how their defects are called.
struct IdSpace {
  std::string of{};  ///< "point" or "cell".
  Kind twice = Kind::point_id_twice;
  Kind hole = Kind::point_id_hole;
  bool is_dense = true;  ///< Whether a hole is a defect.
};
[[nodiscard]] IdSpace point_id_space(bool is_dense = true);
[[nodiscard]] IdSpace cell_id_space(bool is_dense = true);

/// @brief Appends the ids as runs; ids that are negative or above 2^62 are reported instead. Local.
void append_runs(std::vector<GlobalIndex> ids, LocalIndex piece, const IdSpace& space,
                 std::vector<IdRun>& runs, Findings& findings);

/// @brief Appends ids of any pieces as runs of one piece each. Local.
void append_runs(std::vector<PointId> ids, const IdSpace& space, std::vector<IdRun>& runs,
                 Findings& findings);

/// @brief Reports ids that stand in two runs and, of dense ids, those from 0 to the largest that
/// stand in none.
/// @note Collective; each rank looks at an equal range of ids.
void check_ids(std::span<const IdRun> runs, const IdSpace& space, const comm::Communicator& comm,
               Findings& findings);

}  // namespace tessera::check

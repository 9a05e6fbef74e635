// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "tessera/base/fields.hpp"
#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief On how many levels each coarse edge is split: all on the same number, or each on its own.
///
/// In every coarse tet the levels of the six edges differ by one at most. That is what makes the
/// rules for children local (@see cut_tet()). Triangles and tets have the smallest level of their
/// edges.
class EdgeLevels {
 public:
  /// @brief All edges on the same number of levels. @pre 0 <= levels <= lattice::kMaxLevels.
  EdgeLevels(int levels = 0) noexcept : largest_(levels) {}  // NOLINT(google-explicit-constructor)

  /// @brief Each edge on its own number. If all are the same, this is uniform too.
  /// @param[in] edge_vertices Shape (num_edges, 2); coarse vertices, each row ascending, and the
  /// rows as well.
  /// @param[in] levels Shape (num_edges).
  EdgeLevels(const std::vector<LocalIndex>& edge_vertices, FlatArray<std::int8_t> levels);

  [[nodiscard]] int largest() const { return largest_; }
  [[nodiscard]] bool is_uniform() const { return levels_.empty(); }

  /// @brief Level of the edge between two coarse vertices. Linear in the edges at one of them, or
  /// O(1) if all are the same.
  /// @pre There is such an edge.
  [[nodiscard]] int of(LocalIndex a, LocalIndex b) const;

  /// @brief The same with no edge on more than `most` levels.
  [[nodiscard]] EdgeLevels limited(int most) const;

  /// @brief The same with no edge on less than `least` levels.
  [[nodiscard]] EdgeLevels raised(int least) const;

  /// @brief The same with each edge on `by` levels more, or less if that is negative. @pre The
  /// result has levels that there can be.
  [[nodiscard]] EdgeLevels shifted(int by) const;

  /// @brief Coarse edges by level. Shape (largest() + 1); empty if all are the same.
  [[nodiscard]] std::vector<GlobalIndex> histogram() const;

  /// @throws InputError unless the edges ascend and have levels that there can be, of which the
  /// largest is the largest, and not all are the same.
  void require_sound() const;

  friend bool operator==(const EdgeLevels&, const EdgeLevels&) = default;

 private:
  friend FieldAccess;

  static auto fields(auto& self)
  {
    return std::tie(self.largest_, self.first_edge_, self.upper_vertex_, self.levels_);
  }

  void find_largest();

  template <class Change>
  [[nodiscard]] EdgeLevels changed(Change&& change) const;

  int largest_ = 0;
  // Empty if all are the largest.
  FlatArray<LocalIndex> first_edge_{};    ///< By lower vertex, and the end: where its edges begin.
  FlatArray<LocalIndex> upper_vertex_{};  ///< Shape (num_edges); ascending for each lower vertex.
  FlatArray<std::int8_t> levels_{};       ///< Shape (num_edges).
};

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera {

/// @brief Lists of indices or ranks, one behind the other (CSR).
struct IndexLists {
  std::vector<LocalIndex> offsets{0};  ///< Shape (num_lists + 1).
  std::vector<LocalIndex> values{};    ///< Shape (offsets.back()).

  static auto fields(auto& self) { return std::tie(self.offsets, self.values); }

  friend bool operator==(const IndexLists&, const IndexLists&) = default;

  [[nodiscard]] LocalIndex num_lists() const { return static_cast<LocalIndex>(offsets.size()) - 1; }

  /// @brief List `i`. @pre 0 <= i < num_lists().
  [[nodiscard]] std::span<const LocalIndex> operator[](LocalIndex i) const
  {
    const auto begin = at(offsets[at(i)]);
    return std::span(values).subspan(begin, at(offsets[at(i) + 1]) - begin);
  }

  /// @brief Ends the list whose values were pushed to `values` since the last call.
  void end_list() { offsets.push_back(static_cast<LocalIndex>(values.size())); }
};

}  // namespace tessera

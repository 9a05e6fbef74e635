// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numeric>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"

namespace tessera {

/// @brief Lists of values, one behind the other (CSR).
template <class T>
struct Lists {
  using Values = std::conditional_t<std::is_trivially_copyable_v<T>, FlatArray<T>, std::vector<T>>;

  FlatArray<LocalIndex> offsets{0};  ///< Shape (num_lists + 1).
  Values values{};                   ///< Shape (offsets.back()).

  static auto fields(auto& self) { return std::tie(self.offsets, self.values); }

  friend bool operator==(const Lists&, const Lists&) = default;

  [[nodiscard]] LocalIndex num_lists() const { return static_cast<LocalIndex>(offsets.size()) - 1; }

  /// @brief List `i`. @pre 0 <= i < num_lists().
  [[nodiscard]] std::span<const T> operator[](LocalIndex i) const
  {
    const auto begin = at(offsets[at(i)]);
    return std::span(values).subspan(begin, at(offsets[at(i) + 1]) - begin);
  }

  /// @brief Ends the list whose values were pushed to `values` since the last call.
  void end_list() { offsets.push_back(static_cast<LocalIndex>(values.size())); }

  /// @brief Appends a list of these values.
  void add(std::span<const T> list)
  {
    values.insert(values.end(), list.begin(), list.end());
    end_list();
  }
};

/// @brief Lists of indices or ranks.
using IndexLists = Lists<LocalIndex>;

/// @brief List k holds the rows that name k, in ascending order; a row that names k twice stands
/// there twice. Local; linear, by counting.
/// @param[in] row_keys Shape (num_rows, keys_of_row): each in 0…num_lists-1, or kNoIndex for none.
[[nodiscard]] inline IndexLists rows_by_key(std::span<const LocalIndex> row_keys,
                                            LocalIndex num_lists, std::size_t keys_of_row = 1)
{
  IndexLists lists;
  lists.offsets.assign(at(num_lists) + 1, 0);
  for (const LocalIndex key : row_keys) {
    if (key != kNoIndex) ++lists.offsets[at(key) + 1];
  }
  std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
  lists.values.resize(at(lists.offsets.back()));
  std::vector<LocalIndex> next(lists.offsets.begin(), lists.offsets.end() - 1);
  for (std::size_t i = 0; i < row_keys.size(); ++i) {
    if (row_keys[i] == kNoIndex) continue;
    lists.values[at(next[at(row_keys[i])]++)] = static_cast<LocalIndex>(i / keys_of_row);
  }
  return lists;
}

/// @brief The other way round: list k of the result holds, in ascending order, the lists that hold
/// k. Local; linear.
/// @param[in] num_values All values are in 0…num_values-1.
[[nodiscard]] inline IndexLists inverted(const IndexLists& lists, LocalIndex num_values)
{
  IndexLists result = rows_by_key(lists.values, num_values);
  // Places in `lists.values` ascend in each list of the result, so one walk finds their lists.
  std::vector<LocalIndex> list_of(lists.values.size());
  for (LocalIndex i = 0; i < lists.num_lists(); ++i) {
    for (LocalIndex place = lists.offsets[at(i)]; place < lists.offsets[at(i) + 1]; ++place) {
      list_of[at(place)] = i;
    }
  }
  for (LocalIndex& place : result.values) place = list_of[at(place)];
  return result;
}

}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/base/types.hpp"

namespace tessera {

/// @brief A binary tree over items that stay as they are, to find the least of something. Local.
///
/// A node halves its items along the longest side of its box until few are left. A pure function of
/// its arguments. For items that change, and to find all that touch a box, there is BoxTree.
class SearchTree {
 public:
  /// @brief Its children are the next node and `other_child`.
  struct Node {
    Box box{};  ///< Around its items.
    LocalIndex other_child = kNoIndex;
    LocalIndex first = 0;  ///< Its items: rows [first, last) of order().
    LocalIndex last = 0;

    [[nodiscard]] bool is_leaf() const noexcept { return other_child == kNoIndex; }
  };

  /// @brief Without items.
  SearchTree() = default;

  /// @param[in] leaf_size A node of so many items or fewer has no children.
  /// @param[in] box_of Box of an item, as box_of(item).
  /// @param[in] place_of What orders items along an axis, as place_of(item, axis). No two may be
  /// equal: the standard library would choose between them.
  /// @param[in] use_node Called as use_node(items) for each node, in the order of nodes().
  template <class BoxOf, class PlaceOf, class UseNode>
  SearchTree(LocalIndex num_items, LocalIndex leaf_size, const BoxOf& box_of,
             const PlaceOf& place_of, const UseNode& use_node)
      : order_(at(num_items))
  {
    std::iota(order_.begin(), order_.end(), 0);
    const auto build = [&](const auto& self, LocalIndex first, LocalIndex last) -> LocalIndex {
      const auto number = static_cast<LocalIndex>(nodes_.size());
      const auto items = std::span(order_).subspan(at(first), at(last - first));
      Box box;
      for (const LocalIndex item : items) box.include(box_of(item));
      nodes_.push_back({box, kNoIndex, first, last});
      use_node(items);
      if (last - first <= leaf_size) return number;
      const LocalIndex half = (last - first) / 2;
      const std::size_t axis = box.longest_axis();
      std::ranges::nth_element(items, items.begin() + half, {},
                               [&](LocalIndex item) { return place_of(item, axis); });
      self(self, first, first + half);
      nodes_[at(number)].other_child = self(self, first + half, last);
      return number;
    };
    if (num_items > 0) build(build, 0, num_items);
  }

  template <class BoxOf, class PlaceOf>
  SearchTree(LocalIndex num_items, const BoxOf& box_of, const PlaceOf& place_of)
      : SearchTree(num_items, kLeafSize, box_of, place_of, [](const auto&) {})
  {
  }

  /// @brief The items as leaves have them, one leaf behind the other. Who searches often holds what
  /// belongs to them in this order.
  [[nodiscard]] const std::vector<LocalIndex>& order() const noexcept { return order_; }
  /// @brief Parents before their children.
  [[nodiscard]] const std::vector<Node>& nodes() const noexcept { return nodes_; }

  /// @brief Looks at all items that may be the least one, first at those that are likely to be.
  /// @param[in] bound_of The least that an item of a node may be, as bound_of(number of the node).
  /// @param[in] may_count Whether what is not less than a bound may still count: may_count(bound).
  /// @param[in] look Called as look(row of order()).
  template <class BoundOf, class MayCount, class Look>
  void search(const BoundOf& bound_of, const MayCount& may_count, const Look& look) const
  {
    struct Bound {
      double least;
      LocalIndex node;
    };
    std::array<Bound, kDeepest> to_visit;
    std::size_t num_to_visit = 0;
    const auto bound = [&](LocalIndex number) { return Bound{bound_of(number), number}; };
    if (!nodes_.empty()) to_visit[num_to_visit++] = bound(0);
    while (num_to_visit > 0) {
      const auto [least, number] = to_visit[--num_to_visit];
      if (!may_count(least)) continue;
      const Node& node = nodes_[at(number)];
      if (node.is_leaf()) {
        for (LocalIndex row = node.first; row < node.last; ++row) look(row);
        continue;
      }
      Bound near = bound(number + 1);
      Bound far = bound(node.other_child);
      if (far.least < near.least) std::swap(near, far);
      if (may_count(far.least)) to_visit[num_to_visit++] = far;
      if (may_count(near.least)) to_visit[num_to_visit++] = near;
    }
  }

 private:
  static constexpr LocalIndex kLeafSize = 4;
  static constexpr std::size_t kDeepest = 64;  // Halving 2^31 items gives 31 levels.

  std::vector<LocalIndex> order_{};
  std::vector<Node> nodes_{};
};

}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/base/types.hpp"

namespace tessera {

/// @brief Finds boxes that touch another one, while some of them change and new ones come. Local.
///
/// Boxes may be of very different sizes, so this is a tree and no grid. A node's box grows with
/// what it holds and never shrinks; after some changes an item the tree is built anew.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// @brief Gives item `item` another box; an empty one takes it out.
  void change(LocalIndex item, const Box& box);
  /// @brief Adds the next item, near the place where item `beside` is.
  void add(const Box& box, LocalIndex beside);

  [[nodiscard]] const Box& box(LocalIndex item) const { return boxes_[at(item)]; }

  /// @brief Calls visit(item) for all whose box `touches`, a test of boxes, says yes to. A box that
  /// holds one that it says yes to must get a yes as well.
  template <class Touches, class Visit>
  void visit(const Touches& touches, const Visit& visit) const
  {
    std::array<LocalIndex, kDeepest> to_visit;
    std::size_t num_to_visit = 0;
    if (touches(nodes_[0].box)) to_visit[num_to_visit++] = 0;
    while (num_to_visit > 0) {
      const Node& node = nodes_[at(to_visit[--num_to_visit])];
      if (node.children == kNoIndex) {
        const Leaf& leaf = leaves_[at(node.leaf)];
        for (std::size_t i = 0; i < at(node.num_items); ++i) {
          if (touches(leaf.boxes[i])) visit(leaf.items[i]);
        }
        continue;
      }
      if (touches(nodes_[at(node.children) + 1].box)) to_visit[num_to_visit++] = node.children + 1;
      if (touches(nodes_[at(node.children)].box)) to_visit[num_to_visit++] = node.children;
    }
  }

 private:
  // Halving 2^31 items gives 31 levels. Full leaves are halved too; where too many levels come
  // together of that, all is built anew.
  static constexpr std::size_t kDeepest = 128;
  static constexpr std::size_t kMostItems = 8;  // Of a leaf.

  struct Node {
    Box box{};
    LocalIndex parent = kNoIndex;
    LocalIndex children = kNoIndex;  // The first of two beside each other.
    LocalIndex leaf = kNoIndex;      // If there are no children.
    LocalIndex num_items = 0;
    std::size_t depth = 0;
  };

  // Boxes of a leaf lie beside each other in memory: most of the time goes into reading them.
  struct Leaf {
    std::array<LocalIndex, kMostItems> items{};
    std::array<Box, kMostItems> boxes{};
  };

  void rebuild();
  void build(LocalIndex number, std::span<LocalIndex> items);
  void put(LocalIndex item, LocalIndex number);
  void grow(LocalIndex node, const Box& box);
  void count_change();

  std::vector<Box> boxes_;          // Of the items.
  std::vector<LocalIndex> node_{};  // Of each item; kNoIndex: in none, as its box was empty.
  std::vector<Node> nodes_{};       // Parents before their children.
  std::vector<Leaf> leaves_{};
  std::size_t num_changes_ = 0;
};

}  // namespace tessera

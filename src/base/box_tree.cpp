// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/box_tree.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tessera {
namespace {

constexpr std::size_t kLeafSize = 4;

// After so many changes an item. Building takes as long as some 30 questions to each.
constexpr std::size_t kBuiltAfter = 2;

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) { rebuild(); }

void BoxTree::rebuild()
{
  num_changes_ = 0;
  nodes_.assign(1, {});
  leaves_.clear();
  node_.assign(boxes_.size(), kNoIndex);
  std::vector<LocalIndex> items;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].is_empty()) items.push_back(static_cast<LocalIndex>(i));
  }
  build(0, items);
}

// Makes a node whose children, or leaf, are not there yet.
void BoxTree::build(LocalIndex number, std::span<LocalIndex> items)
{
  Box box;
  for (const LocalIndex item : items) box.include(boxes_[at(item)]);
  Node& node = nodes_[at(number)];
  node.box = box;
  if (items.size() <= kLeafSize) {
    if (node.leaf == kNoIndex) node.leaf = static_cast<LocalIndex>(leaves_.size());
    leaves_.resize(std::max(leaves_.size(), at(node.leaf) + 1));
    for (const LocalIndex item : items) put(item, number);
    return;
  }
  const auto children = static_cast<LocalIndex>(nodes_.size());
  node.children = children;
  const std::size_t axis = box.longest_axis();
  const auto place = [&](LocalIndex item) {
    return std::pair(boxes_[at(item)].low[axis] + boxes_[at(item)].high[axis], item);
  };
  const std::size_t half = items.size() / 2;
  std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half), {}, place);
  nodes_.resize(nodes_.size() + 2, {.parent = number, .depth = nodes_[at(number)].depth + 1});
  nodes_[at(children)].leaf = std::exchange(nodes_[at(number)].leaf, kNoIndex);
  build(children, items.first(half));
  build(children + 1, items.subspan(half));
}

// Into a leaf that has room for it.
void BoxTree::put(LocalIndex item, LocalIndex number)
{
  Node& node = nodes_[at(number)];
  const std::size_t place = at(node.num_items++);
  leaves_[at(node.leaf)].items[place] = item;
  leaves_[at(node.leaf)].boxes[place] = boxes_[at(item)];
  node_[at(item)] = number;
}

void BoxTree::grow(LocalIndex node, const Box& box)
{
  for (; node != kNoIndex && !nodes_[at(node)].box.holds(box); node = nodes_[at(node)].parent) {
    nodes_[at(node)].box.include(box);
  }
}

void BoxTree::count_change()
{
  if (++num_changes_ > kBuiltAfter * boxes_.size()) rebuild();
}

void BoxTree::change(LocalIndex item, const Box& box)
{
  boxes_[at(item)] = box;
  const LocalIndex node = node_[at(item)];
  if (node == kNoIndex) return rebuild();
  Leaf& leaf = leaves_[at(nodes_[at(node)].leaf)];
  leaf.boxes[static_cast<std::size_t>(std::ranges::find(leaf.items, item) - leaf.items.begin())] =
      box;
  if (!box.is_empty()) grow(node, box);
  count_change();
}

void BoxTree::add(const Box& box, LocalIndex beside)
{
  const LocalIndex number = node_[at(beside)];
  const auto item = static_cast<LocalIndex>(boxes_.size());
  boxes_.push_back(box);
  node_.push_back(kNoIndex);
  if (number == kNoIndex) return rebuild();
  grow(number, box);
  Node& node = nodes_[at(number)];
  if (at(node.num_items) < kMostItems) {
    put(item, number);
  } else if (node.depth + kMostItems > kDeepest) {
    return rebuild();
  } else {
    const auto& full = leaves_[at(node.leaf)].items;
    for (const LocalIndex one : full) node_[at(one)] = kNoIndex;
    std::vector<LocalIndex> items{item};
    std::ranges::copy_if(full, std::back_inserter(items),
                         [this](LocalIndex one) { return !boxes_[at(one)].is_empty(); });
    node.num_items = 0;
    build(number, items);
  }
  count_change();
}

}  // namespace tessera

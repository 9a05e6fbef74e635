// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/box_tree.hpp"

#include <algorithm>
#include <utility>

namespace tessera::coarse {
namespace {

constexpr std::size_t kLeafSize = 4;

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) { rebuild(); }

void BoxTree::rebuild()
{
  num_changes_ = 0;
  nodes_.clear();
  leaf_.assign(boxes_.size(), kNoIndex);
  std::vector<LocalIndex> items;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].is_empty()) items.push_back(static_cast<LocalIndex>(i));
  }
  if (!items.empty()) build(items, kNoIndex);
}

LocalIndex BoxTree::build(std::span<LocalIndex> items, LocalIndex parent)
{
  const auto number = static_cast<LocalIndex>(nodes_.size());
  Box box;
  for (const LocalIndex item : items) box.include(boxes_[at(item)]);
  nodes_.push_back({box, parent, kNoIndex, {}});
  if (items.size() <= kLeafSize) {
    nodes_.back().items.assign(items.begin(), items.end());
    for (const LocalIndex item : items) leaf_[at(item)] = number;
    return number;
  }
  const Vec3 extent = box.high - box.low;
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
  const auto place = [&](LocalIndex item) {
    return std::pair(boxes_[at(item)].low[axis] + boxes_[at(item)].high[axis], item);
  };
  const std::size_t half = items.size() / 2;
  std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half), {}, place);
  build(items.first(half), number);
  const LocalIndex other_child = build(items.subspan(half), number);
  nodes_[at(number)].other_child = other_child;
  return number;
}

void BoxTree::grow(LocalIndex node, const Box& box)
{
  for (; node != kNoIndex && !nodes_[at(node)].box.holds(box); node = nodes_[at(node)].parent) {
    nodes_[at(node)].box.include(box);
  }
}

void BoxTree::count_change()
{
  if (++num_changes_ > boxes_.size()) rebuild();
}

void BoxTree::change(LocalIndex item, const Box& box)
{
  boxes_[at(item)] = box;
  if (leaf_[at(item)] == kNoIndex) return rebuild();
  if (!box.is_empty()) grow(leaf_[at(item)], box);
  count_change();
}

void BoxTree::add(const Box& box, LocalIndex beside)
{
  const LocalIndex leaf = leaf_[at(beside)];
  const auto item = static_cast<LocalIndex>(boxes_.size());
  boxes_.push_back(box);
  leaf_.push_back(leaf);
  nodes_[at(leaf)].items.push_back(item);
  grow(leaf, box);
  count_change();
}

}  // namespace tessera::coarse

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/cut/cut_tree.hpp"

#include <cmath>

#include "tessera/base/error.hpp"

namespace tessera::cut {
namespace {

// Walks all trees, leaves in the order of their parts.
class Walk {
 public:
  explicit Walk(const CutTree& tree) : tree_(tree), seen_(tree.nodes.size(), false) {}

  std::vector<LocalIndex> run()
  {
    for (std::size_t s = 0; s < tree_.solid_root.size(); ++s) {
      visit_tree(tree_.solid_root[s], static_cast<LocalIndex>(s));
    }
    return solids_;
  }

  [[nodiscard]] bool is_sound() const { return is_sound_; }
  [[nodiscard]] bool saw_all() const
  {
    for (const bool seen : seen_) {
      if (!seen) return false;
    }
    return true;
  }

 private:
  void visit_tree(LocalIndex root, LocalIndex solid)
  {
    std::vector<LocalIndex> open{root};
    while (!open.empty() && is_sound_) {
      const LocalIndex row = open.back();
      open.pop_back();
      if (row < 0 || at(row) >= tree_.nodes.size() || seen_[at(row)]) {
        is_sound_ = false;
        return;
      }
      seen_[at(row)] = true;
      const CutNode& node = tree_.nodes[at(row)];
      if (node.is_leaf()) {
        is_sound_ = node.part == static_cast<LocalIndex>(solids_.size()) && node.below == kNoIndex
                    && node.above == kNoIndex;
        solids_.push_back(solid);
      } else {
        is_sound_ = node.below > row && node.above > row && std::isfinite(node.plane.offset)
                    && std::abs(norm(node.plane.normal) - 1.0) < 1e-6;
        open.push_back(node.above);
        open.push_back(node.below);
      }
    }
  }

  const CutTree& tree_;
  std::vector<bool> seen_;
  std::vector<LocalIndex> solids_{};
  bool is_sound_ = true;
};

}  // namespace

LocalIndex CutTree::part_of(LocalIndex solid, const Vec3& point) const
{
  LocalIndex row = solid_root[at(solid)];
  while (!nodes[at(row)].is_leaf()) {
    const CutNode& node = nodes[at(row)];
    row = node.plane.height(point) < 0.0 ? node.below : node.above;
  }
  return nodes[at(row)].part;
}

std::vector<LocalIndex> CutTree::part_solid() const { return Walk(*this).run(); }

void CutTree::require_sound() const
{
  Walk walk(*this);
  const std::vector<LocalIndex> solids = walk.run();
  if (!walk.is_sound() || !walk.saw_all() || num_parts != static_cast<LocalIndex>(solids.size())) {
    throw InputError("the tree of cut planes is damaged");
  }
}

}  // namespace tessera::cut

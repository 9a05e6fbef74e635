// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/cut/choose_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "cut/foreign_lines.hpp"
#include "cut/judge_plane.hpp"
#include "cut/moments.hpp"
#include "cut/plane_rules.hpp"
#include "cut/solid_surfaces.hpp"

namespace tessera::cut {
namespace {

constexpr double kTouches = 1e-6;  // Of the model's size: nearer is on the plane.

// A leaf of the tree in the making.
struct Leaf {
  LocalIndex node = kNoIndex;
  LocalIndex solid = kNoIndex;
  PartSurface surface{};
  std::vector<HalfSpace> cell{};  // That it is in.
  double volume = 0.0;
  LocalIndex num_wanted = 1;
  std::string whole_because{};
};

// Each leaf gets one part; each further part goes to the leaf that has most volume a part.
void allot_parts(std::vector<Leaf>& leaves, LocalIndex num_parts)
{
  for (auto n = static_cast<LocalIndex>(leaves.size()); n < num_parts; ++n) {
    Leaf* largest = &leaves.front();
    for (Leaf& leaf : leaves) {
      if (leaf.volume / leaf.num_wanted > largest->volume / largest->num_wanted * (1.0 + 1e-9)) {
        largest = &leaf;
      }
    }
    ++largest->num_wanted;
  }
}

class PlaneChooser {
 public:
  PlaneChooser(const model::ModelDescription& model, const CutOptions& options)
      : options_(options),
        solids_(solid_surfaces(model, options.coarse_size)),
        next_label_(static_cast<LocalIndex>(model.faces.size())),
        rule_(make_rule(options))
  {
  }

  CutChoice run()
  {
    for (std::size_t s = 0; s < solids_.size(); ++s) plant(static_cast<LocalIndex>(s));
    for (std::size_t g = 0; g < options_.given.size(); ++g) cut_by_given(g);
    allot_parts(leaves_, options_.parts);
    std::vector<Leaf> open = std::move(leaves_);
    for (Leaf& leaf : open) grow(std::move(leaf));
    finish();
    return std::move(choice_);
  }

 private:
  void plant(LocalIndex solid)
  {
    SolidSurface& from = solids_[at(solid)];
    const LocalIndex node = add_node();
    choice_.tree.solid_root.push_back(node);
    const double volume = volume_of(from.surface);
    leaves_.push_back({.node = node,
                       .solid = solid,
                       .surface = std::move(from.surface),
                       .volume = std::max(volume, 0.0)});
  }

  LocalIndex add_node()
  {
    choice_.tree.nodes.emplace_back();
    return static_cast<LocalIndex>(choice_.tree.nodes.size()) - 1;
  }

  // A leaf becomes a node with two leaves.
  std::pair<Leaf, Leaf> split(const Leaf& leaf, const Plane& plane, bool is_given)
  {
    PartSurface lined = with_lines(leaf);
    std::erase_if(lined.edges, [&](const FeatureEdge& edge) {
      return edge.foreign != kNoIndex && choice_.tree.nodes[at(edge.foreign)].plane == plane;
    });
    PlaneJudgement judgement = judge_plane(lined, plane, options_.coarse_size);
    judgement.node = leaf.node;
    judgement.solid = leaf.solid;
    judgement.is_given = is_given;
    choice_.report.planes.push_back(judgement);
    const LocalIndex label = next_label_++;
    CutSides sides = cut_part(leaf.surface, plane, label, options_.coarse_size);
    lines_.keep(sides.traces, leaf.node);
    const auto child = [&](PartSurface& surface, bool is_upper) {
      const double volume = volume_of(surface);
      Leaf result{.node = add_node(),
                  .solid = leaf.solid,
                  .surface = std::move(surface),
                  .cell = leaf.cell,
                  .volume = std::max(volume, 0.0)};
      result.cell.push_back({plane, label, is_upper});
      return result;
    };
    Leaf below = child(sides.below, false);
    Leaf above = child(sides.above, true);
    CutNode& node = choice_.tree.nodes[at(leaf.node)];
    node.plane = plane;
    node.below = below.node;
    node.above = above.node;
    return {std::move(below), std::move(above)};
  }

  [[nodiscard]] PartSurface with_lines(const Leaf& leaf) const
  {
    return lines_.with_lines(leaf.surface, leaf.solid, leaf.cell, options_.coarse_size);
  }

  [[nodiscard]] Proposal ask(const Leaf& leaf) const
  {
    const PartSurface lined = with_lines(leaf);
    std::set<LocalIndex> nodes;
    for (const FeatureEdge& edge : lined.edges) {
      if (edge.foreign != kNoIndex) nodes.insert(edge.foreign);
    }
    std::vector<ForeignPlane> foreign;
    for (const LocalIndex node : nodes) {
      foreign.push_back({node, choice_.tree.nodes[at(node)].plane});
    }
    return rule_->propose({lined, leaf.num_wanted, foreign});
  }

  void cut_by_given(std::size_t row)
  {
    const Plane& given = options_.given[row];
    const double length = norm(given.normal);
    const Plane plane{(1.0 / length) * given.normal, given.offset / length};
    std::vector<Leaf> after;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    bool meets = false;
    for (Leaf& leaf : leaves_) {
      const std::vector<double> heights = leaf.surface.heights(plane);
      if (heights.empty()) {
        after.push_back(std::move(leaf));
        continue;
      }
      const auto [low, high] = std::ranges::minmax(heights);
      lowest = std::min(lowest, low);
      highest = std::max(highest, high);
      const double near = kTouches * (high - low);
      if (low < -near && high > near) {
        auto [below, above] = split(leaf, plane, true);
        after.push_back(std::move(below));
        after.push_back(std::move(above));
        meets = true;
      } else {
        after.push_back(std::move(leaf));
      }
    }
    leaves_ = std::move(after);
    if (meets) return;
    throw InputError(fmt::format(
        "cut plane {} with normal ({:.6g}, {:.6g}, {:.6g}) and offset {:.6g} meets no solid: the "
        "model extends from {:.6g} to {:.6g} along its normal",
        row + 1, plane.normal[0], plane.normal[1], plane.normal[2], plane.offset,
        lowest + plane.offset, highest + plane.offset));
  }

  void grow(Leaf leaf)
  {
    if (leaf.num_wanted > 1) {
      const std::string& unfit = solids_[at(leaf.solid)].unfit_because;
      Proposal proposal{.whole_because = unfit};
      if (unfit.empty()) proposal = ask(leaf);
      if (proposal.plane) {
        auto [below, above] = split(leaf, *proposal.plane, false);
        below.num_wanted = proposal.num_below;
        above.num_wanted = leaf.num_wanted - proposal.num_below;
        leaf.surface = {};
        grow(std::move(below));
        grow(std::move(above));
        return;
      }
      leaf.whole_because = proposal.whole_because;
    }
    leaf.surface = {};
    leaves_.push_back(std::move(leaf));
  }

  // Numbers the parts.
  void finish()
  {
    std::map<LocalIndex, Leaf*> leaf_at;
    for (Leaf& leaf : leaves_) leaf_at[leaf.node] = &leaf;
    for (const LocalIndex root : choice_.tree.solid_root) {
      std::vector<LocalIndex> open{root};
      while (!open.empty()) {
        CutNode& node = choice_.tree.nodes[at(open.back())];
        const LocalIndex row = open.back();
        open.pop_back();
        if (node.below != kNoIndex) {
          open.push_back(node.above);
          open.push_back(node.below);
          continue;
        }
        node.part = choice_.tree.num_parts++;
        Leaf& leaf = *leaf_at.at(row);
        choice_.report.parts.push_back(
            {leaf.solid, leaf.volume, leaf.num_wanted, std::move(leaf.whole_because)});
      }
    }
    finish_report();
  }

  void finish_report()
  {
    CutReport& report = choice_.report;
    report.num_wanted = options_.parts;
    double largest = 0.0;
    double sum = 0.0;
    for (const CutPart& part : report.parts) {
      largest = std::max(largest, part.volume);
      sum += part.volume;
    }
    if (sum > 0.0) report.balance = largest * static_cast<double>(report.parts.size()) / sum;
    std::ranges::sort(report.planes, {}, &PlaneJudgement::node);
  }

  const CutOptions& options_;
  std::vector<SolidSurface> solids_;
  LocalIndex next_label_;
  std::unique_ptr<Rule> rule_;
  ForeignLines lines_{};
  std::vector<Leaf> leaves_{};
  CutChoice choice_{};
};

void require_valid(const CutOptions& options)
{
  if (options.parts < 1) throw ConfigError("the number of parts to cut into must be at least 1");
  if (!(options.coarse_size > 0.0) || !std::isfinite(options.coarse_size)) {
    throw ConfigError("the coarse size for choosing cut planes must be positive");
  }
  for (std::size_t g = 0; g < options.given.size(); ++g) {
    const double length = norm(options.given[g].normal);
    if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(options.given[g].offset)) {
      throw ConfigError(fmt::format("cut plane {} has no direction, or no offset", g + 1));
    }
  }
}

}  // namespace

CutChoice choose_planes(const model::ModelDescription& model, const CutOptions& options)
{
  require_valid(options);
  model.require_sound();
  return PlaneChooser(model, options).run();
}

}  // namespace tessera::cut

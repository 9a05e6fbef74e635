// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "cut/directions.hpp"
#include "cut/judge_plane.hpp"
#include "cut/landmarks.hpp"
#include "cut/moments.hpp"
#include "cut/plane_rules.hpp"
#include "cut/profile.hpp"
#include "cut/section.hpp"

namespace tessera::cut {
namespace {

constexpr std::size_t kNumOffsets = 128;     // Of each direction.
constexpr std::size_t kMostOfDirection = 6;  // Planes of one direction and band that are kept.

// By how much of itself a side may be larger than wanted: the ends of bands.
constexpr std::array kImbalances{0.12, 0.3, 0.6};

// What a plane must have.
struct Demand {
  double imbalance = 0.0;  // At most.
  double clearance = 0.0;  // At least, in sizes of the features.
  double edge = 0.0;       // At least, in coarse sizes or the part's thickness.
  double angle_deg = 0.0;  // At least.
};

// Tried one after the other: what is unbalanced is better than what is narrow.
constexpr double kLeastClearance = 0.35;
constexpr std::array kDemands{Demand{kImbalances[0], 0.5, 0.4, 30.0},
                              Demand{kImbalances[1], 0.5, 0.4, 30.0},
                              Demand{kImbalances[0], kLeastClearance, 0.3, 25.0},
                              Demand{kImbalances[2], kLeastClearance, 0.3, 25.0}};

// Costs of what differ by less are equal: the first one is taken. So rounding does not choose.
constexpr double kSameCost = 1e-6;

// Taking a plane of a neighbour saves lines on the border between them.
constexpr double kCostOfOwnPlane = 0.05;

// Where an oblique plane cuts a curved face, the mesher finds a curve that is not simple.
constexpr double kCostOfOblique = 0.3;

struct Candidate {
  Plane plane{};
  LocalIndex num_below = 1;
  LocalIndex foreign = kNoIndex;  // ForeignPlane::node.
  double imbalance = 0.0;
  double clearance = 0.0;
  double cost = 0.0;                 // Without what the section costs.
  std::optional<Section> section{};  // Once it was looked at.
};

double square(double x) { return x * x; }

class ClearSearch {
 public:
  ClearSearch(const Question& question, double coarse_size)
      : question_(question),
        part_(question.part),
        coarse_size_(coarse_size),
        moments_(moments_of(question.part)),
        area_unit_(std::cbrt(moments_.volume * moments_.volume)),
        edge_unit_(std::min(coarse_size, 2.0 * moments_.volume / surface_area()))
  {
    add_foreign();
    const LandmarkFinder finder(part_, coarse_size);
    for (const Direction& direction : candidate_directions(part_, moments_)) {
      add_of(direction, finder);
    }
    std::ranges::stable_sort(candidates_, {}, cost_without_noise);
  }

  Proposal run()
  {
    for (const Demand& demand : kDemands) {
      const Candidate* best = best_of(demand);
      if (best != nullptr) return {best->plane, best->num_below, {}};
    }
    return {std::nullopt, 1, "no plane keeps clear of its features"};
  }

 private:
  static double cost_without_noise(const Candidate& candidate)
  {
    return std::round(candidate.cost / kSameCost);
  }

  [[nodiscard]] double surface_area() const
  {
    double area = 0.0;
    for (const SurfaceTriangle& triangle : part_.triangles) {
      const auto& [a, b, c] = triangle.vertices;
      const Vec3 origin = part_.points[at(a)];
      area += 0.5 * norm(cross(part_.points[at(b)] - origin, part_.points[at(c)] - origin));
    }
    return area;
  }

  // A plane of a neighbour may lie on its own lines.
  [[nodiscard]] PartSurface without_lines_of(LocalIndex node) const
  {
    PartSurface part = part_;
    std::erase_if(part.edges, [&](const FeatureEdge& edge) { return edge.foreign == node; });
    return part;
  }

  void add_foreign()
  {
    for (const ForeignPlane& foreign : question_.foreign) {
      const PartSurface part = without_lines_of(foreign.node);
      const std::vector<double> heights = part.heights(foreign.plane);
      const Candidate candidate{.plane = foreign.plane, .foreign = foreign.node};
      add(candidate, volume_below(part, foreign.plane.normal, heights),
          section_of(part, foreign.plane, heights, coarse_size_).area,
          clearance_of(LandmarkFinder(part, coarse_size_).find(heights), 0.0, coarse_size_,
                       kLargestClearance));
    }
  }

  // The best planes of a direction by what costs little to know.
  void add_of(const Direction& direction, const LandmarkFinder& finder)
  {
    const Vec3& normal = direction.normal;
    const double own_cost = kCostOfOwnPlane + (direction.is_plain ? 0.0 : kCostOfOblique);
    const std::vector<double> heights = part_.heights({normal, 0.0});
    const Profile profile = profile_of(part_, normal, heights, kNumOffsets);
    const std::vector<Landmark> landmarks = finder.find(heights);
    std::vector<Candidate> own;
    std::swap(own, candidates_);
    for (std::size_t entry = 1; entry + 1 < kNumOffsets; ++entry) {
      const double offset = profile.offset(entry);
      add({.plane = {normal, offset}, .cost = own_cost}, profile.volume[entry], profile.area[entry],
          clearance_of(landmarks, offset, coarse_size_, kLargestClearance));
    }
    std::swap(own, candidates_);
    std::ranges::stable_sort(own, {}, cost_without_noise);
    std::array<std::size_t, kImbalances.size()> num_kept{};
    for (const Candidate& candidate : own) {
      const auto band = std::ranges::lower_bound(kImbalances, candidate.imbalance);
      if (num_kept[static_cast<std::size_t>(band - kImbalances.begin())]++ < kMostOfDirection) {
        candidates_.push_back(candidate);
      }
    }
  }

  // Keeps a candidate if it may be taken, as far as that is known.
  void add(Candidate candidate, double volume_below, double area, double clearance)
  {
    candidate.imbalance = share_out(volume_below / moments_.volume, candidate);
    candidate.clearance = clearance;
    if (!(candidate.imbalance <= kImbalances.back()) || clearance < kLeastClearance) return;
    candidate.cost += 2.0 * candidate.imbalance + 3.0 * square(std::max(0.0, 1.0 - clearance))
                      + area / area_unit_;
    candidates_.push_back(candidate);
  }

  // Says how many parts go below. @return How much larger than wanted the larger side is.
  double share_out(double fraction, Candidate& candidate) const
  {
    const LocalIndex num_parts = question_.num_parts;
    const LocalIndex least = std::max<LocalIndex>(1, num_parts / 4);
    candidate.num_below = std::clamp(static_cast<LocalIndex>(std::lround(fraction * num_parts)),
                                     least, num_parts - least);
    const double below = fraction * num_parts / candidate.num_below;
    const double above = (1.0 - fraction) * num_parts / (num_parts - candidate.num_below);
    return std::max(below, above) - 1.0;
  }

  // Looks closely at one after the other, until none can be better than the best one.
  [[nodiscard]] const Candidate* best_of(const Demand& demand)
  {
    const Candidate* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (Candidate& candidate : candidates_) {
      if (candidate.cost >= least - kSameCost) break;
      if (candidate.imbalance > demand.imbalance || candidate.clearance < demand.clearance) {
        continue;
      }
      const Section& section = look_at(candidate);
      const double edge = section.shortest_edge / edge_unit_;
      if (section.angle_deg < demand.angle_deg || edge < demand.edge) continue;
      const double cost = candidate.cost
                          + 1.5 * square(std::max(0.0, 1.0 - section.angle_deg / 60.0))
                          + 2.0 * square(std::max(0.0, 1.0 - edge));
      if (cost >= least - kSameCost) continue;
      least = cost;
      best = &candidate;
    }
    return best;
  }

  const Section& look_at(Candidate& candidate) const
  {
    if (!candidate.section) {
      const auto section_in = [&](const PartSurface& part) {
        return section_of(part, candidate.plane, part.heights(candidate.plane), coarse_size_);
      };
      candidate.section = candidate.foreign == kNoIndex
                              ? section_in(part_)
                              : section_in(without_lines_of(candidate.foreign));
    }
    return *candidate.section;
  }

  const Question& question_;
  const PartSurface& part_;
  double coarse_size_;
  Moments moments_;
  double area_unit_;
  double edge_unit_;
  std::vector<Candidate> candidates_{};
};

class ClearRule final : public Rule {
 public:
  explicit ClearRule(double coarse_size) : coarse_size_(coarse_size) {}

  Proposal propose(const Question& question) override
  {
    return ClearSearch(question, coarse_size_).run();
  }

 private:
  double coarse_size_;
};

}  // namespace

std::unique_ptr<Rule> make_clear_rule(double coarse_size)
{
  return std::make_unique<ClearRule>(coarse_size);
}

}  // namespace tessera::cut

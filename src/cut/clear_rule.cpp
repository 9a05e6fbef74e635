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
constexpr std::size_t kMostOfDirection = 8;  // Planes of one direction that are looked at closely.

// How much larger than wanted a side may be: tried one after the other.
constexpr std::array kLargestImbalance{0.2, 0.6};

// What a plane must have.
constexpr double kLeastClearance = 0.25;  // In sizes of the features.
constexpr double kLeastAngle_deg = 20.0;
constexpr double kLeastEdge = 0.2;  // In coarse sizes, or the part's thickness.

// Costs of what differ by less are equal: the first one is taken. So rounding does not choose.
constexpr double kSameCost = 1e-6;

struct Candidate {
  std::size_t direction = 0;
  double offset = 0.0;
  LocalIndex num_below = 1;
  double cost = 0.0;
};

double square(double x) { return x * x; }

// What is known of a direction before any plane is looked at.
struct DirectionData {
  Vec3 normal{};
  Profile profile{};
  std::vector<Landmark> landmarks{};
};

class ClearSearch {
 public:
  ClearSearch(const PartSurface& part, LocalIndex num_parts, double coarse_size)
      : part_(part), num_parts_(num_parts), coarse_size_(coarse_size), moments_(moments_of(part))
  {
    const LandmarkFinder finder(part, coarse_size);
    for (const Vec3& normal : candidate_directions(part, moments_)) {
      const std::vector<double> heights = part.heights({normal, 0.0});
      directions_.push_back({.normal = normal,
                             .profile = profile_of(part, normal, heights, kNumOffsets),
                             .landmarks = finder.find(heights)});
    }
    area_unit_ = std::cbrt(moments_.volume * moments_.volume);
    edge_unit_ = std::min(coarse_size, 2.0 * moments_.volume / surface_area());
  }

  Proposal run()
  {
    for (const double largest : kLargestImbalance) {
      const std::optional<Candidate> best = best_of(promising(largest));
      if (best) return {plane_of(*best), best->num_below, {}};
    }
    return {std::nullopt, 1, "no plane keeps clear of its features"};
  }

 private:
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

  [[nodiscard]] Plane plane_of(const Candidate& candidate) const
  {
    return {directions_[candidate.direction].normal, candidate.offset};
  }

  // Looks closely at one after the other, until none can be better than the best one.
  [[nodiscard]] std::optional<Candidate> best_of(const std::vector<Candidate>& candidates) const
  {
    std::optional<Candidate> best;
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates) {
      if (candidate.cost >= least - kSameCost) break;
      const double cost = candidate.cost + closer_cost(candidate);
      if (cost >= least - kSameCost) continue;
      least = cost;
      best = candidate;
    }
    return best;
  }

  // The best planes of all directions by what costs little to know, the best one first.
  std::vector<Candidate> promising(double largest_imbalance) const
  {
    std::vector<Candidate> all;
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      std::vector<Candidate> own;
      const Profile& profile = directions_[d].profile;
      for (std::size_t entry = 1; entry + 1 < kNumOffsets; ++entry) {
        Candidate candidate{.direction = d, .offset = profile.offset(entry)};
        if (!add_quick_cost(profile.volume[entry], profile.area[entry], largest_imbalance,
                            candidate)) {
          continue;
        }
        own.push_back(candidate);
      }
      keep_best(own, kMostOfDirection);
      all.insert(all.end(), own.begin(), own.end());
    }
    keep_best(all, all.size());
    return all;
  }

  static void keep_best(std::vector<Candidate>& candidates, std::size_t num_kept)
  {
    std::ranges::stable_sort(candidates, {}, [](const Candidate& candidate) {
      return std::round(candidate.cost / kSameCost);
    });
    candidates.resize(std::min(candidates.size(), num_kept));
  }

  // Whether the plane may be taken, as far as that is known.
  bool add_quick_cost(double volume_below, double area, double largest_imbalance,
                      Candidate& candidate) const
  {
    const double fraction = volume_below / moments_.volume;
    const double parts = num_parts_;
    const LocalIndex least = std::max<LocalIndex>(1, num_parts_ / 4);
    candidate.num_below = std::clamp(static_cast<LocalIndex>(std::lround(fraction * parts)), least,
                                     num_parts_ - least);
    const double below = fraction * parts / candidate.num_below;
    const double above = (1.0 - fraction) * parts / (num_parts_ - candidate.num_below);
    const double imbalance = std::max(below, above) - 1.0;
    if (!(imbalance <= largest_imbalance)) return false;
    const double clearance = clearance_of(directions_[candidate.direction].landmarks,
                                          candidate.offset, coarse_size_, kLargestClearance);
    if (clearance < kLeastClearance) return false;
    candidate.cost =
        2.0 * imbalance + 3.0 * square(std::max(0.0, 1.0 - clearance)) + area / area_unit_;
    return true;
  }

  // Infinite if the plane must not be taken.
  double closer_cost(const Candidate& candidate) const
  {
    const Plane plane = plane_of(candidate);
    const Section section = section_of(part_, plane, part_.heights(plane), coarse_size_);
    const double edge = section.shortest_edge / edge_unit_;
    if (section.angle_deg < kLeastAngle_deg || edge < kLeastEdge) {
      return std::numeric_limits<double>::infinity();
    }
    return 1.5 * square(std::max(0.0, 1.0 - section.angle_deg / 60.0))
           + 2.0 * square(std::max(0.0, 1.0 - edge));
  }

  const PartSurface& part_;
  LocalIndex num_parts_;
  double coarse_size_;
  Moments moments_;
  double area_unit_ = 1.0;
  double edge_unit_ = 1.0;
  std::vector<DirectionData> directions_{};
};

class ClearRule final : public Rule {
 public:
  explicit ClearRule(double coarse_size) : coarse_size_(coarse_size) {}

  Proposal propose(const PartSurface& part, LocalIndex num_parts) override
  {
    return ClearSearch(part, num_parts, coarse_size_).run();
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

// SPDX-License-Identifier: BSD-3-Clause
#include "cut/plane_rules.hpp"

#include <cmath>
#include <random>

#include "cut/moments.hpp"

namespace tessera::cut {
namespace {

// Across a direction: through the centre of mass if both sides get as many parts. Else at their
// share of the volume.
Proposal cut_across(const PartSurface& part, const Moments& moments, const Vec3& direction,
                    LocalIndex num_parts)
{
  const Vec3 normal = turned_forward(direction);
  const LocalIndex num_below = num_parts / 2;
  const double offset =
      num_parts % 2 == 0
          ? dot(normal, moments.centre)
          : balanced_offset(part, normal, static_cast<double>(num_below) / num_parts);
  return {Plane{normal, offset}, num_below, {}};
}

class PcaRule final : public Rule {
 public:
  Proposal propose(const Question& question) override
  {
    const Moments moments = moments_of(question.part);
    return cut_across(question.part, moments, moments.axes[0], question.num_parts);
  }
};

class RandomRule final : public Rule {
 public:
  explicit RandomRule(std::uint64_t seed) : generator_(seed) {}

  Proposal propose(const Question& question) override
  {
    return cut_across(question.part, moments_of(question.part), direction(), question.num_parts);
  }

 private:
  // Distributions of the standard library differ from one library to the next.
  double from_minus_one_to_one()
  {
    return static_cast<double>(generator_() >> 11U) * 0x1.0p-52 - 1.0;
  }

  // Of a point in the unit ball, so that no direction is likelier than another.
  Vec3 direction()
  {
    for (;;) {
      const double x = from_minus_one_to_one();
      const double y = from_minus_one_to_one();
      const double z = from_minus_one_to_one();
      const double length = norm({x, y, z});
      if (length > 0.1 && length <= 1.0) return (1.0 / length) * Vec3{x, y, z};
    }
  }

  std::mt19937_64 generator_;
};

}  // namespace

std::unique_ptr<Rule> make_rule(const CutOptions& options)
{
  if (options.rule == PlaneRule::pca) return std::make_unique<PcaRule>();
  if (options.rule == PlaneRule::random) return std::make_unique<RandomRule>(options.seed);
  return make_clear_rule(options.coarse_size);
}

}  // namespace tessera::cut

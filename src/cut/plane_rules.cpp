// SPDX-License-Identifier: BSD-3-Clause
#include "cut/plane_rules.hpp"

#include "cut/moments.hpp"

namespace tessera::cut {
namespace {

// Across the longest axis: through the centre of mass if both sides get as many parts. Else at
// their share of the volume.
class PcaRule final : public Rule {
 public:
  Proposal propose(const Question& question) override
  {
    const Moments moments = moments_of(question.part);
    const Vec3 normal = turned_forward(moments.axes[0]);
    const LocalIndex num_parts = question.num_parts;
    const LocalIndex num_below = num_parts / 2;
    const double offset =
        num_parts % 2 == 0
            ? dot(normal, moments.centre)
            : balanced_offset(question.part, normal, static_cast<double>(num_below) / num_parts);
    return {Plane{normal, offset}, num_below, {}};
  }
};

}  // namespace

std::unique_ptr<Rule> make_rule(const CutOptions& options)
{
  if (options.rule == PlaneRule::pca) return std::make_unique<PcaRule>();
  return make_clear_rule(options.coarse_size);
}

}  // namespace tessera::cut

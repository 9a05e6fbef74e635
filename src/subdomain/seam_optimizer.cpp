// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/seam_optimizer.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "tessera/optimize/optimize.hpp"

#include "subdomain/refine/piece_schedule.hpp"

namespace tessera::subdomain {
namespace {

class SeamOptimizer final : public improve::Optimizer {
 public:
  explicit SeamOptimizer(bool split_corners) : split_corners_(split_corners) {}

  // The fixed vertices are those of the boundary and come first; the optimiser keeps their order.
  [[nodiscard]] improve::TetMesh optimize(const improve::OptimizeInput& input,
                                          int rounds) const override
  {
    optimize::OptimizeResult better = optimize::optimize(
        {.vertex_xyz = input.tets.vertex_xyz,
         .tet_vertices = input.tets.tet_vertices,
         .outer_triangles = split_corners_ ? outer_triangles(input) : std::vector<LocalIndex>{}},
        piece_schedule(false, rounds));
    return {std::move(better.vertex_xyz), std::move(better.tet_vertices)};
  }

 private:
  // Those on the geometry, and some for which it is not known. No filled tet has two on the
  // geometry, so no step must bring two together.
  static std::vector<LocalIndex> outer_triangles(const improve::OptimizeInput& input)
  {
    std::vector<LocalIndex> outer;
    for (std::size_t i = 0; i < input.triangle_outside.size(); ++i) {
      if (input.triangle_outside[i] != kNoIndex) continue;
      const auto first = input.triangle_vertices.begin() + static_cast<std::ptrdiff_t>(3 * i);
      outer.insert(outer.end(), first, first + 3);
    }
    return outer;
  }

  bool split_corners_;
};

}  // namespace

std::unique_ptr<improve::Optimizer> make_seam_optimizer(bool split_corners)
{
  return std::make_unique<SeamOptimizer>(split_corners);
}

}  // namespace tessera::subdomain

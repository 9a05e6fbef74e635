// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/seam_optimizer.hpp"

#include <utility>

#include "tessera/optimize/optimize.hpp"

namespace tessera::subdomain {
namespace {

class SeamOptimizer final : public improve::Optimizer {
 public:
  // The fixed vertices are those of the boundary and come first; the optimiser keeps their order.
  [[nodiscard]] improve::TetMesh optimize(
      const improve::OptimizeInput& input,
      const improve::OptimizeSettings& /*settings*/) const override
  {
    optimize::OptimizeResult better = optimize::optimize(
        {.vertex_xyz = input.tets.vertex_xyz, .tet_vertices = input.tets.tet_vertices},
        optimize::standard_schedule());
    return {std::move(better.vertex_xyz), std::move(better.tet_vertices)};
  }
};

}  // namespace

std::unique_ptr<improve::Optimizer> make_seam_optimizer()
{
  return std::make_unique<SeamOptimizer>();
}

}  // namespace tessera::subdomain

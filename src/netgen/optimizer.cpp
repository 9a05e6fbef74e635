// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>

#include <meshing.hpp>

#include "tessera/netgen/factory.hpp"

#include "netgen/netgen_session.hpp"
#include "netgen/optimize_tets.hpp"

namespace tessera::netgen {
namespace {

using improve::OptimizeInput;
using improve::OptimizeSettings;
using improve::TetMesh;

::netgen::MeshingParameters parameters_of(const OptimizeSettings& settings)
{
  ::netgen::MeshingParameters parameters;
  parameters.optimize3d = settings.steps;
  parameters.optsteps3d = settings.rounds;
  parameters.opterrpow = settings.error_power;
  return parameters;
}

class Optimizer final : public improve::Optimizer {
 public:
  [[nodiscard]] TetMesh optimize(const OptimizeInput& input,
                                 const OptimizeSettings& settings) const override
  {
    NetgenSession session(parameters_of(settings));
    return session.run("improve", [&] {
      OrderedTets tets = optimize_tets(input.tets.vertex_xyz, input.tets.tet_vertices,
                                       input.triangle_vertices, input.num_fixed, session);
      return TetMesh{std::move(tets.vertex_xyz), std::move(tets.tet_vertices)};
    });
  }
};

}  // namespace

std::unique_ptr<improve::Optimizer> make_optimizer() { return std::make_unique<Optimizer>(); }

}  // namespace tessera::netgen

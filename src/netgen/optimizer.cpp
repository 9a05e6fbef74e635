// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>
#include <vector>

#include <meshing.hpp>

#include "tessera/netgen/factory.hpp"

#include "netgen/mesh_conversion.hpp"
#include "netgen/netgen_session.hpp"
#include "netgen/skin_mesh.hpp"

namespace tessera::netgen {
namespace {

using improve::OptimizeInput;
using improve::OptimizeSettings;
using improve::TetMesh;
using ::netgen::PointIndex;

::netgen::MeshingParameters parameters_of(const OptimizeSettings& settings)
{
  ::netgen::MeshingParameters parameters;
  parameters.optimize3d = settings.steps;
  parameters.optsteps3d = settings.rounds;
  parameters.opterrpow = settings.error_power;
  return parameters;
}

void add_tets(::netgen::Mesh& mesh, const std::vector<LocalIndex>& tet_vertices)
{
  for (std::size_t t = 0; t < tet_vertices.size(); t += 4) {
    ::netgen::Element tet(4);
    for (std::size_t c = 0; c < 4; ++c) {
      const int place = kNetgenTetOrder[c];
      tet[place] = tet_vertices[t + c] + PointIndex::BASE;
    }
    tet.SetIndex(1);
    mesh.AddVolumeElement(tet);
  }
}

class Optimizer final : public improve::Optimizer {
 public:
  [[nodiscard]] TetMesh optimize(const OptimizeInput& input,
                                 const OptimizeSettings& settings) const override
  {
    NetgenSession session(parameters_of(settings));
    return session.run("improve", [&] { return run(input, session); });
  }

 private:
  static TetMesh run(const OptimizeInput& input, NetgenSession& session)
  {
    const auto num_vertices = static_cast<LocalIndex>(input.tets.vertex_xyz.size() / 3);
    const std::vector<LocalIndex> as_given = point_order(num_vertices, 0);
    ::netgen::Mesh mesh;
    add_surface(mesh, input.tets.vertex_xyz, input.triangle_vertices, as_given);
    add_tets(mesh, input.tets.tet_vertices);
    // No background size: the optimiser goes by shape alone, its result is the same with one.
    ::netgen::OptimizeVolume(session.parameters(), mesh);
    mesh.Compress();
    OrderedTets tets = tets_of(mesh, point_order(input.num_fixed, 0));
    return {std::move(tets.vertex_xyz), std::move(tets.tet_vertices)};
  }
};

}  // namespace

std::unique_ptr<improve::Optimizer> make_optimizer() { return std::make_unique<Optimizer>(); }

}  // namespace tessera::netgen

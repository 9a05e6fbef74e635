// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_steps.hpp"

namespace tessera::netgen {
namespace {

// NETGEN's global of how fine it is where edges run beside each other. 1 is its own value.
class CloseEdges {
 public:
  explicit CloseEdges(double factor) { ::netgen::occparam.resthcloseedgefac = factor; }
  ~CloseEdges() { ::netgen::occparam.resthcloseedgefac = 1.0; }
  CloseEdges(const CloseEdges&) = delete;
  CloseEdges& operator=(const CloseEdges&) = delete;
};

// A mesh with its sizes, NETGEN's first step. Where edges run beside each other, those of the mesh
// are at most `close_edges` times as long as these are apart.
std::shared_ptr<::netgen::Mesh> with_sizes(::netgen::OCCGeometry& geometry,
                                           ::netgen::MeshingParameters& parameters,
                                           double close_edges)
{
  parameters.perfstepsstart = ::netgen::MESHCONST_ANALYSE;
  parameters.perfstepsend = ::netgen::MESHCONST_ANALYSE;
  std::shared_ptr<::netgen::Mesh> mesh;
  const CloseEdges fineness(1.0 / close_edges);
  return geometry.GenerateMesh(mesh, parameters) == 0 ? mesh : nullptr;
}

// Of a ledge or a narrow gap that is long NETGEN would make nearly all of the mesh. So where there
// are many cells of sizes, and most of them for close edges, these get longer ones.
std::shared_ptr<::netgen::Mesh> with_fair_sizes(::netgen::OCCGeometry& geometry,
                                                ::netgen::MeshingParameters& parameters)
{
  constexpr int kManyCells = 100'000;  // About as many as tets.
  constexpr double kEdgesOfGap = 4.0;
  const auto num_cells = [](::netgen::Mesh& mesh) { return mesh.LocalHFunction().GetNBoxes(); };
  auto mesh = with_sizes(geometry, parameters, 1.0);
  if (mesh == nullptr || num_cells(*mesh) < kManyCells) return mesh;
  auto coarser = with_sizes(geometry, parameters, kEdgesOfGap);
  return coarser != nullptr && 2 * num_cells(*coarser) < num_cells(*mesh) ? coarser : mesh;
}

}  // namespace

std::shared_ptr<::netgen::Mesh> mesh_occ_surface(::netgen::OCCGeometry& geometry,
                                                 ::netgen::MeshingParameters& parameters)
{
  auto mesh = with_fair_sizes(geometry, parameters);
  if (mesh == nullptr) return nullptr;
  for (const auto& wanted : parameters.meshsize_points) mesh->RestrictLocalH(wanted.pnt, wanted.h);
  parameters.perfstepsstart = ::netgen::MESHCONST_MESHEDGES;
  parameters.perfstepsend = ::netgen::MESHCONST_OPTSURFACE;
  return geometry.GenerateMesh(mesh, parameters) == 0 ? mesh : nullptr;
}

}  // namespace tessera::netgen

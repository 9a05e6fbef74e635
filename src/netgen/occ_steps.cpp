// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_steps.hpp"

#include <utility>

#include "tessera/base/repair.hpp"

#include "netgen/netgen_versions.hpp"

namespace tessera::netgen {
namespace {

// How fine sizes are, as parts of what is asked for.
struct Fineness {
  double close_edges = 1.0;  // Edges run beside each other 1 / close_edges of their length apart.
  double curvature = 1.0;
};

// NETGEN's own values with some of them changed, while this lives. Both are read from globals.
class ChangedFineness {
 public:
  ChangedFineness(::netgen::MeshingParameters& parameters, const Fineness& fineness)
      : parameters_(parameters), curvature_(parameters.curvaturesafety)
  {
    set_close_edges(parameters, fineness.close_edges);
    parameters.curvaturesafety *= fineness.curvature;
  }
  ~ChangedFineness()
  {
    set_close_edges(parameters_, 1.0);
    parameters_.curvaturesafety = curvature_;
  }
  ChangedFineness(const ChangedFineness&) = delete;
  ChangedFineness& operator=(const ChangedFineness&) = delete;

 private:
  ::netgen::MeshingParameters& parameters_;
  double curvature_;
};

// A mesh with its sizes, NETGEN's first step.
std::shared_ptr<::netgen::Mesh> with_sizes(::netgen::OCCGeometry& geometry,
                                           ::netgen::MeshingParameters& parameters,
                                           const Fineness& fineness)
{
  parameters.perfstepsstart = ::netgen::MESHCONST_ANALYSE;
  parameters.perfstepsend = ::netgen::MESHCONST_ANALYSE;
  auto mesh = empty_mesh(geometry);
  const ChangedFineness changed(parameters, fineness);
  return geometry.GenerateMesh(mesh, parameters) == 0 ? mesh : nullptr;
}

// Of a ledge or a narrow gap that is long, or of small rounded edges, NETGEN would make nearly all
// of the mesh. So where there are many cells of sizes, and most of them for one of these, it is
// meshed coarser. Rounded edges get worse tets by that: so only where there are very many.
std::shared_ptr<::netgen::Mesh> with_fair_sizes(::netgen::OCCGeometry& geometry,
                                                ::netgen::MeshingParameters& parameters)
{
  // A cell is about a tet.
  constexpr int kManyForCloseEdges = 100'000;
  constexpr int kManyForCurvature = 500'000;
  constexpr double kOfCloseEdges = 0.25;
  constexpr double kOfCurvature = 0.4;
  const auto num_cells = [](::netgen::Mesh& mesh) { return mesh.LocalHFunction().GetNBoxes(); };
  Fineness fineness;
  auto mesh = with_sizes(geometry, parameters, fineness);
  const auto take_if_much_smaller = [&](Repair repair, int many, const Fineness& coarser) {
    if (mesh == nullptr || num_cells(*mesh) < many || is_left_out(repair)) return;
    auto other = with_sizes(geometry, parameters, coarser);
    if (other == nullptr || 2 * num_cells(*other) >= num_cells(*mesh)) return;
    mesh = std::move(other);
    fineness = coarser;
    note_repair(repair);
  };
  take_if_much_smaller(Repair::longer_close_edges, kManyForCloseEdges,
                       {kOfCloseEdges, fineness.curvature});
  take_if_much_smaller(Repair::longer_curved_edges, kManyForCurvature,
                       {fineness.close_edges, kOfCurvature});
  return mesh;
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

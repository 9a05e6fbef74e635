// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/surface/cad_steps.hpp"

#include "netgen/versions.hpp"

namespace tessera::netgen {

std::shared_ptr<::netgen::Mesh> mesh_occ_surface(::netgen::OCCGeometry& geometry,
                                                 ::netgen::MeshingParameters& parameters)
{
  constexpr double kCloseEdges = 1.0;  // Edges that run beside each other are as long as apart.
  set_close_edges(parameters, kCloseEdges);
  auto mesh = empty_mesh(geometry);
  const auto do_steps = [&](int first, int last) {
    parameters.perfstepsstart = first;
    parameters.perfstepsend = last;
    return geometry.GenerateMesh(mesh, parameters) == 0;
  };
  if (!do_steps(::netgen::MESHCONST_ANALYSE, ::netgen::MESHCONST_ANALYSE)) return nullptr;
  for (const auto& wanted : parameters.meshsize_points) mesh->RestrictLocalH(wanted.pnt, wanted.h);
  const bool is_done = do_steps(::netgen::MESHCONST_MESHEDGES, ::netgen::MESHCONST_OPTSURFACE);
  return is_done ? mesh : nullptr;
}

}  // namespace tessera::netgen

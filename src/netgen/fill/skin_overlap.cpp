// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/fill/skin_overlap.hpp"

#include <meshing.hpp>

#include "netgen/fill/skin_mesh.hpp"
#include "netgen/session.hpp"

namespace tessera::netgen {

bool cuts_itself(const fill::FillInput& skin)
{
  NetgenSession session{::netgen::MeshingParameters()};
  return session.run("overlap test", [&] {
    ::netgen::Mesh mesh;
    add_surface(mesh, skin.vertex_xyz, skin.triangle_vertices,
                point_order(static_cast<LocalIndex>(skin.vertex_xyz.size() / 3), 0));
    mesh.FindOpenElements();
    return mesh.CheckOverlappingBoundary() != 0;
  });
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/optimize_tets.hpp"

#include <meshing.hpp>

#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {
OrderedTets optimize_tets(const std::vector<double>& vertex_xyz,
                          const std::vector<LocalIndex>& tet_vertices,
                          const std::vector<LocalIndex>& triangle_vertices, LocalIndex num_fixed,
                          NetgenSession& session)
{
  const auto num_vertices = static_cast<LocalIndex>(vertex_xyz.size() / 3);
  const std::vector<LocalIndex> as_given = point_order(num_vertices, 0);
  ::netgen::Mesh mesh;
  add_surface(mesh, vertex_xyz, triangle_vertices, as_given);
  add_tets(mesh, tet_vertices);
  ::netgen::OptimizeVolume(session.parameters(), mesh);
  mesh.Compress();
  return tets_of(mesh, point_order(num_fixed, 0));
}

}  // namespace tessera::netgen

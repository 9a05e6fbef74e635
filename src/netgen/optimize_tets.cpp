// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/optimize_tets.hpp"

#include <meshing.hpp>

#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

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

}  // namespace

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

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/improve_seam_region.hpp"

#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/quality/statistics.hpp"

namespace tessera::subdomain {
namespace {

improve::ShapeSummary measure_shapes(const improve::TetMesh& mesh)
{
  quality::Histogram unused(0.0, 1.0, 1);
  quality::ShapeSum sum(unused);
  for (std::size_t t = 0; 4 * t < mesh.tet_vertices.size(); ++t) {
    sum.add(quality::shape_of(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t)));
  }
  const quality::TetStatistics shapes = sum.statistics();
  return {shapes.min_dihedral_deg, shapes.min_mean_ratio, shapes.mean_mean_ratio()};
}

}  // namespace

RegionRecord improve_tets(const improve::RegionMesh& mesh, int rounds,
                          const improve::Optimizer& optimizer)
{
  RegionRecord record;
  if (mesh.num_tets() == 0) {
    record.reason = "other regions have all its tets";
  } else {
    improve::RegionOutcome outcome =
        improve::improve_region(mesh, optimizer, rounds, measure_shapes);
    record.is_improved = outcome.is_accepted;
    record.reason = std::move(outcome.reason);
    record.updates = std::move(outcome.updates);
  }
  return record;
}

}  // namespace tessera::subdomain

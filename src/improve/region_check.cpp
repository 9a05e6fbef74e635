// SPDX-License-Identifier: BSD-3-Clause
#include "improve/region_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/surface_match.hpp"

namespace tessera::improve {
namespace {

// Sums over the old and the new tets differ by rounding only.
constexpr double kVolumeTolerance = 1e-9;

void require_fixed_kept(const RegionMesh& mesh, const TetMesh& tets)
{
  const std::size_t size = 3 * at(mesh.num_fixed());
  if (tets.vertex_xyz.size() < size
      || std::memcmp(tets.vertex_xyz.data(), mesh.vertex_xyz.data(), size * sizeof(double)) != 0) {
    throw MeshError("the optimiser moved or lost vertices of the boundary");
  }
}

void require_in_range(const TetMesh& tets)
{
  const auto num_vertices = static_cast<LocalIndex>(tets.vertex_xyz.size() / 3);
  const auto wrong = std::find_if(tets.tet_vertices.begin(), tets.tet_vertices.end(),
                                  [&](LocalIndex v) { return v < 0 || v >= num_vertices; });
  if (wrong != tets.tet_vertices.end()) {
    throw MeshError(fmt::format("an optimised tet names vertex {} of {}", *wrong, num_vertices));
  }
}

double positive_volume(const std::vector<double>& vertex_xyz,
                       const std::vector<LocalIndex>& tet_vertices)
{
  double sum = 0.0;
  for (std::size_t t = 0; 4 * t < tet_vertices.size(); ++t) {
    const double volume = tet_volume(corners_at<4>(vertex_xyz, tet_vertices, t));
    if (!(volume > 0.0)) {  // Written so that a NaN counts.
      throw MeshError(fmt::format("optimised tet {} has volume {:g}", t, volume));
    }
    sum += volume;
  }
  return sum;
}

std::vector<LocalIndex> match_boundary(const RegionMesh& mesh, const TetMesh& tets)
{
  mesh::SurfaceMatch match =
      mesh::match_surface(mesh.triangle_vertices, mesh.num_fixed(), tets.tet_vertices);
  const auto& behind = match.triangle_tet;
  if (!match.is_closed || std::find(behind.begin(), behind.end(), kNoIndex) != behind.end()) {
    throw MeshError("the optimised tets' boundary is not the old one");
  }
  return std::move(match.triangle_tet);
}

}  // namespace

std::vector<LocalIndex> check_tets(const RegionMesh& mesh, const TetMesh& tets)
{
  require_fixed_kept(mesh, tets);
  require_in_range(tets);
  std::vector<LocalIndex> behind = match_boundary(mesh, tets);
  const double volume = positive_volume(tets.vertex_xyz, tets.tet_vertices);
  const double before = positive_volume(mesh.vertex_xyz, mesh.tet_vertices);
  if (!(std::abs(volume - before) <= kVolumeTolerance * before)) {
    throw MeshError(fmt::format("the optimised tets' volume {:.12g} is not the old one {:.12g}",
                                volume, before));
  }
  return behind;
}

}  // namespace tessera::improve

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/delaunay/tetrahedralize.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/delaunay/predicates.hpp"
#include "tessera/mesh/tet_neighbours.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "delaunay/insertion_order.hpp"
#include "delaunay/join_stars.hpp"
#include "delaunay/lattice_stars.hpp"
#include "delaunay/triangulation.hpp"

namespace tessera::delaunay {
namespace {

bool is_exact(double x)
{
  const double size = std::abs(x);
  return size == 0.0 || (size >= kLeastCoordinate && size <= kMostCoordinate);
}

void require_exact(std::span<const double> xyz)
{
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    if (is_exact(xyz[i])) continue;
    throw MeshError(
        fmt::format("point {} has the coordinate {:g}; coordinates are zero or between "
                    "{:g} and {:g}",
                    i / 3, xyz[i], kLeastCoordinate, kMostCoordinate));
  }
}

// The order depends on the tets alone: corners ascend but for what makes a tet positive, and tets
// come by their corners.
std::vector<LocalIndex> in_order(std::span<const LocalIndex> tet_vertices, std::size_t num_points)
{
  std::vector<LocalIndex> lowest(tet_vertices.size() / 4);
  std::vector<std::array<LocalIndex, 4>> tets(lowest.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const mesh::SortedTet sorted = mesh::sorted_tet(tet_vertices.subspan(4 * t).first<4>());
    tets[t] = sorted.vertices;
    if (!sorted.is_even) std::swap(tets[t][2], tets[t][3]);
    lowest[t] = tets[t][0];
  }
  const IndexLists by_lowest = rows_by_key(lowest, static_cast<LocalIndex>(num_points));
  std::vector<LocalIndex> result;
  result.reserve(tet_vertices.size());
  std::vector<std::array<LocalIndex, 4>> together;
  for (LocalIndex v = 0; v < by_lowest.num_lists(); ++v) {
    together.clear();
    for (const LocalIndex t : by_lowest[v]) together.push_back(tets[at(t)]);
    std::ranges::sort(together);
    for (const auto& tet : together) result.insert(result.end(), tet.begin(), tet.end());
  }
  return result;
}

std::vector<LocalIndex> tets_of(std::span<const Vec3> points, const LatticeStars& stars)
{
  std::vector<LocalIndex> order;
  for (LocalIndex row = 0; at(row) < points.size(); ++row) {
    if (stars.is_closed[at(row)] == 0) order.push_back(row);
  }
  sort_by_round(points, order);
  std::vector<Vec3> others;
  others.reserve(order.size());
  for (const LocalIndex row : order) others.push_back(points[at(row)]);
  Triangulation triangulation(std::move(others));
  triangulation.insert_all();
  return join_stars(triangulation, order, stars);
}

}  // namespace

Tetrahedralization tetrahedralize(std::span<const double> xyz, std::span<const double> lattice_side)
{
  require_exact(xyz);
  const std::vector<LocalIndex> curve = along_curve(xyz);
  std::vector<Vec3> points;
  std::vector<double> sides;
  points.reserve(curve.size());
  for (const LocalIndex row : curve) {
    points.push_back(point_at(xyz, row));
    if (!lattice_side.empty()) sides.push_back(lattice_side[at(row)]);
  }
  Tetrahedralization result;
  result.tet_vertices = in_order(tets_of(points, lattice_stars(points, sides)), points.size());
  result.tet_neighbours =
      mesh::find_tet_neighbours(result.tet_vertices, static_cast<LocalIndex>(points.size()));
  for (LocalIndex& v : result.tet_vertices) v = curve[at(v)];
  return result;
}

}  // namespace tessera::delaunay

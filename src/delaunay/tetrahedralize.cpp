// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/delaunay/tetrahedralize.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/delaunay/predicates.hpp"

#include "delaunay/insertion_order.hpp"
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

// Tets without ghosts and free slots; vertices are rows of the caller's points.
Tetrahedralization compact(const Triangulation& triangulation, const std::vector<LocalIndex>& order)
{
  const LocalIndex num_slots = triangulation.num_slots();
  std::vector<LocalIndex> new_tet(at(num_slots), kNoIndex);
  LocalIndex num_tets = 0;
  for (LocalIndex slot = 0; slot < num_slots; ++slot) {
    if (triangulation.has_tet(slot)) new_tet[at(slot)] = num_tets++;
  }
  Tetrahedralization result;
  result.tet_vertices.reserve(4 * at(num_tets));
  result.tet_neighbours.reserve(4 * at(num_tets));
  for (LocalIndex slot = 0; slot < num_slots; ++slot) {
    if (new_tet[at(slot)] == kNoIndex) continue;
    for (const LocalIndex v : triangulation.vertices(slot)) {
      result.tet_vertices.push_back(order[at(v)]);
    }
    for (Corner corner = 4 * slot; tet_of(corner) == slot; ++corner) {
      const Corner across = triangulation.across(corner);
      const LocalIndex tet = new_tet[at(tet_of(across))];
      result.tet_neighbours.push_back(tet == kNoIndex ? kNoIndex : 4 * tet + (across & 3));
    }
  }
  return result;
}

}  // namespace

Tetrahedralization tetrahedralize(std::span<const double> xyz)
{
  require_exact(xyz);
  const std::vector<LocalIndex> order = insertion_order(xyz);
  std::vector<Vec3> points;
  points.reserve(order.size());
  for (const LocalIndex row : order) points.push_back(point_at(xyz, row));
  Triangulation triangulation(std::move(points));
  triangulation.insert_all();
  return compact(triangulation, order);
}

}  // namespace tessera::delaunay

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

// A face of stars whose corners all have tets beside the stars too.
struct Wall {
  std::array<LocalIndex, 3> key{};
  bool is_even = false;  // As seen from the tet of the star.

  friend auto operator<=>(const Wall&, const Wall&) = default;
};

Wall wall_at(const std::array<LocalIndex, 4>& tet, std::size_t corner)
{
  const auto& [a, b, c] = mesh::kTetFaceCorners[corner];
  return {mesh::sorted_triangle(tet[a], tet[b], tet[c]),
          mesh::is_even_triangle(tet[a], tet[b], tet[c])};
}

std::vector<Wall> walls_of(const LatticeStars& stars)
{
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < stars.tet_vertices.size(); i += 4) {
    const LocalIndex* v = &stars.tet_vertices[i];
    const std::array<LocalIndex, 4> tet{v[0], v[1], v[2], v[3]};
    const auto is_closed = [&stars](LocalIndex row) { return stars.is_closed[at(row)] != 0; };
    if (std::ranges::count_if(tet, is_closed) != 1) continue;
    const auto corner = std::ranges::find_if(tet, is_closed) - tet.begin();
    walls.push_back(wall_at(tet, static_cast<std::size_t>(corner)));
  }
  std::ranges::sort(walls);
  return walls;
}

// Delaunay tets of the points that are not closed, and those of stars. Their faces between both are
// faces of both, since the spheres that make them hold no point at all. What tets of the others are
// on the inner side of such a face is where the stars are.
class Joiner {
 public:
  // `order[v]` is the row of vertex v.
  Joiner(const Triangulation& triangulation, std::span<const LocalIndex> order,
         const LatticeStars& stars)
      : triangulation_(triangulation),
        order_(order),
        walls_(walls_of(stars)),
        tet_vertices_(stars.tet_vertices),
        is_at_wall_(stars.is_closed.size(), 0),
        is_wall_(4 * at(triangulation.num_slots()), 0),
        is_in_stars_(at(triangulation.num_slots()), 0)
  {
  }

  // Shape (num_tets, 4): rows.
  std::vector<LocalIndex> run()
  {
    if (!walls_.empty()) find_inner();
    for (LocalIndex slot = 0; slot < triangulation_.num_slots(); ++slot) {
      if (!triangulation_.has_tet(slot) || is_in_stars_[at(slot)] != 0) continue;
      const auto tet = rows_of(slot);
      tet_vertices_.insert(tet_vertices_.end(), tet.begin(), tet.end());
    }
    return std::move(tet_vertices_);
  }

 private:
  [[nodiscard]] std::array<LocalIndex, 4> rows_of(LocalIndex slot) const
  {
    const auto v = triangulation_.vertices(slot);
    return {order_[at(v[0])], order_[at(v[1])], order_[at(v[2])], order_[at(v[3])]};
  }

  void find_inner()
  {
    for (const Wall& wall : walls_) {
      for (const LocalIndex row : wall.key) is_at_wall_[at(row)] = 1;
    }
    std::vector<LocalIndex> inner;
    for (LocalIndex slot = 0; slot < triangulation_.num_slots(); ++slot) {
      if (triangulation_.has_tet(slot) && find_walls(slot)) inner.push_back(slot);
    }
    flood(std::move(inner));
  }

  // Marks the faces of a tet behind which stars end; whether there are some.
  bool find_walls(LocalIndex slot)
  {
    const std::array<LocalIndex, 4> tet = rows_of(slot);
    std::size_t num_at_wall = 0;
    for (const LocalIndex row : tet) num_at_wall += is_at_wall_[at(row)] != 0 ? 1U : 0U;
    if (num_at_wall < 3) return false;
    bool is_inner = false;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      if (!std::ranges::binary_search(walls_, wall_at(tet, corner))) continue;
      is_wall_[4 * at(slot) + corner] = 1;
      is_inner = true;
    }
    return is_inner;
  }

  void flood(std::vector<LocalIndex> inner)
  {
    for (const LocalIndex slot : inner) is_in_stars_[at(slot)] = 1;
    while (!inner.empty()) {
      const LocalIndex slot = inner.back();
      inner.pop_back();
      for (Corner corner = 4 * slot; tet_of(corner) == slot; ++corner) {
        const LocalIndex next = tet_of(triangulation_.across(corner));
        if (is_wall_[at(corner)] != 0 || is_in_stars_[at(next)] != 0) continue;
        is_in_stars_[at(next)] = 1;
        inner.push_back(next);
      }
    }
  }

  const Triangulation& triangulation_;
  std::span<const LocalIndex> order_;
  std::vector<Wall> walls_;  // Ascending.
  std::vector<LocalIndex> tet_vertices_;
  std::vector<char> is_at_wall_;   // Shape (num_points).
  std::vector<char> is_wall_;      // Shape (num_slots, 4).
  std::vector<char> is_in_stars_;  // Shape (num_slots).
};

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
  return Joiner(triangulation, order, stars).run();
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

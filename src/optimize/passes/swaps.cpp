// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/passes/swaps.hpp"

#include <algorithm>

#include "tessera/base/cheapest_triangulation.hpp"

#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

double cost_of_tets(const WorkingMesh& mesh, std::span<const LocalIndex> tets)
{
  double cost = 0.0;
  for (const LocalIndex t : tets) cost += mesh.tet_cost[at(t)];
  return cost;
}

void begin_swap(std::span<const LocalIndex> old_tets, Swap& swap)
{
  swap.num_old = old_tets.size();
  swap.num_new = 0;
  std::copy(old_tets.begin(), old_tets.end(), swap.old_tets.begin());
}

// The two tets on a triangle of the ring; i, j, k ascend along it.
struct Triangle {
  std::size_t i, j, k;
};

void add_tets_on(const EdgeRing& ring, const Triangle& triangle, double energy_a, double energy_b,
                 Swap& swap)
{
  const LocalIndex i = ring.vertices[triangle.i];
  const LocalIndex j = ring.vertices[triangle.j];
  const LocalIndex k = ring.vertices[triangle.k];
  swap.add({i, j, k, ring.b}, energy_b);
  swap.add({j, i, k, ring.a}, energy_a);
}

// Rings of three and four: nearly all there are. A ring of three is one of four whose last vertex
// stands twice; of it the first triangle counts.
class SmallRing {
 public:
  SmallRing(const WorkingMesh& mesh, const EdgeRing& ring) : mesh_(mesh), ring_(ring)
  {
    std::array<const Point*, 4> points;
    for (std::size_t i = 0; i < 4; ++i) {
      points[i] = &mesh.points[at(ring.vertices[std::min(i, ring.size - 1)])];
    }
    mesh.kernels->ring_of_four(mesh.points[at(ring.a)], mesh.points[at(ring.b)], points.data(),
                               measured_);
  }

  [[nodiscard]] bool find(double most, Swap& swap) const
  {
    if (ring_.size == 3) return use(0, 1, most, swap);
    const bool first_is_better =
        measured_.cost[0] + measured_.cost[1] <= measured_.cost[2] + measured_.cost[3];
    return use(first_is_better ? 0 : 2, 2, most, swap);
  }

 private:
  // Takes `num` triangles if they cost less than `most`.
  [[nodiscard]] bool use(std::size_t first, std::size_t num, double most, Swap& swap) const
  {
    static constexpr std::array<Triangle, 4> kTriangles{
        {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}};
    double cost = 0.0;
    for (std::size_t i = first; i < first + num; ++i) {
      const double worst = std::max(measured_.energy_a[i], measured_.energy_b[i]);
      if (!(worst <= mesh_.worst_energy)) return false;
      cost += measured_.cost[i];
    }
    if (!(cost < most)) return false;
    begin_swap(ring_.all_tets(), swap);
    for (std::size_t i = first; i < first + num; ++i) {
      add_tets_on(ring_, kTriangles[i], measured_.energy_a[i], measured_.energy_b[i], swap);
    }
    return true;
  }

  const WorkingMesh& mesh_;
  const EdgeRing& ring_;
  RingOfFour measured_;
};

// Larger rings, of which few pay.
class LargeRing {
 public:
  LargeRing(const WorkingMesh& mesh, const EdgeRing& ring) : mesh_(mesh), ring_(ring) {}

  [[nodiscard]] bool find(double most, Swap& swap) const
  {
    const auto any = [](std::size_t, std::size_t) { return true; };
    const CheapestTriangulation<kMaxRing> cheapest(
        ring_.size, any, [this](double behind, std::size_t i, std::size_t j, std::size_t k) {
          return behind + triangle_cost({i, j, k});
        });
    if (!(cheapest.cost() < most)) return false;
    begin_swap(ring_.all_tets(), swap);
    cheapest.for_each_triangle([&](std::size_t i, std::size_t j, std::size_t k) {
      const Triangle triangle{i, j, k};
      add_tets_on(ring_, triangle, energy_a(triangle), energy_b(triangle), swap);
    });
    return true;
  }

 private:
  [[nodiscard]] const Point& point(std::size_t i) const
  {
    return mesh_.points[at(ring_.vertices[i])];
  }
  [[nodiscard]] double energy_a(const Triangle& t) const
  {
    return tet_energy(point(t.j), point(t.i), point(t.k), mesh_.points[at(ring_.a)]);
  }
  [[nodiscard]] double energy_b(const Triangle& t) const
  {
    return tet_energy(point(t.i), point(t.j), point(t.k), mesh_.points[at(ring_.b)]);
  }
  [[nodiscard]] double triangle_cost(const Triangle& t) const
  {
    const double a = energy_a(t);
    const double b = energy_b(t);
    if (!(std::max(a, b) <= mesh_.worst_energy)) return kInfinity;
    return cost_of_energy(a) + cost_of_energy(b);
  }

  const WorkingMesh& mesh_;
  const EdgeRing& ring_;
};

// No tet costs less than 1, and few less than this: a bound below which looking closer pays.
constexpr double kLeastTetCost = 1.05;

}  // namespace

bool find_edge_removal(const WorkingMesh& mesh, const EdgeRing& ring, double least_gain, Swap& swap)
{
  const double most = cost_of_tets(mesh, ring.all_tets()) - least_gain;
  if (most <= 2.0 * static_cast<double>(ring.size - 2) * kLeastTetCost) return false;
  return ring.size <= 4 ? SmallRing(mesh, ring).find(most, swap)
                        : LargeRing(mesh, ring).find(most, swap);
}

bool find_face_swap(const WorkingMesh& mesh, Corner corner, double least_gain, Swap& swap)
{
  const Corner across = mesh.tet_neighbours[at(corner)];
  if (is_boundary(across)) return false;
  const std::array<LocalIndex, 2> old_tets{tet_of(corner), tet_of(across)};
  const double most = cost_of_tets(mesh, old_tets) - least_gain;
  if (most <= 3.0 * kLeastTetCost) return false;
  begin_swap(old_tets, swap);
  const LocalIndex near = mesh.tet_vertices[at(corner)];
  const LocalIndex far = mesh.tet_vertices[at(across)];
  const std::array<LocalIndex, 3> face = face_vertices(mesh.tet_vertices, corner);
  double cost = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const TetVertices tet{near, far, face[i], face[(i + 1) % 3]};
    const double energy = tet_energy(mesh.points[at(tet[0])], mesh.points[at(tet[1])],
                                     mesh.points[at(tet[2])], mesh.points[at(tet[3])]);
    if (!(energy <= mesh.worst_energy)) return false;
    cost += cost_of_energy(energy);
    swap.add(tet, energy);
  }
  return cost < most;
}

}  // namespace tessera::optimize

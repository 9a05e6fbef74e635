// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Part of kernels/code.hpp: energies of all tets, and of those around an edge.

#include "optimize/kernels/lanes.hpp"

inline void tet_energies_at(const Point* points, const LocalIndex* const tets[4], double* energy,
                            double* cost)
{
  Lanes rows[4][4];
  for (int lane = 0; lane < 4; ++lane) {
    for (int corner = 0; corner < 4; ++corner) {
      const LocalIndex vertex = tets[lane][corner];
      rows[corner][lane] = load(points[vertex < 0 ? 0 : vertex]);
    }
  }
  const Vectors a = transposed(rows[0]);
  const Vectors u = transposed(rows[1]) - a;
  const Vectors v = transposed(rows[2]) - a;
  const Vectors q = transposed(rows[3]) - a;
  const Lanes w = dot(u, cross(v, q));
  const Lanes infinite = all(__builtin_inf());
  const Lanes e = w > 0.0 ? energy_of(sum_of_squares(u, v, q), w) : infinite;
  const Lanes root = square_root(e);
  __builtin_memcpy(energy, &e, sizeof e);
  __builtin_memcpy(cost, &root, sizeof root);
}

void tet_energies(const Point* points, const LocalIndex* tet_vertices, LocalIndex num_slots,
                  double* energy, double* cost)
{
  for (LocalIndex first = 0; first < num_slots; first += 4) {
    const LocalIndex* tets[4];
    for (LocalIndex lane = 0; lane < 4; ++lane) {
      const LocalIndex t = first + lane < num_slots ? first + lane : num_slots - 1;
      tets[lane] = tet_vertices + 4 * static_cast<long>(t);
    }
    double e[4];
    double root[4];
    tet_energies_at(points, tets, e, root);
    const LocalIndex num = num_slots - first < 4 ? num_slots - first : 4;
    for (LocalIndex lane = 0; lane < num; ++lane) {
      energy[first + lane] = e[lane];
      cost[first + lane] = root[lane];
    }
  }
}

inline Vectors picked(const Vectors& v, int which)
{
  if (which == 0) {
    return {__builtin_shufflevector(v.x, v.x, 0, 0, 0, 1),
            __builtin_shufflevector(v.y, v.y, 0, 0, 0, 1),
            __builtin_shufflevector(v.z, v.z, 0, 0, 0, 1)};
  }
  if (which == 1) {
    return {__builtin_shufflevector(v.x, v.x, 1, 2, 1, 2),
            __builtin_shufflevector(v.y, v.y, 1, 2, 1, 2),
            __builtin_shufflevector(v.z, v.z, 1, 2, 1, 2)};
  }
  return {__builtin_shufflevector(v.x, v.x, 2, 3, 3, 3),
          __builtin_shufflevector(v.y, v.y, 2, 3, 3, 3),
          __builtin_shufflevector(v.z, v.z, 2, 3, 3, 3)};
}

// Energies of the tets on the four triangles of the ring with one end of the edge. Sign: 1 if the
// ring turns about the end as about the inside.
inline Lanes triangle_energies(const Point& end, const Point* const* ring, double sign)
{
  const Lanes origin = load(end);
  const Lanes rows[4] = {load(*ring[0]) - origin, load(*ring[1]) - origin, load(*ring[2]) - origin,
                         load(*ring[3]) - origin};
  const Vectors v = transposed(rows);
  const Vectors i = picked(v, 0);
  const Vectors j = picked(v, 1);
  const Vectors k = picked(v, 2);
  const Lanes w = sign * dot(cross(i, j), k);
  const Lanes infinite = all(__builtin_inf());
  return w > 0.0 ? energy_of(sum_of_squares(i, j, k), w) : infinite;
}

void measure_ring_of_four(const Point& a, const Point& b, const Point* const* ring,
                          RingOfFour& result)
{
  const Lanes energy_a = triangle_energies(a, ring, 1.0);
  const Lanes energy_b = triangle_energies(b, ring, -1.0);
  const Lanes cost = square_root(energy_a) + square_root(energy_b);
  __builtin_memcpy(result.cost, &cost, sizeof cost);
  __builtin_memcpy(result.energy_a, &energy_a, sizeof energy_a);
  __builtin_memcpy(result.energy_b, &energy_b, sizeof energy_b);
}

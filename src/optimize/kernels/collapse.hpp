// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Part of kernels/code.hpp: where a vertex had best be merged into.

#include "optimize/kernels/star.hpp"

// The vertices of the faces opposite to a vertex, and its neighbours.
struct Links {
  LaneIds ids[kMaxStar / 4][3];
  LocalIndex neighbours[kMaxStar];
  double squared_lengths[kMaxStar];  // Of the edges to the neighbours.
  LocalIndex num_neighbours;
};

inline void add_neighbour(const StarView& mesh, Lanes origin, LocalIndex vertex, Links& links)
{
  for (LocalIndex i = 0; i < links.num_neighbours; ++i) {
    if (links.neighbours[i] == vertex) return;
  }
  if (links.num_neighbours == kMaxStar) return;
  const Lanes edge = load(mesh.points[vertex]) - origin;
  links.squared_lengths[links.num_neighbours] = sum_of(edge * edge);
  links.neighbours[links.num_neighbours++] = vertex;
}

inline void gather_links(const StarView& mesh, LocalIndex vertex, Links& links)
{
  const Lanes origin = load(mesh.points[vertex]);
  const LocalIndex first = mesh.offsets[vertex];
  const LocalIndex num_tets = mesh.offsets[vertex + 1] - first;
  links.num_neighbours = 0;
  for (LocalIndex i = 0; i < num_tets; ++i) {
    for (LocalIndex k = 0; k < 3; ++k) {
      const LocalIndex id = mesh.tet_vertices[mesh.corners[first + i] ^ (k + 1)];
      links.ids[i / 4][k][i % 4] = id;
      add_neighbour(mesh, origin, id, links);
    }
  }
  for (LocalIndex i = num_tets; i % 4 != 0; ++i) {  // Padding: tets of no vertex at all.
    for (LocalIndex k = 0; k < 3; ++k) links.ids[i / 4][k][i % 4] = kNoIndex;
  }
}

inline double mean_squared_length(const Links& links)
{
  double sum = 0.0;
  for (LocalIndex i = 0; i < links.num_neighbours; ++i) sum += links.squared_lengths[i];
  return sum / static_cast<double>(links.num_neighbours);
}

// Mean cost of the tets that are left if the vertex moves onto `target`, by `d`. Tets with the
// target vanish. Infinite if one that is left would be flat, inverted or worse than allowed.
inline double collapsed_cost(const Star& star, const Links& links, LocalIndex target, Lanes d,
                             double worst_energy)
{
  const Vectors step{all(d[0]), all(d[1]), all(d[2])};
  const Lanes squared = 3.0 * dot(step, step);
  Lanes sum{};
  Lanes count{};
  Lanes worst{};
  Lanes least_w = all(kHuge);
  for (int i = 0; i < star.num_blocks; ++i) {
    const StarBlock& block = star.blocks[i];
    const LaneIds* ids = links.ids[i];
    const LaneIds vanishes =
        (ids[0] == target) | (ids[1] == target) | (ids[2] == target) | (ids[0] == kNoIndex);
    const LaneMask out = __builtin_convertvector(vanishes, LaneMask);
    const Lanes w = out ? all(kHuge) : block.w + dot(block.inward, step);
    const Lanes e = energy_of(block.squares - 2.0 * dot(block.opposite, step) + squared, w);
    least_w = smaller(w, least_w);
    worst = larger(e, worst);
    sum += out ? Lanes{} : square_root(e);
    count += out ? Lanes{} : all(1.0);
  }
  const bool is_valid = all_positive(least_w) && all_within(worst, worst_energy);
  return is_valid ? sum_of(sum) / sum_of(count) : __builtin_inf();
}

LocalIndex find_best_collapse(const CollapseTask& task, LocalIndex vertex)
{
  Star star;
  Links links;
  gather_star(task.stars, vertex, star);
  gather_links(task.stars, vertex, links);
  const Lanes origin = load(task.stars.points[vertex]);
  const double longest = task.reach * task.reach * mean_squared_length(links);
  LocalIndex best = kNoIndex;
  double best_cost = task.max_mean_cost;
  for (LocalIndex i = 0; i < links.num_neighbours; ++i) {
    if (links.squared_lengths[i] > longest) continue;
    const LocalIndex target = links.neighbours[i];
    const Lanes step = load(task.stars.points[target]) - origin;
    const double cost = collapsed_cost(star, links, target, step, task.worst_energy);
    if (cost < best_cost) {
      best_cost = cost;
      best = target;
    }
  }
  return best;
}

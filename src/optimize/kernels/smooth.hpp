// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Part of kernels/code.hpp: smoothing by Newton steps.

#include "optimize/kernels/star.hpp"

template <int Power>
inline Lanes power_of(Lanes energy)
{
  if constexpr (Power == 1) return energy;
  const Lanes squared = energy * energy;
  return squared * squared;
}

// Value, gradient and Hessian of the sum of energy^Power at the vertex, lane by lane.
struct Quadratic {
  Lanes value{};
  Vectors gradient{};
  Lanes xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

// With f = s^p / w^q: grad f = f l, l = p s'/s - q w'/w, and the Hessian is
// f (l l' + p (s''/s - (s'/s) (s'/s)') + q (w'/w) (w'/w)').
template <int Power>
inline void add_block(const StarBlock& block, Quadratic& sum)
{
  constexpr double kP = 3.0 * Power;
  constexpr double kQ = 2.0 * Power;
  const Lanes reciprocal = 1.0 / (block.squares * block.w);
  const Lanes per_squares = block.w * reciprocal;
  const Lanes per_w = block.squares * reciprocal;
  const Lanes s = block.squares;
  const Lanes f = power_of<Power>(kFactor * (s * s * s) * (per_w * per_w));
  const Vectors ds = (-2.0 * per_squares) * block.opposite;
  const Vectors dw = per_w * block.inward;
  const Vectors l{kP * ds.x - kQ * dw.x, kP * ds.y - kQ * dw.y, kP * ds.z - kQ * dw.z};
  const Vectors fl = f * l;
  const Vectors fs = (kP * f) * ds;
  const Vectors fw = (kQ * f) * dw;
  const Lanes diagonal = (6.0 * kP) * f * per_squares;
  sum.value += f;
  sum.gradient = sum.gradient + fl;
  sum.xx += fl.x * l.x + diagonal - fs.x * ds.x + fw.x * dw.x;
  sum.yy += fl.y * l.y + diagonal - fs.y * ds.y + fw.y * dw.y;
  sum.zz += fl.z * l.z + diagonal - fs.z * ds.z + fw.z * dw.z;
  sum.xy += fl.x * l.y - fs.x * ds.y + fw.x * dw.y;
  sum.xz += fl.x * l.z - fs.x * ds.z + fw.x * dw.z;
  sum.yz += fl.y * l.z - fs.y * ds.z + fw.y * dw.z;
}

// The step to the least value of the quadratic; zero if that is not certain.
inline Lanes newton_step(const Quadratic& sum)
{
  const double xx = sum_of(sum.xx);
  const double xy = sum_of(sum.xy);
  const double xz = sum_of(sum.xz);
  const double yy = sum_of(sum.yy);
  const double yz = sum_of(sum.yz);
  const double zz = sum_of(sum.zz);
  const double gx = sum_of(sum.gradient.x);
  const double gy = sum_of(sum.gradient.y);
  const double gz = sum_of(sum.gradient.z);
  const double c00 = yy * zz - yz * yz;
  const double c01 = xz * yz - xy * zz;
  const double c02 = xy * yz - xz * yy;
  const double determinant = xx * c00 + xy * c01 + xz * c02;
  if (!(determinant > 0.0)) return Lanes{};
  const double c11 = xx * zz - xz * xz;
  const double c12 = xy * xz - xx * yz;
  const double c22 = xx * yy - xy * xy;
  const double factor = -1.0 / determinant;
  return Lanes{factor * (c00 * gx + c01 * gy + c02 * gz), factor * (c01 * gx + c11 * gy + c12 * gz),
               factor * (c02 * gx + c12 * gy + c22 * gz), 0.0};
}

// Sum of energy^Power if the vertex moves by d; infinite if a tet would be flat, inverted or worse
// than allowed.
template <int Power>
inline double moved_energy(const Star& star, Lanes d, double worst_energy)
{
  const Vectors step{all(d[0]), all(d[1]), all(d[2])};
  const Lanes squared = 3.0 * dot(step, step);
  Lanes sum{};
  Lanes worst{};
  Lanes least_w = all(kHuge);
  for (int i = 0; i < star.num_blocks; ++i) {
    const StarBlock& block = star.blocks[i];
    const Lanes w = block.w + dot(block.inward, step);
    const Lanes e = energy_of(block.squares - 2.0 * dot(block.opposite, step) + squared, w);
    least_w = smaller(w, least_w);
    worst = larger(e, worst);
    sum += power_of<Power>(e);
  }
  const bool is_valid = all_positive(least_w) && all_within(worst, worst_energy);
  return is_valid ? sum_of(sum) : __builtin_inf();
}

// Mean of the squared edges around the vertex, each tet's counted.
inline double mean_squared_edge(const Star& star)
{
  Lanes sum{};
  for (int i = 0; i < star.num_blocks; ++i) sum += star.blocks[i].squares;
  return sum_of(sum) / (6.0 * static_cast<double>(star.num_tets));
}

enum class Move { none, small, large };

// Steps are tried as they will be stored, rounded to a position: far from the origin that is not
// the step that was asked for.
template <int Power>
inline Move smooth_vertex(const SmoothTask& task, LocalIndex vertex, Star& star)
{
  constexpr int kTries = 4;
  constexpr double kShorter = 0.35;
  constexpr double kLargeMove = 0.01;
  gather_star(task.stars, vertex, star);
  Quadratic sum;
  for (int i = 0; i < star.num_blocks; ++i) add_block<Power>(star.blocks[i], sum);
  const double before = sum_of(sum.value);
  const Lanes from = load(task.points[vertex]);
  Lanes step = newton_step(sum);
  for (int i = 0; i < kTries; ++i) {
    const Lanes to = from + step;
    const Lanes rounded = to - from;
    if (moved_energy<Power>(star, rounded, task.worst_energy) < before) {
      store(task.points[vertex], to);
      const bool is_large =
          sum_of(rounded * rounded) > kLargeMove * kLargeMove * mean_squared_edge(star);
      return is_large ? Move::large : Move::small;
    }
    step *= kShorter;
  }
  return Move::none;
}

template <int Power>
LocalIndex smooth_vertices(const SmoothTask& task)
{
  Star star;
  LocalIndex num_moved = 0;
  for (LocalIndex v = 0; v < task.num_vertices; ++v) {
    if (task.vertex_fixed[v] != 0 || task.vertex_to_smooth[v] == 0) continue;
    const LocalIndex num_tets = task.stars.offsets[v + 1] - task.stars.offsets[v];
    if (num_tets == 0 || num_tets > kMaxStar) continue;
    const Move move = smooth_vertex<Power>(task, v, star);
    if (move != Move::none) ++num_moved;
    task.has_moved[v] = move == Move::large ? 1 : 0;
  }
  return num_moved;
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "tessera/base/types.hpp"
#include "tessera/optimize/instruction_set.hpp"

#include "optimize/point.hpp"

namespace tessera::optimize {

// Borrowed arrays of a working mesh with fresh stars.
struct StarView {
  const Point* points;
  const LocalIndex* tet_vertices;
  const LocalIndex* offsets;
  const LocalIndex* corners;
};

// Stars of more tets are left as they are.
inline constexpr LocalIndex kMaxStar = 128;

struct SmoothTask {
  StarView stars;
  Point* points;  // Those of the stars, to be written.
  LocalIndex num_vertices;
  const std::uint8_t* vertex_fixed;
  const std::uint8_t* vertex_to_smooth;
  std::uint8_t* has_moved;  // By vertex: by more than a hundredth of an edge.
  double worst_energy;      // No tet may get a higher one.
};

struct CollapseTask {
  StarView stars;
  double worst_energy;   // No tet may get a higher one.
  double max_mean_cost;  // Of the tets that are left.
  double reach;          // Schedule::collapse_reach.
};

// Costs and energies of the tets on the four triangles of a ring of four vertices: (0, 1, 2) and
// (0, 2, 3) are one triangulation, (0, 1, 3) and (1, 2, 3) the other.
struct RingOfFour {
  double cost[4];      // Of both tets.
  double energy_a[4];  // (triangle backwards, a).
  double energy_b[4];  // (triangle, b).
};

// The code that is compiled once for every instruction set.
struct Kernels {
  // Energy and cost of every slot; infinite for a free one.
  void (*energies)(const Point* points, const LocalIndex* tet_vertices, LocalIndex num_slots,
                   double* energy, double* cost);
  // One Newton step of every vertex to be smoothed, in their order, each with the newest positions;
  // the sum of eta^-3 or of eta^-12 falls. Returns how many were moved.
  LocalIndex (*smooth)(const SmoothTask& task);
  LocalIndex (*smooth_worst)(const SmoothTask& task);
  // The neighbour that a vertex had best be merged into, by the mean cost of the tets that are
  // left; kNoIndex if there is none. @pre at most kMaxStar tets.
  LocalIndex (*best_collapse)(const CollapseTask& task, LocalIndex vertex);
  void (*ring_of_four)(const Point& a, const Point& b, const Point* const* ring,
                       RingOfFour& result);
};

[[nodiscard]] const Kernels& kernels_of(InstructionSet set);

extern const Kernels kBaselineKernels;
#ifdef TESSERA_X86_KERNELS
extern const Kernels kAvx2Kernels;
extern const Kernels kAvx512Kernels;
#endif

}  // namespace tessera::optimize

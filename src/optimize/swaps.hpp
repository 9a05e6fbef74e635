// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "optimize/working_mesh.hpp"

namespace tessera::optimize {

// Rings of more tets are not opened: of 18,000 edges removed from shaft.geo (L = 2) ten had more
// than four.
inline constexpr std::size_t kMaxRing = 7;

// All tets around the edge (a, b). Tet i has ring vertices i and i + 1, and is positive in the
// order a, b, i, i + 1.
struct EdgeRing {
  LocalIndex a = kNoIndex;
  LocalIndex b = kNoIndex;
  std::size_t size = 0;
  std::array<LocalIndex, kMaxRing> vertices;  // The first `size`.
  std::array<LocalIndex, kMaxRing> tets;      // The first `size`.
};

// A change of topology, not yet made.
struct Swap {
  std::size_t num_old = 0;
  std::size_t num_new = 0;
  std::array<LocalIndex, kMaxRing> old_tets;
  std::array<TetVertices, 2 * (kMaxRing - 2)> new_tets;
  std::array<double, 2 * (kMaxRing - 2)> new_energies;

  void add(const TetVertices& tet, double energy)
  {
    new_tets[num_new] = tet;
    new_energies[num_new++] = energy;
  }
};

// The best way to fill a ring without its edge; false if it lowers the cost by no more than
// `least_gain`, or makes a tet that is worse than allowed. @pre 3 <= ring.size.
[[nodiscard]] bool find_edge_removal(const WorkingMesh& mesh, const EdgeRing& ring,
                                     double least_gain, Swap& swap);

// The face opposite to a corner in place of the edge across it: two tets become three. False as
// above, or on the boundary.
[[nodiscard]] bool find_face_swap(const WorkingMesh& mesh, Corner corner, double least_gain,
                                  Swap& swap);

}  // namespace tessera::optimize

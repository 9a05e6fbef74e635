// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "optimize/edge_ring.hpp"
#include "optimize/replace_tets.hpp"
#include "optimize/working_mesh.hpp"

namespace tessera::optimize {

// A change of topology, not yet made.
struct Swap {
  std::size_t num_old = 0;
  std::size_t num_new = 0;
  std::array<LocalIndex, kMaxRing> old_tets;
  std::array<TetVertices, 2 * (kMaxRing - 2)> new_tets;
  std::array<double, 2 * (kMaxRing - 2)> new_energies;

  [[nodiscard]] Replacement replacement() const
  {
    return {std::span(old_tets).first(num_old), std::span(new_tets).first(num_new),
            std::span(new_energies).first(num_new)};
  }

  void add(const TetVertices& tet, double energy)
  {
    new_tets[num_new] = tet;
    new_energies[num_new++] = energy;
  }
};

// The best way to fill a ring without its edge. False if it lowers the cost by no more than
// `least_gain`, or makes a tet that is worse than allowed.
// @pre 3 <= ring.size.
[[nodiscard]] bool find_edge_removal(const WorkingMesh& mesh, const EdgeRing& ring,
                                     double least_gain, Swap& swap);

// The face opposite to a corner in place of the edge across it: two tets become three. False as
// above, or on the boundary.
[[nodiscard]] bool find_face_swap(const WorkingMesh& mesh, Corner corner, double least_gain,
                                  Swap& swap);

}  // namespace tessera::optimize

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "optimize/edge_ring.hpp"
#include "optimize/passes/passes.hpp"
#include "optimize/passes/swaps.hpp"
#include "optimize/replace_tets.hpp"
#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

// A swap must lower the sum of eta^-1.5 by this, so that none is undone by the next for nothing.
constexpr double kLeastGain = 1e-3;

class SwapPass {
 public:
  SwapPass(WorkingMesh& mesh, const Schedule& schedule)
      : mesh_(mesh),
        try_above_(energy_of_mean_ratio(schedule.swap_below)),
        try_all_above_(energy_of_mean_ratio(schedule.try_all_below)),
        to_try_(mesh.tet_to_swap.size(), 0)
  {
    to_try_.swap(mesh.tet_to_swap);
  }

  void run()
  {
    // Swaps add tets; these wait for the next pass.
    const LocalIndex num_slots = mesh_.num_slots();
    for (LocalIndex t = 0; t < num_slots; ++t) {
      if (!is_candidate(t)) continue;
      if (find_swap(t) && replace_tets(mesh_, swap_.replacement())) {
        ++mesh_.statistics.num_swaps;
        for (const LocalIndex old : swap_.replacement().old_tets) {
          if (old < num_slots) to_try_[at(old)] = 0;
        }
      }
    }
  }

 private:
  [[nodiscard]] bool is_candidate(LocalIndex t) const
  {
    return to_try_[at(t)] != 0 && mesh_.tet_energy[at(t)] >= try_above_ && !mesh_.is_free_slot(t);
  }

  // The first swap around the tet that gains anything.
  [[nodiscard]] bool find_swap(LocalIndex t)
  {
    const bool try_all = mesh_.tet_energy[at(t)] > try_all_above_;
    const std::array<bool, 6> is_long = long_edges(t);
    // A ring with a tet that the pass has left as it is was looked at from there, as closely.
    const double seen_above = try_all ? try_all_above_ : try_above_;
    const auto was_seen = [&](LocalIndex u) { return was_tried_before(u, t, seen_above); };
    for (std::size_t e = 0; e < 6; ++e) {
      if (!try_all && !is_long[e]) continue;
      if (walk_ring(mesh_, t, kTetEdges[e], try_all ? kMaxRing : 4, was_seen, ring_)
          && find_edge_removal(mesh_, ring_, kLeastGain, swap_)) {
        return true;
      }
    }
    for (Corner c = 0; try_all && c < 4; ++c) {
      const Corner across = mesh_.tet_neighbours[at(4 * t + c)];
      if (is_boundary(across) || was_seen(tet_of(across))) continue;
      if (find_face_swap(mesh_, 4 * t + c, kLeastGain, swap_)) return true;
    }
    return false;
  }

  // Edges not shorter than the root of the mean square: those whose removal makes a poor tet
  // better.
  [[nodiscard]] std::array<bool, 6> long_edges(LocalIndex t) const
  {
    std::array<double, 6> squares;
    double sum = 0.0;
    for (std::size_t e = 0; e < 6; ++e) {
      const Vec3 length = edge(mesh_.corner_point(4 * t + kTetEdges[e].a),
                               mesh_.corner_point(4 * t + kTetEdges[e].b));
      squares[e] = dot(length, length);
      sum += squares[e];
    }
    std::array<bool, 6> result;
    for (std::size_t e = 0; e < 6; ++e) result[e] = 6.0 * squares[e] >= sum;
    return result;
  }

  // Whether the pass came by tet u, of such an energy, before t and left it as it is.
  [[nodiscard]] bool was_tried_before(LocalIndex u, LocalIndex t, double energy) const
  {
    return u < t && to_try_[at(u)] != 0 && mesh_.tet_energy[at(u)] >= energy;
  }

  WorkingMesh& mesh_;
  double try_above_;
  double try_all_above_;
  std::vector<std::uint8_t> to_try_;
  EdgeRing ring_{};
  Swap swap_{};
};

}  // namespace

void swap_pass(WorkingMesh& mesh, const Schedule& schedule)
{
  refresh_energies(mesh);
  SwapPass(mesh, schedule).run();
}

}  // namespace tessera::optimize

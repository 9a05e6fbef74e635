// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "optimize/passes/passes.hpp"
#include "optimize/replace_tets.hpp"
#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

class CollapsePass {
 public:
  CollapsePass(WorkingMesh& mesh, const Schedule& schedule)
      : mesh_(mesh),
        schedule_(schedule),
        try_above_(energy_of_mean_ratio(schedule.collapse_below)),
        was_touched_(mesh.points.size(), 0)
  {
  }

  void run()
  {
    for (LocalIndex v = 0; v < mesh_.num_vertices(); ++v) {
      // Around a touched vertex the stars are out of date.
      if (!is_candidate(v) || was_touched_[at(v)] != 0) continue;
      mesh_.vertex_to_collapse[at(v)] = 0;
      try_vertex(v);
    }
  }

 private:
  [[nodiscard]] bool is_candidate(LocalIndex v) const
  {
    const std::size_t num_tets = star(v).size();
    return mesh_.vertex_to_collapse[at(v)] != 0 && mesh_.vertex_fixed[at(v)] == 0 && num_tets > 0
           && num_tets <= at(kMaxStar);
  }

  [[nodiscard]] std::span<const Corner> star(LocalIndex v) const
  {
    const LocalIndex first = mesh_.star_offsets[at(v)];
    return std::span(mesh_.star_corners)
        .subspan(at(first), at(mesh_.star_offsets[at(v) + 1] - first));
  }

  void try_vertex(LocalIndex v)
  {
    // A collapse may make tets worse for a moment, but not by more than this.
    constexpr double kMaxRise = 4.0;
    double cost = 0.0;
    double worst = 0.0;
    for (const Corner corner : star(v)) {
      cost += mesh_.tet_cost[at(tet_of(corner))];
      worst = std::max(worst, mesh_.tet_energy[at(tet_of(corner))]);
    }
    if (worst < try_above_) return;
    const double mean = cost / static_cast<double>(star(v).size());
    const LocalIndex target = mesh_.kernels->best_collapse(
        {.stars = mesh_.stars(),
         .worst_energy = std::min(mesh_.worst_energy, kMaxRise * worst),
         .max_mean_cost = mean + schedule_.collapse_loss,
         .reach = schedule_.collapse_reach},
        v);
    if (target != kNoIndex) collapse(v, target);
  }

  void collapse(LocalIndex v, LocalIndex target)
  {
    old_tets_.clear();
    new_tets_.clear();
    new_energies_.clear();
    for (const Corner corner : star(v)) {
      old_tets_.push_back(tet_of(corner));
      add_moved(tet_of(corner), corner & 3, target);
    }
    touch_neighbours(v);
    if (!replace_tets(mesh_, {old_tets_, new_tets_, new_energies_})) return;
    mesh_.vertex_removed[at(v)] = 1;
    ++mesh_.statistics.num_collapses;
  }

  // The tet with its corner at the target; none if it is there with another corner.
  void add_moved(LocalIndex t, Corner corner, LocalIndex target)
  {
    TetVertices tet;
    std::copy_n(&mesh_.tet_vertices[4 * at(t)], 4, tet.begin());
    if (std::find(tet.begin(), tet.end(), target) != tet.end()) return;
    tet[at(corner)] = target;
    new_tets_.push_back(tet);
    new_energies_.push_back(tet_energy(mesh_.points[at(tet[0])], mesh_.points[at(tet[1])],
                                       mesh_.points[at(tet[2])], mesh_.points[at(tet[3])]));
  }

  void touch_neighbours(LocalIndex v)
  {
    for (const Corner corner : star(v)) {
      for (const LocalIndex u : face_vertices(mesh_.tet_vertices, corner)) was_touched_[at(u)] = 1;
    }
  }

  WorkingMesh& mesh_;
  const Schedule& schedule_;
  double try_above_;
  std::vector<std::uint8_t> was_touched_;
  std::vector<LocalIndex> old_tets_{};
  std::vector<TetVertices> new_tets_{};
  std::vector<double> new_energies_{};
};

}  // namespace

void collapse_pass(WorkingMesh& mesh, const Schedule& schedule)
{
  refresh_energies(mesh);
  refresh_stars(mesh);
  CollapsePass(mesh, schedule).run();
}

}  // namespace tessera::optimize

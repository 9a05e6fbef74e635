// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "optimize/edge_ring.hpp"
#include "optimize/passes/passes.hpp"
#include "optimize/replace_tets.hpp"
#include "optimize/star_energy.hpp"
#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

constexpr int kRounds = 10;  // Tets that join a cavity at most.
constexpr int kSteps = 3;    // Of the new vertex, a round.
constexpr std::size_t kMostTets = 32;

// delta of StarEnergy by the volume of a regular tet: small enough that a star that can be positive
// becomes so.
constexpr double kDelta = 1e-3;

// The worst energy of the new tets by that of the bad one: a tenth more of mean ratio.
constexpr double kLeastGain = 0.75;

// Tets that a new vertex would take the place of, each joined with it by the faces around them.
struct Cavity {
  std::vector<LocalIndex> tets{};
  std::vector<Corner> faces{};  // Opposite to these corners of the tets.
  Vec3 point{};
  double worst = kInfinity;  // Energy of a new tet.
};

class InsertPass {
 public:
  InsertPass(WorkingMesh& mesh, const Schedule& schedule)
      : mesh_(mesh), try_above_(energy_of_mean_ratio(schedule.insert_below))
  {
  }

  void run()
  {
    for (const LocalIndex t : worst_first()) {
      // Another insertion may have taken the tet, and its slot.
      if (!mesh_.is_free_slot(t) && mesh_.tet_energy[at(t)] >= try_above_) try_tet(t);
    }
  }

 private:
  [[nodiscard]] std::vector<LocalIndex> worst_first() const
  {
    std::vector<std::pair<double, LocalIndex>> bad;
    for (LocalIndex t = 0; t < mesh_.num_slots(); ++t) {
      const double energy = mesh_.tet_energy[at(t)];
      if (!mesh_.is_free_slot(t) && energy >= try_above_) bad.emplace_back(-energy, t);
    }
    std::ranges::sort(bad);
    std::vector<LocalIndex> tets;
    for (const auto& [energy, t] : bad) tets.push_back(t);
    return tets;
  }

  void try_tet(LocalIndex t)
  {
    Cavity best;
    for (std::vector<LocalIndex>& seed : seeds(t)) {
      Cavity grown = grow(std::move(seed));
      if (grown.worst < best.worst) best = std::move(grown);
    }
    if (best.worst < kLeastGain * mesh_.tet_energy[at(t)]) insert(best);
  }

  // The tet with its neighbours, and the tets around each of its edges that are off the boundary.
  [[nodiscard]] std::vector<std::vector<LocalIndex>> seeds(LocalIndex t) const
  {
    std::vector<std::vector<LocalIndex>> seeds(1, {t});
    for (Corner corner = 4 * t; corner < 4 * t + 4; ++corner) {
      const Corner across = mesh_.tet_neighbours[at(corner)];
      if (!is_boundary(across)) seeds[0].push_back(tet_of(across));
    }
    EdgeRing ring;
    for (const TetEdge& edge : kTetEdges) {
      const auto never = [](LocalIndex) { return false; };
      if (!walk_ring(mesh_, t, edge, kMaxRing, never, ring)) continue;
      seeds.emplace_back(ring.all_tets().begin(), ring.all_tets().end());
    }
    return seeds;
  }

  // The best of the cavities that come of joining what lies behind the worst new tet.
  [[nodiscard]] Cavity grow(std::vector<LocalIndex> tets)
  {
    Cavity best;
    Cavity now{.tets = std::move(tets)};
    now.point = mean_corner(now.tets);
    for (int round = 0; round < kRounds; ++round) {
      find_faces(now);
      place_point(now);
      if (now.worst < best.worst && loses_no_fixed_vertex(now)) best = now;
      const Corner behind = mesh_.tet_neighbours[at(worst_face(now))];
      if (now.worst < try_above_ || is_boundary(behind) || now.tets.size() == kMostTets) break;
      now.tets.push_back(tet_of(behind));
    }
    return best;
  }

  [[nodiscard]] Vec3 mean_corner(const std::vector<LocalIndex>& tets) const
  {
    Vec3 sum{};
    for (const LocalIndex t : tets) {
      for (Corner corner = 4 * t; corner < 4 * t + 4; ++corner) {
        sum = sum + to_vec3(mesh_.corner_point(corner));
      }
    }
    return (1.0 / static_cast<double>(4 * tets.size())) * sum;
  }

  void find_faces(Cavity& cavity) const
  {
    cavity.faces.clear();
    for (const LocalIndex t : cavity.tets) {
      for (Corner corner = 4 * t; corner < 4 * t + 4; ++corner) {
        const Corner across = mesh_.tet_neighbours[at(corner)];
        const bool is_inside =
            !is_boundary(across) && std::ranges::count(cavity.tets, tet_of(across)) != 0;
        if (!is_inside) cavity.faces.push_back(corner);
      }
    }
  }

  [[nodiscard]] std::array<Point, 3> points_of(Corner face) const
  {
    const auto [a, b, c] = face_vertices(mesh_.tet_vertices, face);
    return {mesh_.points[at(a)], mesh_.points[at(b)], mesh_.points[at(c)]};
  }

  void place_point(Cavity& cavity)
  {
    star_.clear();
    for (const Corner face : cavity.faces) {
      const auto [a, b, c] = points_of(face);
      star_.add_face(to_vec3(a), to_vec3(b), to_vec3(c));
    }
    cavity.point =
        star_.minimize(cavity.point, kDelta * star_.typical_volume(cavity.point), kSteps);
    cavity.worst = star_.worst(cavity.point);
  }

  // By volume where tets are inverted: the most inverted one.
  [[nodiscard]] Corner worst_face(const Cavity& cavity) const
  {
    Corner worst = cavity.faces.front();
    double highest = -kInfinity;
    for (const Corner face : cavity.faces) {
      const auto [a, b, c] = points_of(face);
      const Point point{cavity.point[0], cavity.point[1], cavity.point[2], 0.0};
      const Vec3 u = edge(point, a);
      const double w = dot(u, cross(edge(point, b), edge(point, c)));
      const double energy = w > 0.0 ? tet_energy(point, a, b, c) : kHighestEnergy * (1.0 - w);
      if (energy <= highest) continue;
      highest = energy;
      worst = face;
    }
    return worst;
  }

  // Vertices inside the cavity have no face of it.
  [[nodiscard]] std::vector<LocalIndex> lost_vertices(const Cavity& cavity) const
  {
    std::vector<LocalIndex> kept;
    for (const Corner face : cavity.faces) {
      for (const LocalIndex v : face_vertices(mesh_.tet_vertices, face)) kept.push_back(v);
    }
    std::vector<LocalIndex> lost;
    for (const LocalIndex t : cavity.tets) {
      for (std::size_t c = 0; c < 4; ++c) {
        const LocalIndex v = mesh_.tet_vertices[4 * at(t) + c];
        if (std::ranges::count(kept, v) == 0) lost.push_back(v);
      }
    }
    return lost;
  }

  [[nodiscard]] bool loses_no_fixed_vertex(const Cavity& cavity) const
  {
    return std::ranges::none_of(lost_vertices(cavity),
                                [this](LocalIndex v) { return mesh_.vertex_fixed[at(v)] != 0; });
  }

  void insert(const Cavity& cavity)
  {
    const std::vector<LocalIndex> lost = lost_vertices(cavity);
    const LocalIndex v = add_vertex(mesh_, cavity.point);
    std::vector<TetVertices> tets;
    std::vector<double> energies;
    for (const Corner face : cavity.faces) {
      const auto [a, b, c] = face_vertices(mesh_.tet_vertices, face);
      tets.push_back({v, a, b, c});
      energies.push_back(tet_energy(mesh_.points[at(v)], mesh_.points[at(a)], mesh_.points[at(b)],
                                    mesh_.points[at(c)]));
    }
    if (!replace_tets(mesh_, {cavity.tets, tets, energies})) {
      mesh_.vertex_removed[at(v)] = 1;
      return;
    }
    for (const LocalIndex gone : lost) mesh_.vertex_removed[at(gone)] = 1;
    ++mesh_.statistics.num_insertions;
  }

  WorkingMesh& mesh_;
  double try_above_;
  StarEnergy star_{};
};

}  // namespace

void insert_pass(WorkingMesh& mesh, const Schedule& schedule)
{
  refresh_energies(mesh);
  InsertPass(mesh, schedule).run();
}

}  // namespace tessera::optimize

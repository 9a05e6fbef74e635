// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/make_room.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_neighbours.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "coarse/arcs.hpp"
#include "coarse/flip_tets.hpp"
#include "coarse/tet_changes.hpp"

namespace tessera::coarse {
namespace {

// Least scaled Jacobians, with arcs: what is mended, and what is enough. Of 0.01, 0.03 and 0.05 the
// last left fewest folds on eight models with three and four levels. Angles of the corpus, which
// has two at most, stay as they are with each.
constexpr double kFolding = 0.05;
constexpr double kEnough = 0.1;

// The same of tets' own shapes, which moves may take. With 0.1 they took a third of the smallest
// angle of two models.
constexpr double kFairShape = 0.2;

// A tet whose own shape is not much better than with arcs is not theirs to mend.
constexpr double kOfOwnShape = 0.9;

// Steps of a vertex, in mean distances to the corners around.
constexpr double kLongestStep = 0.25;
constexpr double kShortestStep = 0.01;

constexpr int kRounds = 4;           // Of moves and new vertices.
constexpr int kMostWithoutGain = 5;  // Tets that join a cavity in vain.

// Of all tets. Where more fold the edges of the surface are too long for it, and no vertex inside
// helps: 0.13 of bottle.brep, whose thread winds round twice; of others at most 0.02.
constexpr double kMostFolding = 0.05;
constexpr double kAlwaysTried = 100.0;  // Tets; they take 0.3 s.

struct Place {
  Vec3 xyz{};
  double worst = 0.0;  // Of the tets around.
};

// Goes uphill from `best`, to the best of the 26 places on a cube around, with shorter steps where
// none is better. `worst_at(xyz, bound)` is what grows; anything up to `bound` if it is not more.
template <class WorstAt>
Place climb(Place best, double distance, const WorstAt& worst_at)
{
  double step = kLongestStep;
  while (step >= kShortestStep && best.worst < kEnough) {
    const Vec3 from = best.xyz;
    const double h = step * distance;
    for (int number = 0; number < 27; ++number) {
      const Vec3 to{from[0] + h * (number % 3 - 1), from[1] + h * (number / 3 % 3 - 1),
                    from[2] + h * (number / 9 - 1)};
      const double worst = worst_at(to, best.worst);
      if (worst > best.worst) best = {to, worst};
    }
    if (best.xyz == from) step *= 0.5;
  }
  return best;
}

// Tets that a new vertex takes the place of: it is joined with the faces around them.
struct Cavity {
  std::vector<LocalIndex> tets{};
  std::vector<LocalIndex> faces{};  // 4 t + c: opposite to corner c of tet t.
  Place vertex{.worst = -1.0};
};

bool folds_at_arcs(const mesh::CoarseMesh& mesh, const Arcs& arcs, LocalIndex t)
{
  const auto corners = corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t);
  const double with_arcs = least_jacobian(corners, arcs.of_tet(mesh.tet(t)));
  return with_arcs < kFolding && with_arcs < kOfOwnShape * least_jacobian(corners, {});
}

// One round.
class RoomMaker {
 public:
  RoomMaker(cut::CutMesh& filled, const Arcs& arcs)
      : mesh_(filled.mesh),
        tet_part_(filled.tet_part),
        arcs_(arcs),
        geometry_(mesh_),
        stars_(rows_by_key(mesh_.tet_vertices, mesh_.num_vertices(), 4)),
        changes_(mesh_)
  {
  }

  LocalIndex move_vertices(const std::vector<LocalIndex>& folding)
  {
    LocalIndex num_moves = 0;
    for (const LocalIndex t : folding) {
      for (const LocalIndex v : mesh_.tet(t)) {
        if (!folds(t)) break;
        num_moves += !geometry_.has_vertex(v) && move(v) ? 1 : 0;
      }
    }
    return num_moves;
  }

  // The last step of a round, as tets and vertices are others then. `is_near`: shape
  // (num_vertices), those whose tets are tried; then those whose tets have changed.
  LocalIndex insert_vertices(const std::vector<LocalIndex>& folding, std::vector<char>& is_near)
  {
    std::vector<LocalIndex> tried;
    for (const LocalIndex t : folding) {
      if (has_one_of(is_near, t) && folds(t) && !has_folding_face(t)) tried.push_back(t);
    }
    const double most = kMostFolding * static_cast<double>(mesh_.num_tets());
    if (tried.empty() || static_cast<double>(tried.size()) > std::max(most, kAlwaysTried)) return 0;
    neighbours_ = mesh::find_tet_neighbours(mesh_.tet_vertices, mesh_.num_vertices());
    LocalIndex num_vertices = 0;
    std::ranges::fill(is_near, 0);
    for (const LocalIndex t : tried) {
      if (!changes_.is_gone(t) && insert(t, is_near)) ++num_vertices;
    }
    apply();
    return num_vertices;
  }

 private:
  [[nodiscard]] bool folds(LocalIndex t) const { return folds_at_arcs(mesh_, arcs_, t); }

  // Then no vertex inside can help.
  [[nodiscard]] bool has_folding_face(LocalIndex t) const
  {
    const std::array<Vec3, 4> corners = corners_of(t);
    const Turns turns = arcs_.of_tet(mesh_.tet(t));
    for (LocalIndex c = 0; c < 4; ++c) {
      if (is_on_geometry(4 * t + c) && least_jacobian_of_face(corners, turns, at(c)) < kFolding) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool has_one_of(const std::vector<char>& vertices, LocalIndex t) const
  {
    return std::ranges::any_of(mesh_.tet(t), [&](LocalIndex v) { return vertices[at(v)] != 0; });
  }

  [[nodiscard]] std::array<Vec3, 4> corners_of(LocalIndex t) const
  {
    return corners_at<4>(mesh_.vertex_xyz, mesh_.tet_vertices, t);
  }

  // Whether there was a better place for the vertex.
  bool move(LocalIndex v)
  {
    const Vec3 before = mesh_.position(v);
    std::vector<Turns> arcs;
    for (const LocalIndex t : stars_[v]) arcs.push_back(arcs_.of_tet(mesh_.tet(t)));
    const std::vector<Turns> chords(arcs.size());
    const auto around = [&](const std::vector<Turns>& turns, double bound) {
      double worst = 1.0;
      for (std::size_t row = 0; row < turns.size() && worst > bound; ++row) {
        worst = std::min(worst, least_jacobian(corners_of(stars_[v][row]), turns[row]));
      }
      return worst;
    };
    const double least_shape = std::min(around(chords, -1.0), kFairShape);
    const auto worst_at = [&](const Vec3& xyz, double bound) {
      std::ranges::copy(xyz, &mesh_.vertex_xyz[3 * at(v)]);
      const double worst = around(arcs, bound);
      return worst <= bound || around(chords, -1.0) >= least_shape ? worst : -1.0;
    };
    const Place best =
        climb({before, around(arcs, -1.0)}, mean_distance(before, stars_[v]), worst_at);
    std::ranges::copy(best.xyz, &mesh_.vertex_xyz[3 * at(v)]);
    return best.xyz != before;
  }

  // From a point to the corners of tets.
  [[nodiscard]] double mean_distance(const Vec3& point, std::span<const LocalIndex> tets) const
  {
    double sum = 0.0;
    for (const LocalIndex t : tets) {
      for (const Vec3& corner : corners_of(t)) sum += norm(corner - point);
    }
    return sum / (4.0 * static_cast<double>(tets.size()));
  }

  // Whether a vertex in place of the tet and of some around leaves no fold.
  bool insert(LocalIndex t, std::vector<char>& is_near)
  {
    Cavity best;
    for (std::vector<LocalIndex>& seed : seeds(t)) {
      Cavity grown = grow(std::move(seed));
      if (grown.vertex.worst > best.vertex.worst) best = std::move(grown);
    }
    if (best.vertex.worst < kEnough) return false;
    const LocalIndex v = mesh_.num_vertices();
    mesh_.vertex_xyz.insert(mesh_.vertex_xyz.end(), best.vertex.xyz.begin(), best.vertex.xyz.end());
    for (const LocalIndex face : best.faces) changes_.add(tet_on(face, v), t);
    is_near.push_back(1);
    for (const LocalIndex gone : best.tets) {
      changes_.remove(gone);
      for (const LocalIndex corner : mesh_.tet(gone)) is_near[at(corner)] = 1;
    }
    return true;
  }

  // The tet, and the tets around each of its edges inside: one that begins outside, by the tangents
  // at its end, must go.
  [[nodiscard]] std::vector<std::vector<LocalIndex>> seeds(LocalIndex t) const
  {
    std::vector<std::vector<LocalIndex>> seeds(1, {t});
    const auto tet = mesh_.tet(t);
    for (const auto& [i, j] : mesh::kTetEdgeCorners) {
      if (geometry_.has_edge(tet[i], tet[j])) continue;
      std::vector<LocalIndex> ring;
      for (const LocalIndex around : stars_[tet[i]]) {
        if (std::ranges::count(mesh_.tet(around), tet[j]) != 0) ring.push_back(around);
      }
      if (std::ranges::all_of(ring, [&](LocalIndex one) { return can_join(one, t); })) {
        seeds.push_back(std::move(ring));
      }
    }
    return seeds;
  }

  // The best of the cavities that come of joining what lies behind the worst new tet.
  [[nodiscard]] Cavity grow(std::vector<LocalIndex> tets) const
  {
    Cavity best;
    Cavity now{.tets = std::move(tets)};
    for (const LocalIndex t : now.tets) {
      now.vertex.xyz = now.vertex.xyz
                       + (1.0 / static_cast<double>(now.tets.size())) * tet_centroid(corners_of(t));
    }
    for (int without_gain = 0; without_gain < kMostWithoutGain; ++without_gain) {
      find_faces(now);
      const LocalIndex way_on = place_vertex(now);
      if (now.vertex.worst > best.vertex.worst && keeps_all(now)) {
        best = now;
        without_gain = 0;
      }
      if (now.vertex.worst >= kEnough || way_on == kNoIndex) break;
      now.tets.push_back(neighbours_[at(way_on)] / 4);
    }
    return best;
  }

  void find_faces(Cavity& cavity) const
  {
    cavity.faces.clear();
    for (const LocalIndex t : cavity.tets) {
      for (LocalIndex face = 4 * t; face < 4 * t + 4; ++face) {
        const LocalIndex across = neighbours_[at(face)];
        if (across == kNoIndex || std::ranges::count(cavity.tets, across / 4) == 0) {
          cavity.faces.push_back(face);
        }
      }
    }
  }

  // The face of the worst new tet then, of those that may be crossed; kNoIndex if there is none.
  [[nodiscard]] LocalIndex place_vertex(Cavity& cavity) const
  {
    std::vector<std::array<Vec3, 4>> corners;
    std::vector<Turns> turns;
    for (const LocalIndex face : cavity.faces) {
      const Tet tet = tet_on(face, kNoIndex);
      corners.push_back({mesh_.position(tet[0]), mesh_.position(tet[1]), mesh_.position(tet[2])});
      turns.push_back(arcs_.of_tet(tet));
    }
    std::size_t worst_row = 0;  // Tried first, as it mostly is the worst again.
    const auto jacobian_on = [&](std::size_t row, const Vec3& xyz) {
      corners[row][3] = xyz;
      return std::min(least_jacobian(corners[row], {}), least_jacobian(corners[row], turns[row]));
    };
    const auto worst_at = [&](const Vec3& xyz, double bound) {
      double worst = jacobian_on(worst_row, xyz);
      for (std::size_t row = 0; row < corners.size() && worst > bound; ++row) {
        const double jacobian = jacobian_on(row, xyz);
        if (jacobian >= worst) continue;
        worst = jacobian;
        worst_row = row;
      }
      return worst;
    };
    const Vec3 from = cavity.vertex.xyz;
    cavity.vertex = climb({from, worst_at(from, -1.0)}, mean_distance(from, cavity.tets), worst_at);
    LocalIndex way_on = kNoIndex;
    double worst = 1.0;
    for (std::size_t row = 0; row < corners.size(); ++row) {
      const double jacobian = jacobian_on(row, cavity.vertex.xyz);
      if (jacobian >= worst || !can_cross(cavity.faces[row])) continue;
      worst = jacobian;
      way_on = cavity.faces[row];
    }
    return way_on;
  }

  // The tet of a vertex inside the cavity on one of its faces.
  [[nodiscard]] Tet tet_on(LocalIndex face, LocalIndex v) const
  {
    const auto tet = mesh_.tet(face / 4);
    const auto& [a, b, c] = mesh::kTetFaceCorners[at(face % 4)];
    return {tet[a], tet[c], tet[b], v};
  }

  // Whether what lies behind a face may join a cavity of its tet.
  [[nodiscard]] bool can_cross(LocalIndex face) const
  {
    return neighbours_[at(face)] != kNoIndex && !is_on_geometry(face)
           && can_join(neighbours_[at(face)] / 4, face / 4);
  }

  [[nodiscard]] bool is_on_geometry(LocalIndex face) const
  {
    const Tet tet = tet_on(face, kNoIndex);
    return geometry_.patch_of(tet[0], tet[1], tet[2]) != kNoIndex;
  }

  [[nodiscard]] bool can_join(LocalIndex t, LocalIndex other) const
  {
    return !changes_.is_gone(t) && mesh_.tet_material[at(t)] == mesh_.tet_material[at(other)]
           && (tet_part_.empty() || tet_part_[at(t)] == tet_part_[at(other)]);
  }

  // No vertex is lost, nor an edge on the geometry.
  [[nodiscard]] bool keeps_all(const Cavity& cavity) const
  {
    const auto is_on_face = [&](LocalIndex a, LocalIndex b) {
      return std::ranges::any_of(cavity.faces, [&](LocalIndex face) {
        const Tet tet = tet_on(face, kNoIndex);
        return std::ranges::count(tet, a) != 0 && std::ranges::count(tet, b) != 0;
      });
    };
    return std::ranges::all_of(cavity.tets, [&](LocalIndex t) {
      const auto tet = mesh_.tet(t);
      return std::ranges::all_of(mesh::kTetEdgeCorners, [&](const auto& ends) {
        const LocalIndex a = tet[ends[0]];
        const LocalIndex b = tet[ends[1]];
        return geometry_.has_edge(a, b) ? is_on_face(a, b) : is_on_face(a, a) && is_on_face(b, b);
      });
    });
  }

  void apply()
  {
    const std::vector<LocalIndex> rows = changes_.apply(mesh_);
    if (tet_part_.empty()) return;
    std::vector<LocalIndex> parts;
    for (const LocalIndex t : rows) parts.push_back(tet_part_[at(t)]);
    tet_part_ = std::move(parts);
  }

  mesh::CoarseMesh& mesh_;
  std::vector<LocalIndex>& tet_part_;
  const Arcs& arcs_;
  Geometry geometry_;
  IndexLists stars_;
  TetChanges changes_;
  std::vector<LocalIndex> neighbours_{};  // Of find_tet_neighbours().
};

}  // namespace

LocalIndex make_room_for_arcs(cut::CutMesh& filled, const model::Model& model)
{
  if (is_left_out(Repair::room_for_arcs)) return 0;
  const Arcs arcs(filled.mesh, model);
  std::vector<char> is_near(at(filled.mesh.num_vertices()), 1);
  LocalIndex num_changes = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<LocalIndex> folding;
    for (LocalIndex t = 0; t < filled.mesh.num_tets(); ++t) {
      if (folds_at_arcs(filled.mesh, arcs, t)) folding.push_back(t);
    }
    if (folding.empty()) break;
    RoomMaker maker(filled, arcs);
    num_changes += maker.move_vertices(folding);
    const LocalIndex num_vertices = maker.insert_vertices(folding, is_near);
    num_changes += num_vertices;
    if (num_vertices == 0) break;
  }
  note_repair(Repair::room_for_arcs, num_changes);
  return num_changes;
}

}  // namespace tessera::coarse

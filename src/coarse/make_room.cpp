// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/make_room.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "coarse/flip_tets.hpp"

namespace tessera::coarse {
namespace {

// Scaled Jacobians; that of a regular tet is 0.71. On the corpus, moves that began at 0.03 or 0.1
// took angles of other tets, and left as many folds.
constexpr double kFolding = 0.01;
constexpr double kEnough = 0.1;

// A tet whose own shape is not much better than with arcs is not theirs to mend.
constexpr double kOfOwnShape = 0.9;

// Steps of a vertex, in mean distances to the corners around.
constexpr double kLongestStep = 0.25;
constexpr double kShortestStep = 0.01;

using Edge = std::array<LocalIndex, 2>;

// How the edges on the geometry bow.
class Arcs {
 public:
  Arcs(const mesh::CoarseMesh& mesh, const model::Model& model) : mesh_(mesh), model_(model)
  {
    for (LocalIndex s = 0; s < mesh_.num_segments(); ++s) add_segment(s);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) add_face(f);
    // A curve goes before the surfaces that it bounds.
    std::ranges::stable_sort(arcs_, {}, &Arc::edge);
    const auto again = std::ranges::unique(arcs_, {}, &Arc::edge);
    arcs_.erase(again.begin(), again.end());
    for (Arc& arc : arcs_) arc.bow = bow_of(arc);
  }

  // From the middle of the edge's chord to the geometry; nothing inside.
  [[nodiscard]] Vec3 bow(LocalIndex a, LocalIndex b) const
  {
    const Edge edge = mesh::sorted_edge(a, b);
    const auto arc = std::ranges::lower_bound(arcs_, edge, {}, &Arc::edge);
    return arc != arcs_.end() && arc->edge == edge ? arc->bow : Vec3{};
  }

 private:
  struct Arc {
    Edge edge{};
    LocalIndex curve = kNoIndex;
    LocalIndex surface = kNoIndex;          // Unless there is a curve.
    model::SurfaceParameters parameters{};  // Near the middle; a curve has the first only.
    Vec3 bow{};
  };

  void add_segment(LocalIndex s)
  {
    const std::size_t from = 2 * at(s);
    Arc arc{
        .edge = mesh::sorted_edge(mesh_.segment_vertices[from], mesh_.segment_vertices[from + 1]),
        .curve = mesh_.segment_curve[at(s)]};
    const auto& t = mesh_.segment_t;
    if (!t.empty()) arc.parameters[0] = 0.5 * (t[from] + t[from + 1]);
    arcs_.push_back(arc);
  }

  void add_face(LocalIndex f)
  {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t from = 3 * at(f) + c;
      const std::size_t to = 3 * at(f) + (c + 1) % 3;
      Arc arc{.edge = mesh::sorted_edge(mesh_.face_vertices[from], mesh_.face_vertices[to]),
              .surface = mesh_.patch_surface[at(mesh_.face_patch[at(f)])]};
      const auto& uv = mesh_.face_uv;
      for (std::size_t k = 0; k < 2 && !uv.empty(); ++k) {
        arc.parameters[k] = 0.5 * (uv[2 * from + k] + uv[2 * to + k]);
      }
      arcs_.push_back(arc);
    }
  }

  // What cannot be projected counts as straight.
  [[nodiscard]] Vec3 bow_of(const Arc& arc)
  {
    const Vec3 chord = midpoint(mesh_.position(arc.edge[0]), mesh_.position(arc.edge[1]));
    const auto middle = projections_.run<GeometryError>([&] {
      return arc.curve != kNoIndex
                 ? model_.project_to_curve(arc.curve, chord, arc.parameters[0]).xyz
                 : model_.project_to_surface(arc.surface, chord, arc.parameters).xyz;
    });
    return middle.value_or(chord) - chord;
  }

  const mesh::CoarseMesh& mesh_;
  const model::Model& model_;
  std::vector<Arc> arcs_{};  // Ascending.
  Attempts projections_{"middles of edges on the geometry, to make room for arcs"};
};

double scaled_jacobian(const Vec3& u, const Vec3& v, const Vec3& w)
{
  const double lengths = norm(u) * norm(v) * norm(w);
  return lengths > 0.0 ? dot(u, cross(v, w)) / lengths : 0.0;
}

enum class Sides { chords, arcs };

class RoomMaker {
 public:
  RoomMaker(mesh::CoarseMesh& mesh, const model::Model& model)
      : mesh_(mesh),
        geometry_(mesh),
        stars_(rows_by_key(mesh.tet_vertices, mesh.num_vertices(), 4)),
        bows_(at(mesh.num_tets()))
  {
    const Arcs arcs(mesh, model);
    for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
      const auto tet = mesh_.tet(t);
      for (std::size_t e = 0; e < 6; ++e) {
        const auto& [i, j] = mesh::kTetEdgeCorners[e];
        bows_[at(t)][e] = arcs.bow(tet[i], tet[j]);
      }
    }
  }

  LocalIndex run()
  {
    LocalIndex num_moves = 0;
    for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
      for (const LocalIndex v : mesh_.tet(t)) {
        if (!folds(t)) break;
        num_moves += !geometry_.has_vertex(v) && move(v) ? 1 : 0;
      }
    }
    return num_moves;
  }

 private:
  [[nodiscard]] bool folds(LocalIndex t) const
  {
    const double with_arcs = jacobian(t, Sides::arcs);
    return with_arcs < kFolding && with_arcs < kOfOwnShape * jacobian(t, Sides::chords);
  }

  // The least of a tet's corners: of the ways that its edges begin there.
  [[nodiscard]] double jacobian(LocalIndex t, Sides sides) const
  {
    const auto p = corners_at<4>(mesh_.vertex_xyz, mesh_.tet_vertices, t);
    std::array<std::array<Vec3, 4>, 4> way{};
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [i, j] = mesh::kTetEdgeCorners[e];
      // A parabola through the middle.
      const Vec3 turn = sides == Sides::arcs ? 4.0 * bows_[at(t)][e] : Vec3{};
      way[i][j] = p[j] - p[i] + turn;
      way[j][i] = p[i] - p[j] + turn;
    }
    return std::min({scaled_jacobian(way[0][1], way[0][2], way[0][3]),
                     scaled_jacobian(way[1][0], way[1][3], way[1][2]),
                     scaled_jacobian(way[2][3], way[2][0], way[2][1]),
                     scaled_jacobian(way[3][2], way[3][1], way[3][0])});
  }

  [[nodiscard]] double worst_around(LocalIndex v, Sides sides) const
  {
    double worst = 1.0;
    for (const LocalIndex t : stars_[v]) worst = std::min(worst, jacobian(t, sides));
    return worst;
  }

  // Whether there was a better place for the vertex.
  bool move(LocalIndex v)
  {
    const Vec3 before = mesh_.position(v);
    const double distance = mean_distance(v);
    const double least_shape = std::min(worst_around(v, Sides::chords), kEnough);
    Best best{before, worst_around(v, Sides::arcs)};
    double step = kLongestStep;
    while (step >= kShortestStep && best.worst < kEnough) {
      const Best next = best_beside(v, best, step * distance, least_shape);
      if (next.worst <= best.worst) step *= 0.5;
      best = next;
    }
    place(v, best.xyz);
    return best.xyz != before;
  }

  struct Best {
    Vec3 xyz{};
    double worst = 0.0;  // Of the tets around, with arcs.
  };

  // Of the 26 places of a cube's surface around the best so far.
  [[nodiscard]] Best best_beside(LocalIndex v, Best best, double step, double least_shape)
  {
    const Vec3 from = best.xyz;
    for (int number = 0; number < 27; ++number) {
      const Vec3 to{from[0] + step * (number % 3 - 1), from[1] + step * (number / 3 % 3 - 1),
                    from[2] + step * (number / 9 - 1)};
      place(v, to);
      const double worst = worst_around(v, Sides::arcs);
      if (worst > best.worst && worst_around(v, Sides::chords) >= least_shape) best = {to, worst};
    }
    return best;
  }

  [[nodiscard]] double mean_distance(LocalIndex v) const
  {
    double sum = 0.0;
    for (const LocalIndex t : stars_[v]) {
      for (const LocalIndex other : mesh_.tet(t)) {
        sum += norm(mesh_.position(other) - mesh_.position(v));
      }
    }
    return sum / (3.0 * static_cast<double>(stars_[v].size()));
  }

  void place(LocalIndex v, const Vec3& xyz)
  {
    std::ranges::copy(xyz, &mesh_.vertex_xyz[3 * at(v)]);
  }

  mesh::CoarseMesh& mesh_;
  Geometry geometry_;
  IndexLists stars_;
  std::vector<std::array<Vec3, 6>> bows_;  // Of each tet's edges.
};

}  // namespace

LocalIndex make_room_for_arcs(mesh::CoarseMesh& mesh, const model::Model& model)
{
  if (is_left_out(Repair::room_for_arcs)) return 0;
  const LocalIndex num_moves = RoomMaker(mesh, model).run();
  note_repair(Repair::room_for_arcs, num_moves);
  return num_moves;
}

}  // namespace tessera::coarse

// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/arcs.hpp"

#include <algorithm>
#include <cstddef>

#include "tessera/base/arc.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::coarse {
namespace {

// In parts of the chord: lower arcs are straight.
constexpr double kStraight = 1e-6;

// In parts of the chord, an arc of 23 degrees: lower ones fold nothing, whatever their ends are.
constexpr double kFlat = 0.05;

// In parts of the arc's height: ends farther off are not on the geometry.
constexpr double kOfHeight = 0.1;

// An edge with what it lies on.
struct Side {
  std::array<LocalIndex, 2> edge{};  // Ascending.
  LocalIndex curve = kNoIndex;
  LocalIndex surface = kNoIndex;          // Unless there is a curve.
  model::SurfaceParameters parameters{};  // Near the middle; a curve has the first only.
};

Side side_of_segment(const mesh::CoarseMesh& mesh, LocalIndex s)
{
  const std::size_t from = 2 * at(s);
  Side side{.edge = mesh::sorted_edge(mesh.segment_vertices[from], mesh.segment_vertices[from + 1]),
            .curve = mesh.segment_curve[at(s)]};
  const auto& t = mesh.segment_t;
  if (!t.empty()) side.parameters[0] = 0.5 * (t[from] + t[from + 1]);
  return side;
}

Side side_of_face(const mesh::CoarseMesh& mesh, LocalIndex f, std::size_t corner)
{
  const std::size_t from = 3 * at(f) + corner;
  const std::size_t to = 3 * at(f) + (corner + 1) % 3;
  Side side{.edge = mesh::sorted_edge(mesh.face_vertices[from], mesh.face_vertices[to]),
            .surface = mesh.patch_surface[at(mesh.face_patch[at(f)])]};
  const auto& uv = mesh.face_uv;
  for (std::size_t k = 0; k < 2 && !uv.empty(); ++k) {
    side.parameters[k] = 0.5 * (uv[2 * from + k] + uv[2 * to + k]);
  }
  return side;
}

// Each edge once, ascending. A curve goes before the surfaces that it bounds.
std::vector<Side> sides_of(const mesh::CoarseMesh& mesh)
{
  std::vector<Side> sides;
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) sides.push_back(side_of_segment(mesh, s));
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      sides.push_back(side_of_face(mesh, f, corner));
    }
  }
  std::ranges::stable_sort(sides, {}, &Side::edge);
  const auto is_same = [](const Side& one, const Side& other) { return one.edge == other.edge; };
  sides.erase(std::unique(sides.begin(), sides.end(), is_same), sides.end());
  return sides;
}

// From a point to what the side lies on.
Vec3 way_onto(const model::Model& model, const Side& side, const Vec3& point)
{
  return (side.curve != kNoIndex
              ? model.project_to_curve(side.curve, point, side.parameters[0]).xyz
              : model.project_to_surface(side.surface, point, side.parameters).xyz)
         - point;
}

// From the middle of the chord. A side with an end off the geometry, as beside what was merged, is
// no arc.
Vec3 bow_of(const model::Model& model, const Side& side, const Vec3& from, const Vec3& to)
{
  const Vec3 bow = way_onto(model, side, midpoint(from, to));
  const double height = norm(bow);
  if (height < kFlat * norm(to - from)) return bow;
  const auto is_on = [&](const Vec3& end) {
    return norm(way_onto(model, side, end)) < kOfHeight * height;
  };
  return is_on(from) && is_on(to) ? bow : Vec3{};
}

double scaled_jacobian(const Vec3& u, const Vec3& v, const Vec3& w)
{
  const double lengths = norm(u) * norm(v) * norm(w);
  return lengths > 0.0 ? dot(u, cross(v, w)) / lengths : 0.0;
}

// From corner to corner, as the edges begin there.
using Ways = std::array<std::array<Vec3, 4>, 4>;

Ways ways_of(const std::array<Vec3, 4>& corners, const Turns& turns)
{
  Ways way{};
  for (std::size_t e = 0; e < turns.size(); ++e) {
    const auto& [i, j] = mesh::kTetEdgeCorners[e];
    way[i][j] = corners[j] - corners[i] + turns[e];
    way[j][i] = corners[i] - corners[j] + turns[e];
  }
  return way;
}

}  // namespace

Arcs::Arcs(const mesh::CoarseMesh& mesh, const model::Model& model)
    : has_arc_(at(mesh.num_vertices()), 0)
{
  Attempts projections("middles of edges on the geometry, to make room for arcs");
  for (const Side& side : sides_of(mesh)) {
    const Vec3 from = mesh.position(side.edge[0]);
    const Vec3 to = mesh.position(side.edge[1]);
    const auto bow = projections.run<GeometryError>([&] { return bow_of(model, side, from, to); });
    if (!bow || norm(*bow) < kStraight * norm(to - from)) continue;
    arcs_.push_back({side.edge, arc_turn(to - from, *bow)});
    for (const LocalIndex end : side.edge) has_arc_[at(end)] = 1;
  }
}

Turns Arcs::of_tet(std::span<const LocalIndex, 4> tet) const
{
  Turns turns{};
  const auto has_arc = [&](LocalIndex v) {
    return v != kNoIndex && at(v) < has_arc_.size() && has_arc_[at(v)] != 0;
  };
  if (std::ranges::count_if(tet, has_arc) < 2) return turns;
  for (std::size_t e = 0; e < turns.size(); ++e) {
    const auto& [i, j] = mesh::kTetEdgeCorners[e];
    const auto edge = mesh::sorted_edge(tet[i], tet[j]);
    const auto arc = std::ranges::lower_bound(arcs_, edge, {}, &Arc::edge);
    if (arc != arcs_.end() && arc->edge == edge) turns[e] = arc->turn;
  }
  return turns;
}

double least_jacobian(const std::array<Vec3, 4>& corners, const Turns& turns)
{
  const Ways way = ways_of(corners, turns);
  return std::min({scaled_jacobian(way[0][1], way[0][2], way[0][3]),
                   scaled_jacobian(way[1][0], way[1][3], way[1][2]),
                   scaled_jacobian(way[2][3], way[2][0], way[2][1]),
                   scaled_jacobian(way[3][2], way[3][1], way[3][0])});
}

double least_jacobian_of_face(const std::array<Vec3, 4>& corners, const Turns& turns, std::size_t c)
{
  const Ways way = ways_of(corners, turns);
  const auto& [i, j, k] = mesh::kTetFaceCorners[c];
  const Vec3 normal = unit_normal_of({corners[i], corners[j], corners[k]});
  return std::min({scaled_jacobian(way[i][j], way[i][k], normal),
                   scaled_jacobian(way[j][k], way[j][i], normal),
                   scaled_jacobian(way[k][i], way[k][j], normal)});
}

}  // namespace tessera::coarse

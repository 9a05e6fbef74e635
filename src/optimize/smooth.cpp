// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/optimize/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/error.hpp"

#include "optimize/input_check.hpp"
#include "optimize/passes/passes.hpp"
#include "optimize/passes/untangle.hpp"
#include "optimize/tet_energy.hpp"
#include "optimize/working_mesh.hpp"

namespace tessera::optimize {
namespace {

void require_moves_only(const Schedule& schedule)
{
  const auto changes_tets = [](Step step) {
    return step == Step::swap || step == Step::collapse || step == Step::insert
           || step == Step::divide;
  };
  if (std::ranges::none_of(schedule.steps, changes_tets)) return;
  throw ConfigError("smooth() moves vertices only: its steps are m, w and t");
}

// The tets with a flagged vertex, in their order.
TetMesh tets_around(const TetMesh& mesh, const std::vector<std::uint8_t>& flags)
{
  TetMesh around{.vertex_xyz = mesh.vertex_xyz};
  for (std::size_t t = 0; t < mesh.tet_vertices.size(); t += 4) {
    const LocalIndex* v = &mesh.tet_vertices[t];
    const auto is_flagged = [&](LocalIndex vertex) { return flags[at(vertex)] != 0; };
    if (std::any_of(v, v + 4, is_flagged)) {
      around.tet_vertices.insert(around.tet_vertices.end(), v, v + 4);
    }
  }
  return around;
}

// Square of the radius within which the corners of a tet may move, whichever of them do. The width
// of a tet is six times its volume over the largest of seven areas: twice those of its faces, and
// those that its pairs of opposite edges span. A tet is flat when all corners have come near one
// plane, so one of them has moved by half of the width at least.
double squared_reach(const WorkingMesh& mesh, LocalIndex tet)
{
  constexpr double kShare = 0.45;
  std::array<Vec3, 4> p;
  for (std::size_t c = 0; c < 4; ++c)
    p[c] = to_vec3(mesh.corner_point(4 * tet + static_cast<Corner>(c)));
  const Vec3 u = p[1] - p[0];
  const Vec3 v = p[2] - p[0];
  const Vec3 w = p[3] - p[0];
  const double volume = dot(u, cross(v, w));
  if (!(volume > 0.0)) return 0.0;
  double largest = 0.0;
  for (const Vec3& area : {cross(u, v), cross(u, w), cross(v, w), cross(v - u, w - u),
                           cross(u, w - v), cross(v, w - u), cross(w, v - u)}) {
    largest = std::max(largest, dot(area, area));
  }
  return kShare * kShare * volume * volume / largest;
}

std::vector<double> squared_reaches(const WorkingMesh& mesh)
{
  std::vector<double> reaches(mesh.points.size(), std::numeric_limits<double>::infinity());
  for (LocalIndex t = 0; t < mesh.num_slots(); ++t) {
    const double reach = squared_reach(mesh, t);
    for (std::size_t c = 0; c < 4; ++c) {
      double& least = reaches[at(mesh.tet_vertices[4 * at(t) + c])];
      least = std::min(least, reach);
    }
  }
  return reaches;
}

// The star's energy is convex, so what a long step makes less, a shorter one does too.
void shorten_step(const Point& from, double squared_reach, Point& to)
{
  const Vec3 step = edge(from, to);
  const double squared_length = dot(step, step);
  if (squared_length <= squared_reach) return;
  const double share = std::sqrt(squared_reach / squared_length);
  to = {from.x + share * step[0], from.y + share * step[1], from.z + share * step[2], 0.0};
}

}  // namespace

std::vector<double> smooth(const TetMesh& mesh, const Schedule& schedule)
{
  if (mesh.vertex_fixed.size() != mesh.vertex_xyz.size() / 3) {
    throw MeshError("flags of fixed vertices are not one each");
  }
  require_moves_only(schedule);
  WorkingMesh working = make_smoothing_mesh(mesh);
  untangle_by_moving(working);
  tighten_bound(working);
  working.worst_energy = std::min(working.worst_energy, kHighestEnergy);
  for (const Step step : schedule.steps) run_step(working, step, schedule);
  return positions_of(working, mesh);
}

std::vector<double> smooth_at_once(const TetMesh& mesh, const std::vector<std::uint8_t>& flags)
{
  if (flags.size() != mesh.vertex_xyz.size() / 3) throw MeshError("flags are not one a vertex");
  require_valid_arrays(mesh);
  WorkingMesh working = make_smoothing_mesh(tets_around(mesh, flags));
  refresh_stars(working);
  const std::vector<double> reaches = squared_reaches(working);
  std::vector<Point> moved = working.points;
  std::vector<std::uint8_t> has_moved(moved.size(), 0);
  working.kernels->smooth({.stars = working.stars(),
                           .points = moved.data(),
                           .num_vertices = working.num_vertices(),
                           .vertex_fixed = working.vertex_fixed.data(),
                           .vertex_to_smooth = flags.data(),
                           .has_moved = has_moved.data(),
                           .worst_energy = kHighestEnergy});
  for (std::size_t v = 0; v < moved.size(); ++v) {
    working.vertex_fixed[v] = flags[v] == 0 ? 1 : 0;
    shorten_step(working.points[v], reaches[v], moved[v]);
  }
  working.points = std::move(moved);
  return positions_of(working, mesh);
}

}  // namespace tessera::optimize

// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/working_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/morton_order.hpp"
#include "tessera/base/rows.hpp"
#include "tessera/mesh/tet_neighbours.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "optimize/input_check.hpp"
#include "optimize/neighbours.hpp"
#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

// A power of two that brings the largest coordinate near 1, so that the sixth powers of lengths
// neither overflow nor vanish.
double scale_of(const std::vector<double>& vertex_xyz)
{
  double largest = 0.0;
  for (const double x : vertex_xyz) largest = std::max(largest, std::abs(x));
  if (largest == 0.0) return 1.0;
  // Of subnormal coordinates the inverse would not be finite.
  return std::ldexp(1.0, std::min(-std::ilogb(largest), 1000));
}

std::vector<Point> scaled_points(const std::vector<double>& vertex_xyz, double scale)
{
  std::vector<Point> points(vertex_xyz.size() / 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v] = {scale * vertex_xyz[3 * v], scale * vertex_xyz[3 * v + 1],
                 scale * vertex_xyz[3 * v + 2], 0.0};
  }
  return points;
}

// Tets in the order of their lowest vertex; equal ones by tet. It needs no curve of its own, since
// vertices lie along one.
std::vector<LocalIndex> order_by_lowest_vertex(const std::vector<LocalIndex>& tet_vertices,
                                               LocalIndex num_vertices)
{
  const std::size_t num_tets = tet_vertices.size() / 4;
  const auto lowest = [&](std::size_t t) {
    const LocalIndex* v = &tet_vertices[4 * t];
    return at(std::min({v[0], v[1], v[2], v[3]}));
  };
  std::vector<LocalIndex> next(at(num_vertices) + 1, 0);
  for (std::size_t t = 0; t < num_tets; ++t) ++next[lowest(t) + 1];
  for (std::size_t v = 0; v < at(num_vertices); ++v) next[v + 1] += next[v];
  std::vector<LocalIndex> order(num_tets);
  for (std::size_t t = 0; t < num_tets; ++t) {
    order[at(next[lowest(t)]++)] = static_cast<LocalIndex>(t);
  }
  return order;
}

// Copies points in a new order; returns where each vertex of the caller is now.
std::vector<LocalIndex> order_points(const TetMesh& input, WorkingMesh& mesh)
{
  const std::vector<Point> points = scaled_points(input.vertex_xyz, mesh.scale);
  // Neighbours in space are near in memory then: a tenth of the time of all passes.
  constexpr std::size_t kWidth = sizeof(Point) / sizeof(double);
  const auto* values = reinterpret_cast<const double*>(points.data());
  mesh.vertex_origin = morton_order(std::span(values, kWidth * points.size()), kWidth);
  mesh.points.reserve(points.size());
  for (const LocalIndex v : mesh.vertex_origin) mesh.points.push_back(points[at(v)]);
  return inverse_of(mesh.vertex_origin);
}

std::vector<LocalIndex> renumbered(const std::vector<LocalIndex>& values,
                                   const std::vector<LocalIndex>& new_value)
{
  std::vector<LocalIndex> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(),
                 [&](LocalIndex value) { return new_value[at(value)]; });
  return result;
}

std::vector<LocalIndex> reordered_neighbours(const std::vector<LocalIndex>& neighbours,
                                             const std::vector<LocalIndex>& order)
{
  const std::vector<LocalIndex> new_tet = inverse_of(order);
  std::vector<LocalIndex> result = rows_of<4>(neighbours, order);
  for (LocalIndex& corner : result) {
    if (corner != kNoIndex) corner = 4 * new_tet[at(tet_of(corner))] + (corner & 3);
  }
  return result;
}

void fix_vertices(const TetMesh& input, WorkingMesh& mesh)
{
  mesh.vertex_fixed.assign(mesh.points.size(), 0);
  if (!input.vertex_fixed.empty()) {
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      mesh.vertex_fixed[v] = input.vertex_fixed[at(mesh.vertex_origin[v])];
    }
  }
  const auto num_corners = static_cast<Corner>(mesh.tet_vertices.size());
  for (Corner corner = 0; corner < num_corners; ++corner) {
    if (!is_boundary(mesh.tet_neighbours[at(corner)])) continue;
    for (const LocalIndex v : face_vertices(mesh.tet_vertices, corner))
      mesh.vertex_fixed[at(v)] = 1;
  }
}

// The caller's triangles that are on the boundary.
void mark_outer_faces(const TetMesh& input, const std::vector<LocalIndex>& new_vertex,
                      WorkingMesh& mesh)
{
  std::vector<std::pair<std::array<LocalIndex, 3>, LocalIndex>> outer;  // With their groups.
  outer.reserve(input.outer_triangles.size() / 3);
  for (std::size_t i = 0; i < input.outer_triangles.size() / 3; ++i) {
    const LocalIndex* v = &input.outer_triangles[3 * i];
    outer.emplace_back(
        mesh::sorted_triangle(new_vertex[at(v[0])], new_vertex[at(v[1])], new_vertex[at(v[2])]),
        input.outer_group.empty() ? 0 : input.outer_group[i]);
  }
  std::ranges::sort(outer);
  for (Corner corner = 0; at(corner) < mesh.tet_vertices.size(); ++corner) {
    if (!is_boundary(mesh.tet_neighbours[at(corner)])) continue;
    const auto [a, b, c] = face_vertices(mesh.tet_vertices, corner);
    const auto face = mesh::sorted_triangle(a, b, c);
    const auto found = std::ranges::lower_bound(outer, std::pair(face, LocalIndex{0}));
    if (found == outer.end() || found->first != face) continue;
    mesh.tet_neighbours[at(corner)] = outer_face(found->second);
    mesh.has_outer_faces = true;
  }
}

void size_arrays(WorkingMesh& mesh)
{
  const std::size_t num_tets = mesh.tet_vertices.size() / 4;
  mesh.tet_energy.assign(num_tets, 0.0);
  mesh.tet_cost.assign(num_tets, 0.0);
  mesh.tet_to_swap.assign(num_tets, 1);
  mesh.vertex_removed.assign(mesh.points.size(), 0);
  mesh.vertex_to_smooth.assign(mesh.points.size(), 1);
  mesh.vertex_to_collapse.assign(mesh.points.size(), 1);
}

// The caller's first tet that is not positive; kNoIndex if all are.
LocalIndex find_not_positive(const WorkingMesh& mesh, const std::vector<LocalIndex>& tet_origin)
{
  LocalIndex first = kNoIndex;
  for (LocalIndex t = 0; t < mesh.num_slots(); ++t) {
    if (mesh.tet_energy[at(t)] <= kHighestEnergy) continue;
    if (first == kNoIndex || tet_origin[at(t)] < first) first = tet_origin[at(t)];
  }
  return first;
}

// Writes the vertices that are left, in the caller's order; returns the row of each working vertex.
std::vector<LocalIndex> place_vertices(const WorkingMesh& mesh, const TetMesh& input,
                                       OptimizeResult& result)
{
  const double unscale = 1.0 / mesh.scale;
  std::vector<LocalIndex> rows(mesh.points.size(), kNoIndex);
  for (const LocalIndex v : inverse_of(mesh.vertex_origin)) {
    if (mesh.vertex_removed[at(v)] != 0) continue;
    const LocalIndex origin = mesh.vertex_origin[at(v)];
    rows[at(v)] = static_cast<LocalIndex>(result.vertex_origin.size());
    const bool is_new = 3 * at(origin) >= input.vertex_xyz.size();
    result.vertex_origin.push_back(is_new ? kNoIndex : origin);
    // A fixed one far smaller than the mesh may have lost bits by the scale.
    const Vec3 position = mesh.vertex_fixed[at(v)] != 0
                              ? point_at(std::span(input.vertex_xyz), origin)
                              : unscale * to_vec3(mesh.points[at(v)]);
    result.vertex_xyz.insert(result.vertex_xyz.end(), position.begin(), position.end());
  }
  return rows;
}

}  // namespace

WorkingMesh make_working_mesh(const TetMesh& input, const Kernels& kernels, bool may_be_tangled)
{
  require_valid_arrays(input);
  WorkingMesh mesh;
  mesh.kernels = &kernels;
  mesh.scale = scale_of(input.vertex_xyz);
  const std::vector<LocalIndex> new_vertex = order_points(input, mesh);
  const std::vector<LocalIndex> renamed = renumbered(input.tet_vertices, new_vertex);
  const std::vector<LocalIndex> order = order_by_lowest_vertex(renamed, mesh.num_vertices());
  mesh.tet_vertices = rows_of<4>(renamed, order);
  size_arrays(mesh);
  refresh_energies(mesh);
  mesh.first_not_positive = find_not_positive(mesh, order);
  if (!may_be_tangled) require_positive(mesh);
  if (input.tet_neighbours.empty()) {
    mesh.tet_neighbours = mesh::find_tet_neighbours(mesh.tet_vertices, mesh.num_vertices(), order);
  } else {
    require_neighbours(input.tet_vertices, input.tet_neighbours);
    mesh.tet_neighbours = reordered_neighbours(input.tet_neighbours, order);
  }
  fix_vertices(input, mesh);
  if (!input.outer_triangles.empty()) mark_outer_faces(input, new_vertex, mesh);
  return mesh;
}

LocalIndex add_vertex(WorkingMesh& mesh, const Vec3& position)
{
  const LocalIndex v = mesh.num_vertices();
  mesh.points.push_back({position[0], position[1], position[2], 0.0});
  mesh.vertex_origin.push_back(v);
  mesh.vertex_fixed.push_back(0);
  mesh.vertex_removed.push_back(0);
  mesh.vertex_to_smooth.push_back(1);
  mesh.vertex_to_collapse.push_back(1);
  mesh.are_stars_stale = true;
  return v;
}

WorkingMesh make_smoothing_mesh(const TetMesh& input)
{
  require_valid_arrays(input);
  WorkingMesh mesh;
  mesh.kernels = &kernels_of(available_instruction_sets().back());
  mesh.scale = scale_of(input.vertex_xyz);
  mesh.points = scaled_points(input.vertex_xyz, mesh.scale);
  mesh.tet_vertices = input.tet_vertices;
  mesh.vertex_fixed = input.vertex_fixed;
  mesh.vertex_fixed.resize(mesh.points.size(), 0);
  size_arrays(mesh);
  return mesh;
}

std::vector<double> positions_of(const WorkingMesh& mesh, const TetMesh& input)
{
  const double unscale = 1.0 / mesh.scale;
  std::vector<double> vertex_xyz = input.vertex_xyz;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (mesh.vertex_fixed[v] != 0) continue;
    std::ranges::copy(unscale * to_vec3(mesh.points[v]), &vertex_xyz[3 * v]);
  }
  return vertex_xyz;
}

OptimizeResult to_result(const WorkingMesh& mesh, const TetMesh& input)
{
  OptimizeResult result;
  const std::vector<LocalIndex> rows = place_vertices(mesh, input, result);
  result.tet_vertices.reserve(mesh.tet_vertices.size());
  for (LocalIndex t = 0; t < mesh.num_slots(); ++t) {
    if (mesh.is_free_slot(t)) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      result.tet_vertices.push_back(rows[at(mesh.tet_vertices[4 * at(t) + c])]);
    }
  }
  result.statistics = mesh.statistics;
  return result;
}

void refresh_energies(WorkingMesh& mesh)
{
  if (!mesh.are_energies_stale) return;
  mesh.kernels->energies(mesh.points.data(), mesh.tet_vertices.data(), mesh.num_slots(),
                         mesh.tet_energy.data(), mesh.tet_cost.data());
  mesh.are_energies_stale = false;
}

std::size_t num_doubled_faces(std::span<const Corner, 4> across)
{
  std::size_t num = 0;
  for (auto face = across.begin(); face != across.end(); ++face) {
    if (is_outer(*face) && std::find(across.begin(), face, *face) != face) ++num;
  }
  return num;
}

LocalIndex count_not_positive(const WorkingMesh& mesh)
{
  LocalIndex count = 0;
  for (LocalIndex t = 0; t < mesh.num_slots(); ++t) {
    if (!mesh.is_free_slot(t) && !(mesh.tet_energy[at(t)] <= kHighestEnergy)) ++count;
  }
  return count;
}

void require_positive(const WorkingMesh& mesh)
{
  if (count_not_positive(mesh) == 0) return;
  throw MeshError(fmt::format("tet {} is flat or inverted", mesh.first_not_positive));
}

void tighten_bound(WorkingMesh& mesh)
{
  refresh_energies(mesh);
  mesh.worst_energy = 0.0;
  for (LocalIndex t = 0; t < mesh.num_slots(); ++t) {
    if (!mesh.is_free_slot(t)) {
      mesh.worst_energy = std::max(mesh.worst_energy, mesh.tet_energy[at(t)]);
    }
  }
}

void refresh_stars(WorkingMesh& mesh)
{
  if (!mesh.are_stars_stale) return;
  const auto num_corners = static_cast<Corner>(mesh.tet_vertices.size());
  mesh.star_offsets.assign(at(mesh.num_vertices()) + 1, 0);
  for (const LocalIndex v : mesh.tet_vertices) {
    if (v >= 0) ++mesh.star_offsets[at(v) + 1];
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    mesh.star_offsets[v + 1] += mesh.star_offsets[v];
  }
  mesh.star_corners.resize(at(mesh.star_offsets.back()));
  std::vector<LocalIndex> next(mesh.star_offsets.begin(), mesh.star_offsets.end() - 1);
  for (Corner corner = 0; corner < num_corners; ++corner) {
    const LocalIndex v = mesh.tet_vertices[at(corner)];
    if (v >= 0) mesh.star_corners[at(next[at(v)]++)] = corner;
  }
  mesh.are_stars_stale = false;
}

}  // namespace tessera::optimize

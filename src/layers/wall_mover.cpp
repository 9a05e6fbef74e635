// SPDX-License-Identifier: BSD-3-Clause
#include "layers/wall_mover.hpp"

#include <algorithm>
#include <utility>

#include "tessera/base/sort_unique.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/prism.hpp"
#include "tessera/quality/tet_quality.hpp"

namespace tessera::layers {
namespace {

// A tet keeps this mean ratio, or half of what it had before the step if that is less. The tets are
// made better after every step.
constexpr double kLeastRatio = 0.2;

// A triangle of the surface turns by 45 degrees at most.
constexpr double kMostTurn = 0.7;

// How often a step is halved where it does harm.
constexpr int kHalvings = 3;

std::array<Vec3, 4> corners_of(const mesh::CoarseMesh& mesh, LocalIndex tet)
{
  const auto v = mesh.tet(tet);
  return {mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]), mesh.position(v[3])};
}

}  // namespace

WallMover::WallMover(mesh::CoarseMesh& mesh, const model::Model& model, WallSurface walls,
                     const mesh::WallLayers& layers)
    : mesh_(mesh), model_(model), walls_(std::move(walls)), layers_(layers)
{
  part_.assign(walls_.vertices.size(), 0.0);
  find_tets();
}

void WallMover::find_tets()
{
  tets_.clear();
  least_ratio_.clear();
  for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
    const auto v = mesh_.tet(t);
    const bool touches = std::ranges::any_of(
        v, [&](LocalIndex one) { return walls_.wall_of_vertex[at(one)] != kNoIndex; });
    if (!touches) continue;
    tets_.push_back(t);
    least_ratio_.push_back(std::min(kLeastRatio, 0.5 * quality::mean_ratio(corners_of(mesh_, t))));
  }
}

void WallMover::renumber(const std::vector<LocalIndex>& number)
{
  std::vector<LocalIndex> wall_of_vertex(at(mesh_.num_vertices()), kNoIndex);
  for (std::size_t row = 0; row < walls_.vertices.size(); ++row) {
    LocalIndex& vertex = walls_.vertices[row].vertex;
    vertex = number[at(vertex)];
    wall_of_vertex[at(vertex)] = static_cast<LocalIndex>(row);
  }
  walls_.wall_of_vertex = std::move(wall_of_vertex);
  for (SurfaceTriangle& triangle : walls_.triangles) {
    for (LocalIndex& v : triangle.vertices) v = number[at(v)];
  }
  find_tets();
}

Vec3 WallMover::place_of(const WallVertex& vertex, double part) const
{
  if (part == 0.0 || vertex.column == Vec3{}) return vertex.wall;
  return beside_wall(vertex, vertex.wall + part * vertex.column);
}

// Without a column it stays where it is: other transforms may have led there, which differ by
// rounding.
Vec3 WallMover::place_of_image(const WallVertex& vertex, double part) const
{
  if (vertex.image == 0 || part == 0.0) return place_of(vertex, part);
  return walls_.images[at(vertex.image)](place_of(walls_.vertices[at(vertex.origin)], part));
}

Vec3 WallMover::beside_wall(const WallVertex& vertex, const Vec3& point) const
{
  if (vertex.curve != kNoIndex) {
    return model_.project_to_curve(vertex.curve, point, vertex.t).xyz;
  }
  if (vertex.patch == kNoIndex) return point;
  return model_.project_to_surface(mesh_.patch_surface[at(vertex.patch)], point, vertex.uv).xyz;
}

void WallMover::place(std::span<const double> parts)
{
  for (const WallVertex& vertex : walls_.vertices) {
    std::ranges::copy(place_of_image(vertex, parts[at(vertex.origin)]),
                      &mesh_.vertex_xyz[3 * at(vertex.vertex)]);
  }
}

void WallMover::move_to(double part)
{
  std::vector<double> wanted(part_.size(), part);
  std::vector<int> halvings(part_.size(), 0);
  for (;;) {
    place(wanted);
    const std::vector<LocalIndex> bad = rows_of_bad();
    bool has_changed = false;
    for (const LocalIndex row : bad) {
      const double before = wanted[at(row)];
      wanted[at(row)] =
          ++halvings[at(row)] <= kHalvings ? 0.5 * (part_[at(row)] + before) : part_[at(row)];
      has_changed = has_changed || wanted[at(row)] != before;
    }
    if (!has_changed) break;
  }
  part_ = std::move(wanted);
}

std::vector<LocalIndex> WallMover::rows_of_bad() const
{
  std::vector<LocalIndex> rows;
  const auto add = [&](std::span<const LocalIndex> vertices) {
    for (const LocalIndex v : vertices) {
      const LocalIndex row = walls_.wall_of_vertex[at(v)];
      if (row != kNoIndex) rows.push_back(walls_.vertices[at(row)].origin);
    }
  };
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    if (quality::mean_ratio(corners_of(mesh_, tets_[i])) < least_ratio_[i])
      add(mesh_.tet(tets_[i]));
  }
  for (const SurfaceTriangle& triangle : walls_.triangles) {
    if (is_bad_triangle(triangle) || (triangle.is_wall && is_bad_column(triangle))) {
      add(triangle.vertices);
    }
  }
  sort_unique(rows);
  return rows;
}

bool WallMover::is_bad_triangle(const SurfaceTriangle& triangle) const
{
  const auto& v = triangle.vertices;
  const std::array<Vec3, 3> p{mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
  const Vec3 area = normal_of(p);
  return dot(area, triangle.normal) < kMostTurn * norm(area)
         || triangle_shape(p) < triangle.least_shape;
}

bool WallMover::is_bad_column(const SurfaceTriangle& triangle) const
{
  std::array<Vec3, 3> low{};
  for (std::size_t c = 0; c < 3; ++c) low[c] = mesh_.position(triangle.vertices[c]);
  for (LocalIndex layer = 0; layer < layers_.most_layers; ++layer) {
    std::array<Vec3, 3> high{};
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = triangle.vertices[c];
      high[c] = column_point(walls_.vertices[at(walls_.wall_of_vertex[at(v)])], layer);
    }
    if (!mesh::has_positive_parts(low, high)) return true;
    low = high;
  }
  return false;
}

// Where a layer ends: on the curve or patch that the column goes along.
Vec3 WallMover::column_point(const WallVertex& vertex, LocalIndex layer) const
{
  const double end = layers_.ends_of(vertex.stack)[at(layer)];
  if (end == 0.0) return mesh_.position(vertex.vertex);
  const Vec3 column = mesh_.position(vertex.vertex) - vertex.wall;
  return end == 1.0 || column == Vec3{} ? vertex.wall
                                        : beside_wall(vertex, vertex.wall + (1.0 - end) * column);
}

void WallMover::update_parameters()
{
  if (!mesh_.segment_t.empty()) {
    for (const WallVertex& vertex : walls_.vertices) {
      if (has_moved(vertex) && vertex.curve != kNoIndex) update_segments_at(vertex);
    }
  }
  if (mesh_.face_uv.empty()) return;
  for (const SurfaceTriangle& triangle : walls_.triangles) {
    if (!triangle.is_wall) update_face(triangle.face);
  }
}

bool WallMover::has_moved(const WallVertex& vertex) const
{
  return part_[at(vertex.origin)] > 0.0 && vertex.column != Vec3{};
}

// Those that leave the wall; what lies on it stays there.
void WallMover::update_segments_at(const WallVertex& vertex)
{
  const double t = model_.project_to_curve(vertex.curve, mesh_.position(vertex.vertex), vertex.t).t;
  for (std::size_t end = 0; end < mesh_.segment_vertices.size(); ++end) {
    const bool is_its = mesh_.segment_vertices[end] == vertex.vertex
                        && mesh_.segment_curve[end / 2] == vertex.curve;
    if (is_its) mesh_.segment_t[end] = t;
  }
}

void WallMover::update_face(LocalIndex face)
{
  const LocalIndex surface = mesh_.patch_surface[at(mesh_.face_patch[at(face)])];
  for (std::size_t c = 3 * at(face); c < 3 * at(face) + 3; ++c) {
    const LocalIndex v = mesh_.face_vertices[c];
    const LocalIndex row = walls_.wall_of_vertex[at(v)];
    if (row == kNoIndex || !has_moved(walls_.vertices[at(row)])) continue;
    double* uv = &mesh_.face_uv[2 * c];
    std::ranges::copy(model_.project_to_surface(surface, mesh_.position(v), {uv[0], uv[1]}).uv, uv);
  }
}

}  // namespace tessera::layers

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/smooth_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tessera/base/tet.hpp"
#include "tessera/base/triangle.hpp"

#include "coarse/own/own_patches.hpp"

namespace tessera::coarse {
namespace {

// Sine of the angle between two sharp edges from which on they say what the normal between them is.
constexpr double kLeastTurn = 0.3;

// The point of a cubic next to its end `from`. Towards a circle's other end, with the circle's
// tangent, it is that of the cubic nearest to the arc.
Vec3 handle(const Vec3& from, const Vec3& to, const Vec3& tangent)
{
  const Vec3 chord = to - from;
  const double cosine = dot(tangent, unit(chord));
  return from + (2.0 / 3.0 * norm(chord) / (1.0 + std::max(0.0, cosine))) * tangent;
}

// A chord, turned into the plane across a normal.
Vec3 in_plane(const Vec3& chord, const Vec3& normal)
{
  return unit(chord - dot(chord, normal) * normal);
}

double cosine_of(double angle_deg) { return std::cos(angle_deg * std::numbers::pi / 180.0); }

// Whether the face runs along the edge from its lower to its higher vertex.
bool ascends(const LocalIndex* face, const std::array<LocalIndex, 2>& edge)
{
  for (std::size_t c = 0; c < 3; ++c) {
    if (face[c] == edge[0]) return face[(c + 1) % 3] == edge[1];
  }
  return false;
}

// Row of what has parameters from 2 row to 2 row + 1.
std::size_t row_of(double parameter, std::size_t num_rows)
{
  const double row = std::floor(0.5 * parameter);
  return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(num_rows - 1)));
}

}  // namespace

SmoothSurface::SmoothSurface(const mesh::CoarseMesh& mesh, double feature_angle_deg)
    : mesh_(&mesh), edge_faces_(faces_of_edges(mesh.face_vertices))
{
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    face_normals_.push_back(unit_normal_of(corners_at<3>(mesh.vertex_xyz, mesh.face_vertices, f)));
  }
  find_sharp_edges(feature_angle_deg);
  make_segments(feature_angle_deg);
  find_normals(feature_angle_deg);
  make_patches();
  mesh_ = nullptr;
}

// Cosine of the angle between the normals of two faces, both seen from the same side.
double SmoothSurface::turn(LocalIndex face, LocalIndex other, const Edge& edge) const
{
  const bool is_same_way = ascends(&mesh_->face_vertices[3 * at(face)], edge)
                           == ascends(&mesh_->face_vertices[3 * at(other)], edge);
  return (is_same_way ? -1.0 : 1.0) * dot(face_normals_[at(face)], face_normals_[at(other)]);
}

void SmoothSurface::find_sharp_edges(double feature_angle_deg)
{
  const double least_cosine = cosine_of(feature_angle_deg);
  for (const auto& [edge, faces] : edge_faces_) {
    const bool is_smooth = faces.size() == 2 && turn(faces[0], faces[1], edge) >= least_cosine;
    if (is_smooth) continue;
    const std::size_t row = segments_.size();
    sharp_.emplace(edge, row);
    segments_.push_back({.vertices = edge});
    for (const LocalIndex v : edge) sharp_at_[v].push_back(row);
  }
}

void SmoothSurface::find_normals(double feature_angle_deg)
{
  corner_normals_.resize(mesh_->face_vertices.size());
  std::vector<char> is_done(mesh_->face_vertices.size(), 0);
  for (std::size_t corner = 0; corner < is_done.size(); ++corner) {
    if (is_done[corner] != 0) continue;
    spread_normal(mesh_->face_vertices[corner], corner, is_done, cosine_of(feature_angle_deg));
  }
}

// Over the faces around a vertex that go on smoothly from one to the next.
void SmoothSurface::spread_normal(LocalIndex vertex, std::size_t first, std::vector<char>& is_done,
                                  double least_cosine)
{
  std::vector<std::pair<std::size_t, double>> corners{{first, 1.0}};  // And whether it is turned.
  is_done[first] = 1;
  Vec3 sum{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [corner, sign] = corners[i];
    const auto face = static_cast<LocalIndex>(corner / 3);
    const LocalIndex* v = &mesh_->face_vertices[3 * at(face)];
    const std::size_t c = corner % 3;
    const Vec3 here = mesh_->position(v[c]);
    const double angle = angle_between(mesh_->position(v[(c + 1) % 3]) - here,
                                       mesh_->position(v[(c + 2) % 3]) - here);
    sum = sum + (sign * angle) * face_normals_[at(face)];
    for (const LocalIndex to : {v[(c + 1) % 3], v[(c + 2) % 3]}) {
      const Edge edge{std::min(vertex, to), std::max(vertex, to)};
      for (const LocalIndex other : edge_faces_.at(edge)) {
        if (other == face || turn(face, other, edge) < least_cosine) continue;
        const LocalIndex* w = &mesh_->face_vertices[3 * at(other)];
        const auto place = static_cast<std::size_t>(std::find(w, w + 3, vertex) - w);
        const std::size_t next = 3 * at(other) + place;
        if (is_done[next] != 0) continue;
        is_done[next] = 1;
        const bool is_same_way = ascends(v, edge) == ascends(w, edge);
        corners.emplace_back(next, is_same_way ? -sign : sign);
      }
    }
  }
  std::vector<std::size_t> around;
  for (const auto& [corner, sign] : corners) around.push_back(corner);
  const Vec3 normal = across_sharp_edges(unit(sum), vertex, around);
  for (const auto& [corner, sign] : corners) corner_normals_[corner] = sign * normal;
}

// The normal at right angles to the sharp edges at the borders of the corners around a vertex.
// Where these edges are one smooth curve, or nearly so, they leave it a choice.
Vec3 SmoothSurface::across_sharp_edges(const Vec3& normal, LocalIndex vertex,
                                       const std::vector<std::size_t>& corners) const
{
  std::set<std::size_t> borders;
  for (const std::size_t corner : corners) {
    const LocalIndex* v = &mesh_->face_vertices[corner - corner % 3];
    for (const std::size_t c : {(corner + 1) % 3, (corner + 2) % 3}) {
      const auto sharp = sharp_.find({std::min(vertex, v[c]), std::max(vertex, v[c])});
      if (sharp != sharp_.end()) borders.insert(sharp->second);
    }
  }
  if (borders.empty() || borders.size() > 2) return normal;
  const auto away = [&](std::size_t row) {
    const Segment& segment = segments_[row];
    const auto& p = segment.points;
    return unit(segment.vertices[0] == vertex ? p[1] - p[0] : p[2] - p[3]);
  };
  const Vec3 first = away(*borders.begin());
  const Vec3 second = away(*borders.rbegin());
  const Vec3 both = cross(first, second);
  const double along = dot(both, normal);
  if (std::abs(along) > kLeastTurn) return (along > 0.0 ? 1.0 : -1.0) * unit(both);
  const Vec3 curve = dot(first, second) < 0.0 ? unit(first - second) : first;
  return in_plane(normal, curve);
}

// Of the curve that goes on through the vertex, away from it along the segment; zero at its end.
Vec3 SmoothSurface::tangent(LocalIndex vertex, std::size_t segment, double least_cosine) const
{
  const std::vector<std::size_t>& around = sharp_at_.at(vertex);
  if (around.size() != 2) return {};
  const auto away = [&](std::size_t s) {
    const Edge& ends = segments_[s].vertices;
    const LocalIndex other = ends[0] == vertex ? ends[1] : ends[0];
    return unit(mesh_->position(other) - mesh_->position(vertex));
  };
  const Vec3 forward = away(segment);
  const Vec3 back = away(around[0] == segment ? around[1] : around[0]);
  return dot(forward, back) > -least_cosine ? Vec3{} : unit(forward - back);
}

// At a curve's end the tangent is such that the segment is symmetric.
void SmoothSurface::make_segments(double feature_angle_deg)
{
  const double least_cosine = cosine_of(feature_angle_deg);
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    const auto& [a, b] = segments_[s].vertices;
    const Vec3 from = mesh_->position(a);
    const Vec3 to = mesh_->position(b);
    const Vec3 along = unit(to - from);
    Vec3 at_a = tangent(a, s, least_cosine);
    Vec3 at_b = tangent(b, s, least_cosine);
    const auto mirrored = [&](const Vec3& other) {
      return other - 2.0 * dot(other, along) * along;
    };
    const bool is_straight = at_a == Vec3{} && at_b == Vec3{};
    if (is_straight) at_a = along;
    if (at_a == Vec3{}) at_a = mirrored(at_b);
    if (at_b == Vec3{}) at_b = mirrored(at_a);
    segments_[s].points = {from, handle(from, to, at_a), handle(to, from, at_b), to};
  }
}

// From the corner `side` to the next one, without these.
std::array<Vec3, 2> SmoothSurface::side_points(LocalIndex face, std::size_t side) const
{
  const LocalIndex* v = &mesh_->face_vertices[3 * at(face)];
  const std::size_t next = (side + 1) % 3;
  const Edge edge{std::min(v[side], v[next]), std::max(v[side], v[next])};
  if (const auto sharp = sharp_.find(edge); sharp != sharp_.end()) {
    const auto& points = segments_[sharp->second].points;
    return v[side] < v[next] ? std::array{points[1], points[2]} : std::array{points[2], points[1]};
  }
  const Vec3 from = mesh_->position(v[side]);
  const Vec3 to = mesh_->position(v[next]);
  return {handle(from, to, in_plane(to - from, corner_normals_[3 * at(face) + side])),
          handle(to, from, in_plane(from - to, corner_normals_[3 * at(face) + next]))};
}

void SmoothSurface::make_patches()
{
  for (LocalIndex f = 0; f < mesh_->num_faces(); ++f) {
    const GregoryPatch::Corners corners = corners_at<3>(mesh_->vertex_xyz, mesh_->face_vertices, f);
    GregoryPatch::Corners normals{};
    GregoryPatch::Sides sides{};
    for (std::size_t c = 0; c < 3; ++c) {
      normals[c] = corner_normals_[3 * at(f) + c];
      sides[c] = side_points(f, c);
    }
    patches_.emplace_back(corners, sides, normals);
  }
}

Vec3 SmoothSurface::on_face(const model::SurfaceParameters& uv) const
{
  const std::size_t face = row_of(uv[0], patches_.size());
  const double b = uv[0] - 2.0 * static_cast<double>(face);
  const double c = uv[1];
  return patches_[face].at({1.0 - b - c, b, c});
}

Vec3 SmoothSurface::on_segment(double t) const
{
  const std::size_t segment = row_of(t, segments_.size());
  const double b = t - 2.0 * static_cast<double>(segment);
  const double a = 1.0 - b;
  const auto& p = segments_[segment].points;
  return (a * a * a) * p[0] + (3.0 * a * b) * (a * p[1] + b * p[2]) + (b * b * b) * p[3];
}

void SmoothSurface::add_parameters(mesh::CoarseMesh& mesh) const
{
  for (std::size_t f = 0; f < patches_.size(); ++f) {
    const double first = 2.0 * static_cast<double>(f);
    mesh.face_uv.insert(mesh.face_uv.end(), {first, 0.0, first + 1.0, 0.0, first, 1.0});
  }
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    const double first = 2.0 * static_cast<double>(s);
    mesh.segment_vertices.insert(mesh.segment_vertices.end(), segments_[s].vertices.begin(),
                                 segments_[s].vertices.end());
    mesh.segment_curve.push_back(0);
    mesh.segment_t.insert(mesh.segment_t.end(), {first, first + 1.0});
  }
}

}  // namespace tessera::coarse

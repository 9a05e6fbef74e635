// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/domains/skin_distance.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/model/winding.hpp"

namespace tessera::coarse {
namespace {

// Cosine of the angle to a normal below which the normal does not say on which side a point lies.
constexpr double kLeastCosine = 0.1;

std::vector<std::array<Vec3, 3>> triangles_of(const surface::DomainSkin& skin)
{
  std::vector<std::array<Vec3, 3>> triangles;
  for (std::size_t t = 0; 3 * t < skin.triangle_vertices.size(); ++t) {
    triangles.push_back(corners_at<3>(skin.vertex_xyz, skin.triangle_vertices, t));
  }
  return triangles;
}

std::vector<Vec3> vertex_normals(const surface::DomainSkin& skin,
                                 const std::vector<std::array<Vec3, 3>>& triangles)
{
  std::vector<Vec3> normals(skin.vertex.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::array<Vec3, 3>& p = triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = p[(c + 1) % 3] - p[c];
      const Vec3 b = p[(c + 2) % 3] - p[c];
      Vec3& normal = normals[at(skin.triangle_vertices[3 * t + c])];
      normal = normal + angle_between(a, b) * unit_normal_of(p);
    }
  }
  return normals;
}

mesh::NumberedRows<2> edges_of(const surface::DomainSkin& skin)
{
  std::vector<std::array<LocalIndex, 2>> sides;
  for (std::size_t i = 0; i < skin.triangle_vertices.size(); ++i) {
    const LocalIndex* v = &skin.triangle_vertices[3 * (i / 3)];
    sides.push_back(mesh::sorted_edge(v[i % 3], v[(i % 3 + 1) % 3]));
  }
  return mesh::number_rows(sides);
}

std::vector<Vec3> edge_normals(const mesh::NumberedRows<2>& edges,
                               const std::vector<std::array<Vec3, 3>>& triangles)
{
  std::vector<Vec3> normals(edges.rows.size());
  for (std::size_t i = 0; i < edges.row_of.size(); ++i) {
    Vec3& normal = normals[at(edges.row_of[i])];
    normal = normal + unit_normal_of(triangles[i / 3]);
  }
  return normals;
}

double squared_distance_from_line(const Vec3& point, const Vec3& a, const Vec3& b)
{
  const Vec3 across = cross(b - a, point - a);
  return dot(across, across) / dot(b - a, b - a);
}

}  // namespace

SkinDistance::SkinDistance(const surface::DomainSkin& skin)
    : skin_(skin),
      triangles_(triangles_of(skin)),
      vertex_normals_(vertex_normals(skin, triangles_)),
      edges_(edges_of(skin)),
      edge_normals_(edge_normals(edges_, triangles_)),
      search_(triangles_)
{
}

SkinDistance::Place SkinDistance::find(const Vec3& point, double least) const
{
  const model::NearestPoint nearest = search_.nearest(point);
  if (nearest.squared_distance < least * least) return {};
  const double cosine = dot(unit(point - nearest.xyz), unit(normal_at(nearest)));
  const bool is_inside = std::abs(cosine) > kLeastCosine ? cosine < 0.0 : is_wound_around(point);
  return {is_inside ? -1 : 1, std::sqrt(nearest.squared_distance)};
}

// At a vertex or an edge one triangle says nothing. The mean of those around does, by their angles
// at a vertex. @cite baerentzen2005
Vec3 SkinDistance::normal_at(const model::NearestPoint& nearest) const
{
  const std::array<Vec3, 3>& corners = triangles_[at(nearest.simplex)];
  for (std::size_t c = 0; c < 3; ++c) {
    if (nearest.xyz != corners[c]) continue;
    return vertex_normals_[at(skin_.triangle_vertices[3 * at(nearest.simplex) + c])];
  }
  constexpr double kOnEdge = 1e-6;  // Of its length.
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3& a = corners[c];
    const Vec3& b = corners[(c + 1) % 3];
    if (squared_distance_from_line(nearest.xyz, a, b) < kOnEdge * kOnEdge * dot(b - a, b - a)) {
      return edge_normals_[at(edges_.row_of[3 * at(nearest.simplex) + c])];
    }
  }
  return unit_normal_of(corners);
}

bool SkinDistance::is_wound_around(const Vec3& point) const
{
  double angle = 0.0;
  for (const auto& corners : triangles_) angle += model::solid_angle(corners, point);
  return angle > 2.0 * std::numbers::pi;
}

bool InsideFinder::is_inside(const Vec3& point, double least)
{
  constexpr double kRounding = 1e-9;
  const double free = (1.0 - kRounding) * place_.distance - norm(point - last_);
  if (place_.side < 0 && free >= least) return true;
  if (place_.side > 0 && free > 0.0) return false;
  last_ = point;
  place_ = distance_.find(point, least);
  return place_.side < 0;
}

}  // namespace tessera::coarse

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/reference.hpp"

#include <algorithm>
#include <utility>

#include "tessera/base/triangle.hpp"

namespace tessera::surface {
namespace {

// A triangle with a smaller height, as a part of its longest edge, has a normal of rounding.
constexpr double kFlat = 1e-6;

// Unit normals that differ by less are one.
constexpr double kSameNormal = 1e-9;

// Unit normal, or zero for a flat triangle.
Vec3 sound_normal_of(const std::array<Vec3, 3>& corners)
{
  const Vec3 n = normal_of(corners);
  const double longest = longest_side(corners);
  const double length = norm(n);
  return length <= kFlat * longest * longest ? Vec3{} : (1.0 / length) * n;
}

// Weights of the corners at the foot of the perpendicular from `point`, kept within the triangle.
Vec3 weights_at(const std::array<Vec3, 3>& corners, const Vec3& point)
{
  const Vec3 n = normal_of(corners);
  Vec3 weights{};
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3& next = corners[(c + 1) % 3];
    weights[c] = std::max(0.0, dot(n, cross(corners[(c + 2) % 3] - next, point - next)));
    sum += weights[c];
  }
  return sum > 0.0 ? (1.0 / sum) * weights : Vec3{1.0, 0.0, 0.0};
}

}  // namespace

SurfaceReference::SurfaceReference(PatchSurface surface) : surface_(std::move(surface))
{
  std::vector<std::vector<LocalIndex>> all(at(surface_.num_patches()));
  std::vector<std::vector<LocalIndex>> sound(all.size());
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
    normals_.push_back(sound_normal_of(surface_.corners(t)));
    const std::size_t patch = at(surface_.triangle_patch[t]);
    all[patch].push_back(static_cast<LocalIndex>(t));
    if (normals_.back() != Vec3{}) sound[patch].push_back(static_cast<LocalIndex>(t));
  }
  for (std::size_t p = 0; p < all.size(); ++p) add_patch(sound[p].empty() ? all[p] : sound[p]);
  add_curves();
}

void SurfaceReference::add_curves()
{
  std::vector<std::vector<std::array<Vec3, 2>>> segments;
  for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
    const std::size_t curve = at(surface_.edge_curve[e]);
    if (curve >= curves_.size()) {
      curves_.resize(curve + 1);
      segments.resize(curve + 1);
    }
    curves_[curve].edges.push_back(e);
    segments[curve].push_back({surface_.vertex_xyz[at(surface_.edges[e][0])],
                               surface_.vertex_xyz[at(surface_.edges[e][1])]});
  }
  for (std::size_t c = 0; c < segments.size(); ++c) {
    if (!segments[c].empty()) curves_[c].search.emplace(segments[c]);
  }
}

void SurfaceReference::add_patch(const std::vector<LocalIndex>& triangles)
{
  std::vector<std::array<Vec3, 3>> corners;
  corners.reserve(triangles.size());
  for (const LocalIndex t : triangles) corners.push_back(surface_.corners(at(t)));
  const bool is_flat = std::ranges::all_of(triangles, [&](LocalIndex t) {
    return norm(normals_[at(t)] - normals_[at(triangles.front())]) < kSameNormal;
  });
  patches_.push_back({triangles, model::TriangleSearch(corners), is_flat});
}

std::size_t SurfaceReference::nearest_triangle(LocalIndex patch, const Vec3& point) const
{
  const Patch& found = patches_[at(patch)];
  return at(found.triangles[at(found.search.nearest(point).simplex)]);
}

Vec3 SurfaceReference::on_patch(LocalIndex patch, const Vec3& point) const
{
  return place_on_patch(patch, point).xyz;
}

SurfaceReference::Place SurfaceReference::place_on_patch(LocalIndex patch, const Vec3& point) const
{
  const Patch& found = patches_[at(patch)];
  const model::NearestPoint nearest = found.search.nearest(point);
  return {nearest.xyz, normals_[at(found.triangles[at(nearest.simplex)])]};
}

const Vec3* SurfaceReference::normal_of_plane(LocalIndex patch) const
{
  const Patch& found = patches_[at(patch)];
  return found.is_flat ? &normals_[at(found.triangles.front())] : nullptr;
}

Vec3 SurfaceReference::on_curve(LocalIndex curve, const Vec3& point) const
{
  return curves_[at(curve)].search.value().nearest(point).xyz;
}

Vec3 SurfaceReference::normal(LocalIndex patch, const Vec3& point) const
{
  const Patch& found = patches_[at(patch)];
  return normals_[found.is_flat ? at(found.triangles.front()) : nearest_triangle(patch, point)];
}

model::SurfaceParameters SurfaceReference::parameters(LocalIndex patch, const Vec3& point) const
{
  model::SurfaceParameters mean{};
  if (surface_.triangle_uv.empty()) return mean;
  const std::size_t t = nearest_triangle(patch, point);
  const Vec3 weights = weights_at(surface_.corners(t), point);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t d = 0; d < 2; ++d) mean[d] += weights[c] * surface_.triangle_uv[t][c][d];
  }
  return mean;
}

double SurfaceReference::curve_parameter(LocalIndex curve, const Vec3& point) const
{
  if (surface_.edge_t.empty()) return 0.0;
  const Curve& found = curves_[at(curve)];
  const model::NearestPoint nearest = found.search.value().nearest(point);
  const std::size_t e = found.edges[at(nearest.simplex)];
  const Vec3& a = surface_.vertex_xyz[at(surface_.edges[e][0])];
  const Vec3& b = surface_.vertex_xyz[at(surface_.edges[e][1])];
  const double along = norm(b - a) > 0.0 ? norm(nearest.xyz - a) / norm(b - a) : 0.0;
  return (1.0 - along) * surface_.edge_t[e][0] + along * surface_.edge_t[e][1];
}

}  // namespace tessera::surface

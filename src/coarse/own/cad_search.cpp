// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/own/cad_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/triangle.hpp"

namespace tessera::coarse {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// How far the CAD's triangles may be off the CAD, in parts of the size that they were made for. Two
// to a radius are off by 1/16.
constexpr double kSlack = 0.1;

}  // namespace

CadSearch::CadSearch(const CadSurface& cad, const surface::SurfaceReference& reference,
                     const model::Model& model)
    : cad_(cad), reference_(reference), model_(model)
{
  find_boxes();
  find_patches_of_curves();
  find_corners();
}

void CadSearch::find_boxes()
{
  boxes_.resize(at(cad_.triangles.num_patches()));
  for (std::size_t t = 0; t < cad_.triangles.triangles.size(); ++t) {
    boxes_[at(cad_.triangles.triangle_patch[t])].include(box_of(cad_.triangles.corners(t)));
  }
}

void CadSearch::find_patches_of_curves()
{
  const surface::PatchSurface& surface = cad_.triangles;
  patches_of_curve_.resize(cad_.curve_number.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const surface::PatchSurface::Triangle& v = surface.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(v[c], v[(c + 1) % 3]);
      const surface::PatchSurface::Edge edge{low, high};
      const auto found = std::ranges::lower_bound(surface.edges, edge);
      if (found == surface.edges.end() || *found != edge) continue;
      const auto row = static_cast<std::size_t>(found - surface.edges.begin());
      patches_of_curve_[at(surface.edge_curve[row])].insert(surface.triangle_patch[t]);
    }
  }
}

// Where not just two edges of one curve meet.
void CadSearch::find_corners()
{
  std::map<LocalIndex, std::vector<LocalIndex>> curves_at;
  for (std::size_t e = 0; e < cad_.triangles.edges.size(); ++e) {
    for (const LocalIndex v : cad_.triangles.edges[e]) {
      curves_at[v].push_back(cad_.triangles.edge_curve[e]);
    }
  }
  for (const auto& [vertex, curves] : curves_at) {
    const bool is_inside = curves.size() == 2 && curves[0] == curves[1];
    if (!is_inside) corners_.push_back(cad_.triangles.vertex_xyz[at(vertex)]);
  }
}

std::vector<LocalIndex> CadSearch::patches_near(const Vec3& point, double tolerance) const
{
  const double reach = tolerance + kSlack * cad_.size;
  std::vector<LocalIndex> near;
  for (LocalIndex p = 0; p < cad_.triangles.num_patches(); ++p) {
    if (!boxes_[at(p)].widened(reach).holds(point)) continue;
    if (norm(reference_.on_patch(p, point) - point) > reach) continue;
    if (on_patch(p, point).distance <= tolerance) near.push_back(p);
  }
  return near;
}

std::pair<LocalIndex, CadPlace> CadSearch::nearest_patch(const Vec3& point) const
{
  std::pair<LocalIndex, CadPlace> nearest{kNoIndex, {point, kFar}};
  for (LocalIndex p = 0; p < cad_.triangles.num_patches(); ++p) {
    const Vec3 xyz = reference_.on_patch(p, point);
    const double distance = norm(xyz - point);
    if (distance < nearest.second.distance) nearest = {p, {xyz, distance}};
  }
  return nearest;
}

template <class Project>
CadPlace CadSearch::found(const Vec3& point, const Project& project) const
{
  const auto xyz = projections_.run<GeometryError>(project);
  return xyz ? CadPlace{*xyz, norm(*xyz - point)} : CadPlace{point, kFar};
}

CadPlace CadSearch::on_patch(LocalIndex patch, const Vec3& point) const
{
  return found(point, [&] {
    return model_
        .project_to_surface(cad_.patch_surface[at(patch)], point,
                            reference_.parameters(patch, point))
        .xyz;
  });
}

CadPlace CadSearch::on_curve(LocalIndex curve, const Vec3& point) const
{
  return found(point, [&] {
    return model_
        .project_to_curve(cad_.curve_number[at(curve)], point,
                          reference_.curve_parameter(curve, point))
        .xyz;
  });
}

double CadSearch::misfit(LocalIndex patch, const std::array<Vec3, 3>& triangle) const
{
  constexpr double kNormalWeight = 0.5;
  const Vec3 middle = middle_of(triangle);
  double sum = norm(reference_.on_patch(patch, middle) - middle);
  for (const Vec3& corner : triangle) {
    const Vec3 inner = midpoint(middle, corner);
    sum += norm(reference_.on_patch(patch, inner) - inner);
  }
  const Vec3 n = normal_of(triangle);
  const double cosine = std::abs(dot(n, reference_.normal(patch, middle))) / norm(n);
  return 0.25 * sum / longest_side(triangle) + kNormalWeight * (1.0 - cosine);
}

std::vector<LocalIndex> CadSearch::curves_between(LocalIndex a, LocalIndex b) const
{
  std::vector<LocalIndex> curves;
  for (std::size_t c = 0; c < patches_of_curve_.size(); ++c) {
    const auto& patches = patches_of_curve_[c];
    if (patches.contains(a) && patches.contains(b)) curves.push_back(static_cast<LocalIndex>(c));
  }
  return curves;
}

CadPlace CadSearch::nearest_corner(const Vec3& point) const
{
  CadPlace nearest{point, kFar};
  for (const Vec3& corner : corners_) {
    const double distance = norm(corner - point);
    if (distance < nearest.distance) nearest = {corner, distance};
  }
  return nearest;
}

}  // namespace tessera::coarse

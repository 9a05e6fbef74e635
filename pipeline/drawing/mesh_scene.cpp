// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/mesh_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/box.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "pipeline/drawing/coarse_boundary.hpp"
#include "pipeline/drawing/flat_triangles.hpp"

namespace tessera::pipeline {
namespace {

constexpr Room kRoom{.width = 1100, .most_height = 900, .margin = 24};
constexpr LocalIndex kNumBins = 10;
constexpr LocalIndex kPlain = kNumBins;  // Row of what has no quality: the surface behind the cut.

constexpr Vec3 kEye{1.0, -1.7, 1.1};
constexpr std::array<Vec3, 3> kEyeOfCut{{{1.7, -0.8, 0.6}, {0.6, -1.7, 0.7}, {0.5, -0.9, 1.7}}};

// A plane through vertices of a regular mesh would touch tets instead of cutting them.
constexpr double kOffMiddle = 0.0137;

CutPlane plane_for(std::span<const double> xyz)
{
  const Box box = bounding_box(xyz);
  const Vec3 extent = box.extent();
  // Of equal sides the one that faces the eye most.
  std::size_t axis = 1;
  for (const std::size_t other : {std::size_t{0}, std::size_t{2}}) {
    if (extent[other] < (1.0 - 1e-9) * extent[axis]) axis = other;
  }
  return {.axis = axis,
          .towards_eye = axis == 1 ? -1.0 : 1.0,
          .position = 0.5 * (box.low[axis] + box.high[axis]) + kOffMiddle * extent[axis]};
}

Canvas canvas_for(const Vec3& eye, std::span<const double> xyz)
{
  return Canvas(fit_camera(view_from(eye), xyz, kRoom));
}

template <class Values>
LocalIndex value_of(const Values& arrays, const std::string& name, std::size_t cell)
{
  const auto found = arrays.find(name);
  return found == arrays.end() ? 0 : found->second[cell];
}

Colour mixed(const Colour& a, const Colour& b, double share_of_b)
{
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] =
        static_cast<std::uint8_t>(std::lround((1.0 - share_of_b) * a[c] + share_of_b * b[c]));
  }
  return colour;
}

}  // namespace

const std::vector<Colour>& quality_colours()
{
  static const std::vector<Colour> kColours = [] {
    constexpr std::array<Colour, 5> kAnchors{
        {{176, 24, 48}, {240, 140, 60}, {250, 226, 140}, {132, 196, 200}, {48, 104, 176}}};
    std::vector<Colour> colours;
    for (LocalIndex bin = 0; bin < kNumBins; ++bin) {
      const double place = 4.0 * bin / (kNumBins - 1);
      const auto anchor = std::min<std::size_t>(static_cast<std::size_t>(place), 3);
      colours.push_back(
          mixed(kAnchors[anchor], kAnchors[anchor + 1], place - static_cast<double>(anchor)));
    }
    return colours;
  }();
  return kColours;
}

MeshScene::MeshScene(std::span<const double> xyz)
    : plane_(plane_for(xyz)),
      subdomains_(canvas_for(kEye, xyz)),
      patches_(subdomains_),
      cut_(canvas_for(kEyeOfCut[plane_.axis], xyz))
{
}

void MeshScene::draw_surface(const Triangle& corners, LocalIndex subdomain, LocalIndex patch,
                             Sides sides)
{
  subdomains_.draw(corners, subdomain, sides);
  patches_.draw(corners, patch);
  const auto stays = [&](const Vec3& p) { return plane_.height(p) <= 0.0; };
  if (std::ranges::any_of(corners, stays)) cut_.draw(corners, kPlain, sides);
}

void MeshScene::draw_boundary(const mesh::MeshArrays& boundary)
{
  const Sides sides = boundary.vertices_per_cell == 3 ? Sides::drawn : Sides::hidden;
  const std::span<const double> xyz(boundary.point_xyz);
  for_each_flat_triangle(boundary, [&](std::size_t cell, const std::array<LocalIndex, 3>& points) {
    const auto [a, b, c] = points;
    draw_surface({point_at(xyz, a), point_at(xyz, b), point_at(xyz, c)},
                 value_of(boundary.cell_ints, "subdomain", cell),
                 value_of(boundary.cell_ints, "patch", cell), sides);
  });
}

void MeshScene::draw_coarse_boundary(const subdomain::PartitionedMesh& cut,
                                     const std::vector<char>& is_made)
{
  for (const CoarseTriangle& triangle : coarse_boundary(cut, is_made)) {
    if (triangle.is_between) continue;
    const auto [a, b, c] = triangle.vertices;
    draw_surface({cut.coarse.position(a), cut.coarse.position(b), cut.coarse.position(c)},
                 triangle.subdomain, triangle.patch, Sides::hidden);
  }
}

void MeshScene::draw_cut_tet(const std::array<Vec3, 4>& corners, double mean_ratio)
{
  const auto stays = [&](const Vec3& p) { return plane_.height(p) <= 0.0; };
  if (std::ranges::all_of(corners, stays) || std::ranges::none_of(corners, stays)) return;
  const LocalIndex bin =
      std::clamp(static_cast<LocalIndex>(mean_ratio * kNumBins), 0, kNumBins - 1);
  for (const auto& [a, b, c] : mesh::kTetFaceCorners) {
    cut_.draw({corners[a], corners[b], corners[c]}, bin, Sides::drawn);
  }
}

void MeshScene::draw_cut_tets(const mesh::MeshArrays& tets)
{
  const auto width = static_cast<std::size_t>(tets.vertices_per_cell);
  for (GlobalIndex cell = 0; cell < tets.num_cells(); ++cell) {
    const auto points = std::span(tets.cell_points).subspan(width * static_cast<std::size_t>(cell));
    const auto corners = corners_at<4>(tets.point_xyz, points, 0);
    draw_cut_tet(corners, quality::mean_ratio(corners));
  }
}

void MeshScene::draw_coarse_cut(const subdomain::PartitionedMesh& cut, LocalIndex subdomain,
                                double mean_ratio)
{
  for (const LocalIndex t : cut.tets[subdomain]) {
    draw_cut_tet(corners_at<4>(cut.coarse.vertex_xyz, cut.coarse.tet_vertices, t), mean_ratio);
  }
}

bool MeshScene::is_cut(const subdomain::PartitionedMesh& cut, LocalIndex subdomain) const
{
  constexpr double kBulge = 0.1;  // Of the extent across the plane.
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const LocalIndex t : cut.tets[subdomain]) {
    for (const LocalIndex v : cut.coarse.tet(t)) {
      const double height = plane_.height(cut.coarse.position(v));
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  const double bulge = kBulge * (high - low);
  return low - bulge <= 0.0 && high + bulge > 0.0;
}

std::vector<MeshPicture> MeshScene::pictures() const
{
  std::vector<Colour> cut_colours = quality_colours();
  cut_colours.push_back({205, 205, 200});
  const Paint distinct{.colours = distinct_colours()};
  return {{"subdomains", to_png(paint(subdomains_, distinct))},
          {"patches", to_png(paint(patches_, distinct))},
          {"cut", to_png(paint(cut_, {.colours = cut_colours, .has_borders = false}))}};
}

}  // namespace tessera::pipeline

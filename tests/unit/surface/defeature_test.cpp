// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/defeature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/overlap.hpp"

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"

namespace tessera::surface {
namespace {

using Profile = std::vector<std::array<double, 2>>;

constexpr double kStep = 0.001;
constexpr double kTolerance = 0.01;

// The profile of a block whose upper half is narrower by `step`. Edge 4 is the step's face.
Profile block_with_step(double step = kStep)
{
  return {{10.0, 0.0}, {10.0, 6.0}, {step, 6.0}, {step, 3.0}, {0.0, 3.0}, {0.0, 0.0}};
}

// A profile in x and z between y = 0 and y = 10, and its curves as straight lines. Patch k is the
// wall at edge k. Curves come in threes: at both ends of the wall, then where the next one begins.
class Prism {
 public:
  explicit Prism(const Profile& profile) : n_(static_cast<LocalIndex>(profile.size()))
  {
    for (const auto& [x, z] : profile) {
      surface.vertex_xyz.push_back({x, 0.0, z});
      surface.vertex_xyz.push_back({x, 10.0, z});
    }
    surface.vertex_is_fixed.assign(surface.vertex_xyz.size(), 1);
    surface.patch_materials.assign(at(n_ + 2), {1, 0});
    for (LocalIndex k = 0; k < n_; ++k) add_wall(k);
    for (LocalIndex k = 1; k + 1 < n_; ++k) {
      add_triangle({0, 2 * k, 2 * k + 2}, n_);
      add_triangle({1, 2 * k + 3, 2 * k + 1}, n_ + 1);
    }
    sort_edges();
  }

  // Puts a vertex on the line that leaves corner k of the profile.
  void cut_line(LocalIndex k, double y)
  {
    const LocalIndex curve = 3 * ((k + n_ - 1) % n_) + 2;
    const auto on = std::ranges::find_if(surface.edges, [&](const auto& edge) {
      const double a = surface.vertex_xyz[at(edge[0])][1];
      const double b = surface.vertex_xyz[at(edge[1])][1];
      const auto e = static_cast<std::size_t>(&edge - surface.edges.data());
      return surface.edge_curve[e] == curve && std::min(a, b) < y && y < std::max(a, b);
    });
    ASSERT_NE(on, surface.edges.end());
    split(static_cast<std::size_t>(on - surface.edges.begin()), y);
  }

  // The line that leaves corner k is no curve any more, and the walls beside it are one.
  void forget_line(LocalIndex k)
  {
    const LocalIndex curve = 3 * (k - 1) + 2;
    for (std::size_t e = surface.edges.size(); e-- > 0;) {
      if (surface.edge_curve[e] != curve) continue;
      surface.edges.erase(surface.edges.begin() + static_cast<std::ptrdiff_t>(e));
      surface.edge_curve.erase(surface.edge_curve.begin() + static_cast<std::ptrdiff_t>(e));
    }
    std::ranges::replace(surface.triangle_patch, k, k - 1);
  }

  [[nodiscard]] Vec3 on_curve(LocalIndex curve, const Vec3& point) const
  {
    const auto& [a, b] = lines_.at(curve);
    return a + (dot(point - a, b - a) / dot(b - a, b - a)) * (b - a);
  }

  Defeatured merge(double tolerance = kTolerance, const KeptParts& kept = {})
  {
    return defeature(
        surface,
        [this](LocalIndex curve, LocalIndex, const Vec3& point) { return on_curve(curve, point); },
        MergeLimits{tolerance, kept, {}});
  }

  PatchSurface surface{};

 private:
  void add_triangle(const PatchSurface::Triangle& v, LocalIndex patch)
  {
    surface.triangles.push_back(v);
    surface.triangle_patch.push_back(patch);
  }

  void add_edge(LocalIndex a, LocalIndex b, LocalIndex curve)
  {
    surface.edges.push_back({std::min(a, b), std::max(a, b)});
    surface.edge_curve.push_back(curve);
    lines_[curve] = {surface.vertex_xyz[at(a)], surface.vertex_xyz[at(b)]};
  }

  void add_wall(LocalIndex k)
  {
    const LocalIndex a = 2 * k;
    const LocalIndex b = 2 * ((k + 1) % n_);
    add_triangle({a, a + 1, b}, k);
    add_triangle({b, a + 1, b + 1}, k);
    add_edge(a, b, 3 * k);
    add_edge(a + 1, b + 1, 3 * k + 1);
    add_edge(b, b + 1, 3 * k + 2);
  }

  void split(std::size_t e, double y)
  {
    const auto [a, b] = surface.edges[e];
    const auto middle = static_cast<LocalIndex>(surface.vertex_xyz.size());
    Vec3 point = surface.vertex_xyz[at(a)];
    point[1] = y;
    surface.vertex_xyz.push_back(point);
    surface.vertex_is_fixed.push_back(0);
    for (std::size_t t = 0, num = surface.triangles.size(); t < num; ++t) {
      PatchSurface::Triangle& v = surface.triangles[t];
      if (std::ranges::count(v, a) + std::ranges::count(v, b) < 2) continue;
      PatchSurface::Triangle other = v;
      std::ranges::replace(v, a, middle);
      std::ranges::replace(other, b, middle);
      add_triangle(other, surface.triangle_patch[t]);
    }
    surface.edges[e] = {std::min(a, middle), std::max(a, middle)};
    surface.edges.push_back({std::min(b, middle), std::max(b, middle)});
    surface.edge_curve.push_back(surface.edge_curve[e]);
    sort_edges();
  }

  void sort_edges()
  {
    std::map<PatchSurface::Edge, LocalIndex> curves;
    for (std::size_t e = 0; e < surface.edges.size(); ++e)
      curves[surface.edges[e]] = surface.edge_curve[e];
    surface.edges.clear();
    surface.edge_curve.clear();
    for (const auto& [edge, curve] : curves) {
      surface.edges.push_back(edge);
      surface.edge_curve.push_back(curve);
    }
  }

  LocalIndex n_;
  std::map<LocalIndex, std::array<Vec3, 2>> lines_{};
};

double volume_of(const PatchSurface& surface)
{
  double volume = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    volume += tet_volume({}, a, b, c);
  }
  return volume;
}

double least_height(const PatchSurface& surface)
{
  double least = 1e9;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    least = std::min(least, 2.0 * triangle_area(a, b, c) / longest);
  }
  return least;
}

// Closed, without crossings, and its curves are between its patches.
void expect_sound(const PatchSurface& surface)
{
  std::set<PatchSurface::Edge> sides;
  for (const PatchSurface::Triangle& v : surface.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_TRUE(sides.insert({v[c], v[(c + 1) % 3]}).second);
    }
  }
  for (const auto& [a, b] : sides) EXPECT_TRUE(sides.contains({b, a}));
  EXPECT_NO_THROW(validate(surface));
  EXPECT_TRUE(find_overlaps(surface).empty());
}

std::vector<LocalIndex> numbers(const std::vector<MergedPart>& parts)
{
  std::vector<LocalIndex> found;
  for (const MergedPart& part : parts) found.push_back(part.number);
  return found;
}

TEST(Defeature, LeavesASurfaceWithoutSmallPartsAsItIs)
{
  Prism prism(block_with_step(1.0));
  const PatchSurface before = prism.surface;
  const Defeatured done = prism.merge();
  EXPECT_FALSE(done.is_any());
  EXPECT_EQ(prism.surface.triangles, before.triangles);
  EXPECT_EQ(prism.surface.vertex_xyz, before.vertex_xyz);
}

TEST(Defeature, MergesTheFaceOfAStepAndNamesIt)
{
  Prism prism(block_with_step());
  expect_sound(prism.surface);
  const Defeatured done = prism.merge();
  expect_sound(prism.surface);
  EXPECT_GT(least_height(prism.surface), 1.0);
  EXPECT_NEAR(volume_of(prism.surface), 600.0, 0.05);
  EXPECT_EQ(prism.surface.vertex_xyz.size(), 10U);
  ASSERT_EQ(numbers(done.patches), (std::vector<LocalIndex>{3}));
  EXPECT_NEAR(done.patches.front().measure, 10.0 * kStep, 1e-12);
  EXPECT_NEAR(done.patches.front().centre[2], 3.0, 1e-12);
  ASSERT_EQ(done.curves.size(), 3U) << "two short ones, and one of two that became one";
  EXPECT_NEAR(done.curves[0].measure, kStep, 1e-15);
  EXPECT_NEAR(done.curves[1].measure, kStep, 1e-15);
  EXPECT_NEAR(done.curves[2].measure, 10.0, 1e-12);
  EXPECT_EQ(done.places.size(), 2U);
}

TEST(Defeature, MergesAFaceWhosePointsAreNotOpposite)
{
  Prism prism(block_with_step());
  for (const double y : {3.0, 6.0}) prism.cut_line(3, y);
  for (const double y : {2.0, 5.0, 8.0}) prism.cut_line(4, y);
  expect_sound(prism.surface);
  const Defeatured done = prism.merge();
  expect_sound(prism.surface);
  EXPECT_EQ(numbers(done.patches), (std::vector<LocalIndex>{3}));
  EXPECT_GT(least_height(prism.surface), 0.1);
  EXPECT_NEAR(volume_of(prism.surface), 600.0, 0.05);
}

TEST(Defeature, MovesNothingByMoreThanTheTolerance)
{
  // Steps side by side: each is small, all together are not.
  Profile stairs{{10.0, 0.0}, {10.0, 6.0}};
  for (int k = 5; k >= 0; --k) {
    stairs.push_back({0.004 * k, 3.0 + 0.004 * k});
    stairs.push_back({0.004 * k, 3.0 + 0.004 * (k - 1)});
  }
  stairs.back() = {0.0, 0.0};
  Prism prism(stairs);
  const std::vector<Vec3> before = prism.surface.vertex_xyz;
  const Defeatured done = prism.merge();
  expect_sound(prism.surface);
  EXPECT_TRUE(done.is_any());
  for (const Vec3& was : before) {
    EXPECT_TRUE(std::ranges::any_of(prism.surface.vertex_xyz,
                                    [&](const Vec3& is) { return norm(is - was) <= kTolerance; }));
  }
}

// A face that is wider than the tolerance, with vertices inside that are near both of its sides.
TEST(Defeature, MovesNoCurveByMoreThanTheTolerance)
{
  constexpr double kWidth = 1.2 * kTolerance;
  Prism prism({{10.0, 0.0},
               {10.0, 6.0},
               {kWidth, 6.0},
               {kWidth, 3.0},
               {0.6 * kWidth, 3.0},
               {0.0, 3.0},
               {0.0, 0.0}});
  for (const double y : {2.0, 5.0, 8.0}) prism.cut_line(4, y);
  prism.forget_line(4);
  static_cast<void>(prism.merge());
  expect_sound(prism.surface);
  for (std::size_t e = 0; e < prism.surface.edges.size(); ++e) {
    for (const LocalIndex v : prism.surface.edges[e]) {
      const Vec3& is = prism.surface.vertex_xyz[at(v)];
      EXPECT_LE(norm(prism.on_curve(prism.surface.edge_curve[e], is) - is), kTolerance);
    }
  }
}

TEST(Defeature, LeavesAPlateThatIsThinnerThanTheToleranceClosed)
{
  Prism prism({{0.0, 0.0}, {10.0, 0.0}, {10.0, 0.005}, {0.0, 0.005}});
  static_cast<void>(prism.merge());
  ASSERT_FALSE(prism.surface.triangles.empty());
  expect_sound(prism.surface);
}

TEST(Defeature, KeepsPatchesAndCurvesThatTheCaseNames)
{
  constexpr LocalIndex kOfStep = 3;
  Prism with_patch(block_with_step());
  EXPECT_FALSE(with_patch.merge(kTolerance, {.patches = {kOfStep}}).is_any());

  constexpr LocalIndex kLong = 3 * kOfStep + 2;
  Prism with_curve(block_with_step());
  const Defeatured done = with_curve.merge(kTolerance, {.curves = {kLong}});
  EXPECT_NE(std::ranges::find(with_curve.surface.edge_curve, kLong),
            with_curve.surface.edge_curve.end());
  EXPECT_TRUE(std::ranges::none_of(done.curves,
                                   [](const MergedPart& curve) { return curve.number == kLong; }));
  expect_sound(with_curve.surface);
}

TEST(Defeature, LeavesAPlateThatIsThinnerThanTheTolerance)
{
  Prism plate({{10.0, 0.0}, {10.0, 0.5 * kTolerance}, {0.0, 0.5 * kTolerance}, {0.0, 0.0}});
  EXPECT_FALSE(plate.merge().is_any()) << "its sides would lie on each other, first at a corner";
}

TEST(Defeature, LeavesWhatIsJustAsLongAsTheTolerance)
{
  Prism prism(block_with_step(kTolerance));
  EXPECT_FALSE(prism.merge().is_any());
}

TEST(Defeature, KeepsParametersOfACoarseSurface)
{
  const testing::CylinderModel model;
  CoarseSurface surface;
  surface.mesh = testing::cylinder(4);
  mesh::CoarseMesh& mesh = surface.mesh;
  mesh.tet_vertices.clear();
  mesh.tet_material.clear();
  surface.face_domains.assign(at(mesh.num_faces()), {1, 0});
  surface.domain_material = {1};
  surface.domain_max_size = {1.0};
  ASSERT_GT(mesh.num_segments(), 0);
  // Edges of a curve that are half as long as others are merged.
  const LocalIndex a = mesh.segment_vertices[0];
  const LocalIndex b = mesh.segment_vertices[1];
  const double length = norm(mesh.position(a) - mesh.position(b));
  const LocalIndex before = mesh.num_faces();
  const bool is_any = defeature(surface, model, MergeLimits{.tolerance = 1.0001 * length});
  EXPECT_TRUE(is_any);
  EXPECT_EQ(is_any, surface.defeatured.is_any());
  EXPECT_LT(mesh.num_faces(), before);
  ASSERT_EQ(mesh.face_uv.size(), 6 * at(mesh.num_faces()));
  ASSERT_EQ(mesh.segment_t.size(), mesh.segment_vertices.size());
  for (std::size_t end = 0; end < mesh.segment_vertices.size(); ++end) {
    const Vec3 point = mesh.position(mesh.segment_vertices[end]);
    const model::CurvePoint found =
        model.project_to_curve(mesh.segment_curve[end / 2], point, mesh.segment_t[end]);
    EXPECT_NEAR(norm(found.xyz - point), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace tessera::surface

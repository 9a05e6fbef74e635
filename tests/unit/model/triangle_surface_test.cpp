// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/triangle_surface.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

#include "support/stl_models.hpp"

namespace tessera::model {
namespace {

using testing::cube_soup;
using testing::joined;
using testing::sphere_soup;

double enclosed_volume(const TriangleSurface& surface)
{
  double volume = 0.0;
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    volume += tet_volume({}, a, b, c);
  }
  return volume;
}

void turn_all(TriangleSoup& soup)
{
  for (LocalIndex t = 0; t < soup.num_triangles(); ++t) testing::turn_triangle(soup, t);
}

// What check_surface() says of a soup it refuses; empty if it does not.
std::string refusal_of(const TriangleSoup& soup)
{
  try {
    (void)check_surface(soup, "part.stl");
  } catch (const GeometryError& error) {
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(TriangleSurface, SoundCubeNeedsNoRepair)
{
  const CheckedSurface checked = check_surface(cube_soup(), "cube");
  EXPECT_TRUE(checked.repairs.empty());
  EXPECT_EQ(checked.surface.num_vertices(), 8);
  EXPECT_EQ(checked.surface.num_triangles(), 12);
  EXPECT_DOUBLE_EQ(enclosed_volume(checked.surface), 1.0);
  EXPECT_EQ(checked.surface.material_names, std::vector<std::string>{"material_1"});
}

TEST(TriangleSurface, HoleIsRefusedWithItsEdges)
{
  TriangleSoup soup = cube_soup();
  testing::remove_triangle(soup, 11);
  const std::string message = refusal_of(soup);
  EXPECT_TRUE(has(message, "part.stl: surface is not closed: only one triangle at 3 edges"))
      << message;
  EXPECT_TRUE(has(message, "(0, 0, 1) - (1, 1, 1)") || has(message, "(1, 1, 1) - (0, 0, 1)"))
      << message;
}

TEST(TriangleSurface, EdgeWithThreeTrianglesIsRefusedWithItsPlace)
{
  TriangleSoup soup = cube_soup();
  soup.corner_xyz.insert(soup.corner_xyz.end(), {0, 0, 0, 1, 0, 0, 0.5, -1, -1});
  soup.triangle_solid.push_back(0);
  const std::string message = refusal_of(soup);
  EXPECT_TRUE(has(message, "more than two triangles at 1 edge, first (0, 0, 0) - (1, 0, 0)")
              || has(message, "more than two triangles at 1 edge, first (1, 0, 0) - (0, 0, 0)"))
      << message;
}

TEST(TriangleSurface, CubesThatShareAnEdgeAreRefused)
{
  EXPECT_TRUE(has(refusal_of(joined(cube_soup(), cube_soup({1.0, 1.0, 0.0}))),
                  "more than two triangles at 1 edge"));
}

TEST(TriangleSurface, TurnedTrianglesAreTurnedBackAndCounted)
{
  TriangleSoup soup = sphere_soup(3);
  for (const LocalIndex t : {0, 17, 18, 200}) testing::turn_triangle(soup, t);
  const CheckedSurface checked = check_surface(soup, "sphere");
  EXPECT_EQ(checked.repairs,
            std::vector<std::string>{"4 triangles turned to agree with the neighbours"});
  EXPECT_NEAR(enclosed_volume(checked.surface),
              enclosed_volume(check_surface(sphere_soup(3), "").surface), 1e-12);
}

TEST(TriangleSurface, BodyInsideOutIsTurned)
{
  TriangleSoup soup = cube_soup();
  turn_all(soup);
  const CheckedSurface checked = check_surface(soup, "cube");
  EXPECT_EQ(checked.repairs, std::vector<std::string>{"1 shell of 1 turned: the inside was out"});
  EXPECT_DOUBLE_EQ(enclosed_volume(checked.surface), 1.0);
}

TEST(TriangleSurface, ShellInsideAnotherBoundsACavityWhicheverWayItCame)
{
  const TriangleSoup outer = cube_soup({-1.0, -1.0, -1.0}, 3.0);
  TriangleSoup inner = cube_soup();
  const CheckedSurface turned = check_surface(joined(inner, outer), "cubes");
  EXPECT_EQ(turned.repairs, std::vector<std::string>{"1 shell of 2 turned: the inside was out"});
  EXPECT_DOUBLE_EQ(enclosed_volume(turned.surface), 26.0);

  turn_all(inner);
  const CheckedSurface sound = check_surface(joined(inner, outer), "cubes");
  EXPECT_TRUE(sound.repairs.empty());
  EXPECT_DOUBLE_EQ(enclosed_volume(sound.surface), 26.0);
  EXPECT_EQ(sound.surface.material_names.size(), 1U);
}

TEST(TriangleSurface, BodyInACavityPointsOutwardsAgain)
{
  const TriangleSoup shells = joined(
      joined(cube_soup({-2.0, -2.0, -2.0}, 5.0), cube_soup({-1.0, -1.0, -1.0}, 3.0)), cube_soup());
  EXPECT_DOUBLE_EQ(enclosed_volume(check_surface(shells, "cubes").surface), 125.0 - 27.0 + 1.0);
}

TEST(TriangleSurface, RepeatedAndDegenerateTrianglesAreDroppedAndCounted)
{
  TriangleSoup soup = cube_soup();
  soup = joined(soup, cube_soup());  // all twice
  testing::turn_triangle(soup, 12);
  soup.corner_xyz.insert(soup.corner_xyz.end(), {0, 0, 0, 1, 0, 0, 0, 0, 0});
  soup.triangle_solid.push_back(0);
  const CheckedSurface checked = check_surface(soup, "cube");
  EXPECT_EQ(checked.repairs,
            (std::vector<std::string>{"1 triangle with fewer than three different corners dropped",
                                      "12 repeated triangles dropped"}));
  EXPECT_EQ(checked.surface.num_triangles(), 12);
}

// Halves triangle t by a vertex beside its first edge; a flat triangle closes the gap.
void add_flat_triangle(TriangleSoup& soup, LocalIndex t, double part_of_edge)
{
  const std::span<const double> xyz(soup.corner_xyz);
  const Vec3 a = point_at(xyz, 3 * t);
  const Vec3 b = point_at(xyz, 3 * t + 1);
  const Vec3 c = point_at(xyz, 3 * t + 2);
  const Vec3 m = a + part_of_edge * (b - a) + 1e-8 * (c - a);
  testing::remove_triangle(soup, t);
  for (const auto& triangle : {std::array{a, m, c}, std::array{m, b, c}, std::array{a, b, m}}) {
    for (const Vec3& p : triangle)
      soup.corner_xyz.insert(soup.corner_xyz.end(), p.begin(), p.end());
    soup.triangle_solid.push_back(0);
  }
}

bool has_flat_triangle(const TriangleSurface& surface)
{
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    if (norm(cross(b - a, c - a)) < 1e-5) return true;
  }
  return false;
}

TEST(TriangleSurface, FlatTrianglesAreTakenOut)
{
  for (const double part_of_edge : {0.5, 0.01, 1e-8, 1.0 - 1e-8}) {
    TriangleSoup soup = cube_soup();
    for (int i = 0; i < 12; ++i) add_flat_triangle(soup, 0, part_of_edge);
    const CheckedSurface checked = check_surface(soup, "cube");
    EXPECT_FALSE(has_flat_triangle(checked.surface)) << part_of_edge;
    EXPECT_NEAR(enclosed_volume(checked.surface), 1.0, 1e-6) << part_of_edge;
    ASSERT_EQ(checked.repairs.size(), 1U) << part_of_edge;
    EXPECT_TRUE(has(checked.repairs.front(), "flatter than")) << checked.repairs.front();
  }
}

// Several vertices on one edge, and triangles between them that have no area at all.
TEST(TriangleSurface, TrianglesWithoutAreaInARowAreTakenOut)
{
  TriangleSoup soup = cube_soup();
  add_flat_triangle(soup, 0, 0.5);
  const auto num_flat = soup.num_triangles();
  add_flat_triangle(soup, num_flat - 1, 0.25);
  add_flat_triangle(soup, num_flat + 1, 0.7);
  const CheckedSurface checked = check_surface(soup, "cube");
  EXPECT_FALSE(has_flat_triangle(checked.surface));
  EXPECT_NEAR(enclosed_volume(checked.surface), 1.0, 1e-6);
}

// Bodies and cavities of which nothing is left are named with their places.
TEST(TriangleSurface, BodiesThinnerThanTheToleranceGoAndAreNamed)
{
  const CheckedSurface tiny =
      check_surface(joined(cube_soup(), cube_soup({2.0, 0.0, 0.0}, 1e-7)), "");
  EXPECT_NEAR(enclosed_volume(tiny.surface), 1.0, 1e-12);
  EXPECT_EQ(tiny.surface.num_triangles(), 12);
  ASSERT_EQ(tiny.repairs.size(), 2U);
  EXPECT_TRUE(has(tiny.repairs[0], "1 body or cavity thinner than")) << tiny.repairs[0];
  EXPECT_TRUE(has(tiny.repairs[0], "near (2, ")) << tiny.repairs[0];
  const auto two = joined(cube_soup({0.5, 0.5, 0.5}, 1e-7), cube_soup({0.0, 3.0, 0.0}, 1e-7));
  const CheckedSurface both = check_surface(joined(cube_soup(), two), "");
  ASSERT_EQ(both.repairs.size(), 3U);  // The cavity was turned before.
  EXPECT_TRUE(has(both.repairs[1], "2 bodies or cavities thinner than")) << both.repairs[1];
  const CheckedSurface larger =
      check_surface(joined(cube_soup(), cube_soup({2.0, 0.0, 0.0}, 1e-5)), "");
  EXPECT_TRUE(larger.repairs.empty());
  EXPECT_EQ(larger.surface.num_triangles(), 24);
}

// As single precision leaves what is far from the origin.
TEST(TriangleSurface, ABodyWithoutASizeIsNamed)
{
  TriangleSoup point = cube_soup();
  for (std::size_t i = 0; i < point.corner_xyz.size(); ++i)
    point.corner_xyz[i] = i % 3 == 0 ? 5.0 : 0.0;
  const CheckedSurface checked = check_surface(joined(cube_soup(), point), "");
  ASSERT_EQ(checked.repairs.size(), 2U);
  EXPECT_TRUE(has(checked.repairs[0], "1 body or cavity without a size dropped, near (5, 0, 0)"))
      << checked.repairs[0];
  TriangleSoup stray = cube_soup();  // One triangle without an area bounds nothing.
  stray.corner_xyz.insert(stray.corner_xyz.end(), {5, 0, 0, 5, 0, 0, 6, 0, 0});
  stray.triangle_solid.push_back(0);
  ASSERT_EQ(check_surface(stray, "").repairs.size(), 1U);
}

TEST(TriangleSurface, ATinyTetOnACubeGoes)
{
  TriangleSoup soup = cube_soup();
  add_flat_triangle(soup, 3, 0.5);
  const LocalIndex flat = soup.num_triangles() - 1;
  const std::span<const double> xyz(soup.corner_xyz);
  const std::array<Vec3, 3> p{point_at(xyz, 3 * flat), point_at(xyz, 3 * flat + 1),
                              point_at(xyz, 3 * flat + 2)};
  const Vec3 top = (1.0 / 3.0) * (p[0] + p[1] + p[2]) + Vec3{1e-8, 1e-8, 1e-8};
  testing::remove_triangle(soup, flat);
  for (std::size_t c = 0; c < 3; ++c) {
    for (const Vec3& corner : {p[c], p[(c + 1) % 3], top})
      soup.corner_xyz.insert(soup.corner_xyz.end(), corner.begin(), corner.end());
    soup.triangle_solid.push_back(0);
  }
  const CheckedSurface checked = check_surface(soup, "cube");
  EXPECT_FALSE(has_flat_triangle(checked.surface));
  EXPECT_NEAR(enclosed_volume(checked.surface), 1.0, 1e-6);
}

// A vertex of a triangle on a flat side lies beyond the triangle's edge.
TEST(TriangleSurface, AFoldThatEnclosesNothingIsUnfolded)
{
  TriangleSoup soup = cube_soup();
  const std::span<const double> xyz(soup.corner_xyz);
  const std::array<Vec3, 3> p{point_at(xyz, 0), point_at(xyz, 1), point_at(xyz, 2)};
  std::size_t diagonal = 0;  // Across the side; beyond it lies the side's other triangle.
  while (norm(p[(diagonal + 1) % 3] - p[diagonal]) < 1.1) ++diagonal;
  const Vec3 middle = midpoint(p[diagonal], p[(diagonal + 1) % 3]);
  const Vec3 beyond = middle + 0.2 * (middle - p[(diagonal + 2) % 3]);
  testing::remove_triangle(soup, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    for (const Vec3& corner : {p[c], p[(c + 1) % 3], beyond})
      soup.corner_xyz.insert(soup.corner_xyz.end(), corner.begin(), corner.end());
    soup.triangle_solid.push_back(0);
  }
  const CheckedSurface checked = check_surface(soup, "cube");
  double area = 0.0;
  for (LocalIndex t = 0; t < checked.surface.num_triangles(); ++t) {
    const auto [a, b, c] = checked.surface.corners(t);
    area += 0.5 * norm(cross(b - a, c - a));
  }
  EXPECT_NEAR(area, 6.0, 1e-12);
  EXPECT_NEAR(enclosed_volume(checked.surface), 1.0, 1e-12);
  EXPECT_EQ(checked.repairs.size(), 1U);
}

TEST(TriangleSurface, CornersThatDifferByRoundingAreJoinedAndSaidSo)
{
  TriangleSoup soup = sphere_soup(2);
  for (std::size_t i = 0; i < soup.corner_xyz.size(); i += 7) soup.corner_xyz[i] += 1e-9;
  const CheckedSurface checked = check_surface(soup, "sphere");
  ASSERT_FALSE(checked.repairs.empty());
  EXPECT_TRUE(has(checked.repairs.front(), "vertices of open edges joined"));
  EXPECT_EQ(checked.surface.num_vertices(), 2 + checked.surface.num_triangles() / 2);
}

TEST(TriangleSurface, GapWiderThanTheToleranceStaysAnError)
{
  TriangleSoup soup = cube_soup();
  soup.corner_xyz[0] += 1e-4;
  EXPECT_TRUE(has(refusal_of(soup), "surface is not closed"));
}

TEST(TriangleSurface, OneSidedSurfaceIsRefused)
{
  // The projective plane with six vertices: closed, every edge has two triangles, one-sided.
  constexpr int kTriangles[10][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                                     {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  constexpr double kXyz[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 2, 3}};
  TriangleSoup soup;
  soup.solid_names = {""};
  for (const auto& triangle : kTriangles) {
    for (const int v : triangle) {
      soup.corner_xyz.insert(soup.corner_xyz.end(), kXyz[v], kXyz[v] + 3);
    }
    soup.triangle_solid.push_back(0);
  }
  EXPECT_TRUE(has(refusal_of(soup), "one-sided"));
}

TEST(TriangleSurface, FlatShellIsRefused)
{
  TriangleSoup soup = cube_soup();
  for (std::size_t i = 2; i < soup.corner_xyz.size(); i += 3) soup.corner_xyz[i] *= 1e-14;
  EXPECT_NE(refusal_of(soup), "");
}

TEST(TriangleSurface, SolidsWithABodyEachBecomeMaterialsWithTheirNames)
{
  TriangleSoup both = joined(cube_soup(), cube_soup({2.0, 0.0, 0.0}));
  both.solid_names = {"steel", "copper"};
  const TriangleSurface surface = check_surface(both, "").surface;
  EXPECT_EQ(surface.material_names, (std::vector<std::string>{"steel", "copper"}));
  EXPECT_EQ(surface.triangle_material.front(), 1);
  EXPECT_EQ(surface.triangle_material.back(), 2);
}

TEST(TriangleSurface, SolidsAroundOneBodyAreNoMaterials)
{
  TriangleSoup soup = cube_soup();
  soup.solid_names = {"inlet", "wall"};
  std::fill(soup.triangle_solid.begin() + 2, soup.triangle_solid.end(), 1);
  const TriangleSurface surface = check_surface(soup, "").surface;
  EXPECT_EQ(surface.material_names, std::vector<std::string>{"material_1"});
}

TEST(TriangleSurface, BytesComeBackEqualAndDamagedOnesAreRefused)
{
  const TriangleSurface surface = check_surface(sphere_soup(2), "").surface;
  const Bytes bytes = to_bytes(surface);
  EXPECT_EQ(to_bytes(from_bytes<TriangleSurface>(bytes)), bytes);
  TriangleSurface damaged = surface;
  damaged.triangle_vertices[5] = damaged.num_vertices();
  EXPECT_THROW((void)from_bytes<TriangleSurface>(to_bytes(damaged)), InputError);
}

}  // namespace
}  // namespace tessera::model

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/wrap_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/surface/overlap.hpp"

#include "support/patch_surfaces.hpp"
#include "support/stl_models.hpp"

#include "surface/wrap/lattice.hpp"

namespace tessera::surface {
namespace {

using testing::cube_soup;
using testing::joined;
using testing::sphere_soup;

double volume_of(const model::TriangleSurface& surface)
{
  double volume = 0.0;
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    volume += tet_volume({}, a, b, c);
  }
  return volume;
}

// Closed, a manifold, outwards: nothing had to be changed; and it cuts itself nowhere.
model::TriangleSurface sound(const WrappedSurface& wrap)
{
  const model::CheckedSurface checked = model::check_surface(wrap.soup, "wrap");
  EXPECT_EQ(checked.counted_repairs[Repair::turned_triangles], 0);
  EXPECT_EQ(checked.counted_repairs[Repair::welded_vertices], 0);
  PatchSurface surface;
  testing::add_patch(wrap.soup, 1.0, {}, surface);
  EXPECT_TRUE(find_overlaps(surface).empty());
  return checked.surface;
}

void remove_where(model::TriangleSoup& soup, const auto& is_gone)
{
  for (LocalIndex t = soup.num_triangles(); t-- > 0;) {
    if (is_gone(point_at(std::span(soup.corner_xyz), 3 * t))) testing::remove_triangle(soup, t);
  }
}

TEST(WrapSurface, EdgesAndCornersOfACubeStay)
{
  const WrappedSurface wrap = wrap_surface(cube_soup(), 0.05, "cube");
  EXPECT_NEAR(volume_of(sound(wrap)), 1.0, 1e-9);
  EXPECT_LT(wrap.distance_max, 1e-9);
  EXPECT_LT(wrap.file_distance_max, 1e-9);
}

TEST(WrapSurface, HoleIsClosedAndItsDistanceSaid)
{
  model::TriangleSoup soup = sphere_soup(4);
  const double whole = volume_of(model::check_surface(soup, "ball").surface);
  remove_where(soup, [](const Vec3& p) { return p[2] > 0.9; });
  ASSERT_THROW((void)model::check_surface(soup, "ball"), GeometryError);
  const WrappedSurface wrap = wrap_surface(soup, 0.05, "ball");
  const double volume = volume_of(sound(wrap));
  EXPECT_LT(volume, whole);
  EXPECT_GT(volume, 0.97 * whole);
  EXPECT_GT(wrap.distance_max, 0.2) << "the middle of the hole is 0.44 off its rim";
  EXPECT_LT(wrap.distance_max, 0.5);
  EXPECT_LT(wrap.file_distance_max, 0.05);
}

TEST(WrapSurface, TurnedTrianglesAndTurnedSheetsChangeNothing)
{
  model::TriangleSoup soup = sphere_soup(4);
  remove_where(soup, [](const Vec3& p) { return std::abs(p[2]) < 0.1; });  // Two sheets are left.
  const WrappedSurface as_given = wrap_surface(soup, 0.06, "ball");
  for (LocalIndex t = 0; t < soup.num_triangles(); ++t) {
    if (point_at(std::span(soup.corner_xyz), 3 * t)[2] > 0.0 || t % 5 == 0)
      testing::turn_triangle(soup, t);
  }
  const WrappedSurface turned = wrap_surface(soup, 0.06, "ball");
  EXPECT_NEAR(volume_of(sound(turned)), volume_of(sound(as_given)), 1e-6);
  EXPECT_GT(volume_of(sound(turned)), 3.5);
}

TEST(WrapSurface, BodiesThatCrossBecomeOne)
{
  const WrappedSurface wrap =
      wrap_surface(joined(cube_soup(), cube_soup({0.5, 0.4, 0.3})), 0.05, "cubes");
  EXPECT_NEAR(volume_of(sound(wrap)), 2.0 - 0.5 * 0.6 * 0.7, 2e-3);
  EXPECT_LT(wrap.distance_max, 0.05);
  EXPECT_GT(wrap.file_distance_max, 0.2) << "parts of the file lie inside";
}

// Of triangles that share vertices.
int num_shells(const model::TriangleSurface& surface)
{
  std::vector<LocalIndex> lowest(at(surface.num_vertices()));
  std::iota(lowest.begin(), lowest.end(), 0);
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t t = 0; t < at(surface.num_triangles()); ++t) {
      const std::span v = std::span(surface.triangle_vertices).subspan(3 * t, 3);
      const LocalIndex least = std::min({lowest[at(v[0])], lowest[at(v[1])], lowest[at(v[2])]});
      for (const LocalIndex vertex : v) {
        has_changed = has_changed || lowest[at(vertex)] != least;
        lowest[at(vertex)] = least;
      }
    }
  }
  sort_unique(lowest);
  return static_cast<int>(lowest.size());
}

TEST(WrapSurface, BodiesThatMeetAtAnEdgeOrACornerAreTakenApart)
{
  for (const Vec3& low : {Vec3{1.0, 1.0, 0.0}, Vec3{1.0, 1.0, 1.0}}) {
    const model::TriangleSurface surface =
        sound(wrap_surface(joined(cube_soup(), cube_soup(low)), 0.06, "cubes"));
    EXPECT_EQ(num_shells(surface), 2) << low[2];
    EXPECT_NEAR(volume_of(surface), 2.0, 1e-2) << low[2];
  }
}

TEST(WrapSurface, FlatHolesAreClosedFlat)
{
  model::TriangleSoup soup = cube_soup();
  testing::remove_triangle(soup, 0);
  EXPECT_NEAR(volume_of(sound(wrap_surface(soup, 0.05, "cube"))), 1.0, 1e-9);
}

TEST(WrapSurface, CavityStays)
{
  model::TriangleSoup cavity = cube_soup({0.3, 0.3, 0.3}, 0.4);
  for (LocalIndex t = 0; t < cavity.num_triangles(); ++t) testing::turn_triangle(cavity, t);
  model::TriangleSoup soup = joined(cube_soup(), cavity);
  testing::remove_triangle(soup, 0);
  const WrappedSurface wrap = wrap_surface(soup, 0.05, "cubes");
  EXPECT_NEAR(volume_of(sound(wrap)), 1.0 - 0.4 * 0.4 * 0.4, 0.06);
}

TEST(WrapSurface, AnySoupGivesASoundSurface)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-0.5, 1.5);
  for (int trial = 0; trial < 10; ++trial) {
    model::TriangleSoup soup = cube_soup();
    for (int i = 0; i < 40; ++i) {
      for (int k = 0; k < 9; ++k) soup.corner_xyz.push_back(anywhere(random));
      soup.triangle_solid.push_back(0);
    }
    EXPECT_GT(volume_of(sound(wrap_surface(soup, 0.08, "soup"))), 0.5) << trial;
  }
}

TEST(WrapSurface, SheetsBehindEachOtherEncloseWhatIsBeyondTheirBox)
{
  model::TriangleSoup soup;
  for (const double z : {0.0, 0.1, 0.2, 0.3}) {
    for (const auto& [a, b, c] :
         {std::array<Vec3, 3>{Vec3{0, 0, z}, Vec3{1, 0, z}, Vec3{1, 1, z}},
          std::array<Vec3, 3>{Vec3{0, 0, z}, Vec3{1, 1, z}, Vec3{0, 1, z}}}) {
      for (const Vec3& p : {a, b, c})
        soup.corner_xyz.insert(soup.corner_xyz.end(), p.begin(), p.end());
      soup.triangle_solid.push_back(0);
    }
  }
  soup.solid_names.emplace_back();
  const model::TriangleSurface surface = sound(wrap_surface(soup, 0.03, "sheets"));
  double lowest = 0.0;
  for (LocalIndex v = 0; v < surface.num_vertices(); ++v)
    lowest = std::min(lowest, surface.position(v)[2]);
  EXPECT_LT(lowest, -0.1);
}

std::string refusal_of(const model::TriangleSoup& soup, double tolerance)
{
  try {
    (void)wrap_surface(soup, tolerance, "part.stl");
  } catch (const GeometryError& error) {
    return error.what();
  }
  return {};
}

TEST(WrapSurface, SheetThatBoundsNothingIsRefused)
{
  model::TriangleSoup soup = cube_soup();
  while (soup.num_triangles() > 2) testing::remove_triangle(soup, soup.num_triangles() - 1);
  EXPECT_NE(refusal_of(soup, 0.05).find("part.stl: the triangles enclose nothing"),
            std::string::npos);
}

TEST(WrapSurface, ToleranceThatTakesTooMuchMemoryIsRefusedWithTheLeast)
{
  const std::string message = refusal_of(cube_soup(), 1e-4);
  EXPECT_NE(message.find("geometry.wrap_tolerance of 0.0001"), std::string::npos) << message;
  EXPECT_NE(message.find("give at least 0.00"), std::string::npos) << message;
}

// How many squares each edge of a boundary has.
std::map<std::pair<LocalIndex, LocalIndex>, int> squares_of_edges(const LatticeBoundary& boundary)
{
  std::map<std::pair<LocalIndex, LocalIndex>, int> counts;
  for (const auto& square : boundary.squares) {
    for (std::size_t i = 0; i < 4; ++i) {
      const LocalIndex a = square.cells[i];
      const LocalIndex b = square.cells[(i + 1) % 4];
      ++counts[std::minmax(a, b)];
    }
  }
  return counts;
}

TEST(WrapLattice, BoundaryOfNoiseIsAManifold)
{
  std::mt19937 random(3);
  std::map<Vec3, double> noise;  // In a block; outside of it there is nothing.
  const auto winding = [&](const Vec3& p) {
    for (const double x : p) {
      if (x < 1.0 || x > 9.0) return 0.0;
    }
    const auto [place, is_new] = noise.emplace(p, 0.0);
    if (is_new) place->second = static_cast<double>(random() % 1000) / 1000.0;
    return place->second;
  };
  std::vector<std::array<Vec3, 3>> everywhere;
  for (double x = 0.5; x < 10.0; x += 1.0) {
    for (double y = 0.5; y < 10.0; y += 1.0) {
      for (double z = 0.5; z < 10.0; z += 1.0)
        everywhere.push_back({Vec3{x, y, z}, Vec3{x, y, z}, Vec3{x, y, z}});
    }
  }
  const auto boundary = WrapLattice({}, 1.0, winding, 100'000).boundary(everywhere);
  ASSERT_TRUE(boundary.has_value());
  ASSERT_GT(boundary->squares.size(), 100U);
  for (const auto& [edge, count] : squares_of_edges(*boundary)) EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace tessera::surface

// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/domains/lattice_fill.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/threads.hpp"
#include "tessera/base/vec3.hpp"

#include "support/surfaces.hpp"

#include "coarse/domains/kept_tets.hpp"
#include "coarse/domains/lattice_points.hpp"
#include "coarse/domains/skin_distance.hpp"
#include "voxel_skin.hpp"

namespace tessera::coarse {
namespace {

using Triangle = std::array<LocalIndex, 3>;

Vec3 place(const std::vector<double>& xyz, LocalIndex v) { return point_at(std::span(xyz), v); }

double volume_of(const std::vector<double>& xyz, std::span<const LocalIndex> v)
{
  return tet_volume(place(xyz, v[0]), place(xyz, v[1]), place(xyz, v[2]), place(xyz, v[3]));
}

surface::DomainTets no_filler(const surface::DomainSkin& /*hole*/)
{
  throw NetgenError("nothing is filled");
}

// A tet from a new vertex in the middle to each triangle: right if the hole is seen from there.
surface::DomainTets fan(const surface::DomainSkin& hole)
{
  const auto middle = static_cast<LocalIndex>(hole.vertex.size());
  Vec3 sum{};
  for (LocalIndex v = 0; v < middle; ++v) sum = sum + place(hole.vertex_xyz, v);
  sum = (1.0 / middle) * sum;
  surface::DomainTets tets{hole.vertex_xyz, {}};
  tets.vertex_xyz.insert(tets.vertex_xyz.end(), sum.begin(), sum.end());
  for (std::size_t i = 0; i < hole.triangle_vertices.size(); i += 3) {
    const LocalIndex* v = &hole.triangle_vertices[i];
    const std::array<LocalIndex, 4> tet{v[0], v[2], v[1], middle};
    if (volume_of(tets.vertex_xyz, tet) <= 0.0) throw NetgenError("not seen from the middle");
    tets.tet_vertices.insert(tets.tet_vertices.end(), tet.begin(), tet.end());
  }
  return tets;
}

surface::CoarseOptions options_of(const surface::DomainSkin& skin)
{
  surface::CoarseOptions options;
  options.max_size = skin.max_size;
  return options;
}

// Triangles by their sorted vertices: how many tets have one.
std::map<Triangle, int> faces_of(const surface::DomainTets& tets)
{
  std::map<Triangle, int> faces;
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    Triangle face{};
    std::size_t n = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      if (c != i % 4) face[n++] = tets.tet_vertices[i / 4 * 4 + c];
    }
    std::ranges::sort(face);
    ++faces[face];
  }
  return faces;
}

void expect_boundary_is_skin(const surface::DomainSkin& skin, const surface::DomainTets& tets)
{
  const std::map<Triangle, int> faces = faces_of(tets);
  for (std::size_t i = 0; i < skin.triangle_vertices.size(); i += 3) {
    Triangle triangle{};
    std::copy_n(&skin.triangle_vertices[i], 3, triangle.begin());
    std::ranges::sort(triangle);
    const auto found = faces.find(triangle);
    ASSERT_NE(found, faces.end());
    EXPECT_EQ(found->second, 1);
  }
  const auto is_single = [](const auto& face) { return face.second == 1; };
  EXPECT_EQ(3 * std::ranges::count_if(faces, is_single), std::ssize(skin.triangle_vertices));
}

void expect_fills(const surface::DomainSkin& skin, const surface::DomainTets& tets)
{
  double volume = 0.0;
  std::vector<char> is_used(tets.vertex_xyz.size() / 3, 0);
  for (std::size_t i = 0; i < tets.tet_vertices.size(); i += 4) {
    const auto tet = std::span(tets.tet_vertices).subspan(i, 4);
    const double one = volume_of(tets.vertex_xyz, tet);
    EXPECT_GT(one, 0.0);
    volume += one;
    for (const LocalIndex v : tet) is_used[at(v)] = 1;
  }
  const double whole = testing::volume_inside(skin.vertex_xyz, skin.triangle_vertices);
  EXPECT_NEAR(volume, whole, 1e-9 * whole);
  EXPECT_EQ(std::ranges::count(is_used, 0), 0);
  ASSERT_GE(tets.vertex_xyz.size(), skin.vertex_xyz.size());
  EXPECT_TRUE(std::ranges::equal(std::span(tets.vertex_xyz).first(skin.vertex_xyz.size()),
                                 skin.vertex_xyz));
  expect_boundary_is_skin(skin, tets);
}

// One tet: all of its triangles are faces of the Delaunay tets.
surface::DomainSkin one_tet()
{
  surface::DomainSkin skin;
  skin.vertex = {0, 1, 2, 3};
  skin.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  skin.triangle_vertices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  skin.triangle_patch = {0, 1, 2, 3};
  skin.max_size = 1.5;
  skin.model_box = {Vec3{0, 0, 0}, Vec3{1, 1, 1}};
  return skin;
}

TEST(LatticePoints, LieInsideAndNotNearTheSkin)
{
  const surface::DomainSkin skin = testing::l_shape_skin(8, 0.25);
  const std::vector<double> xyz = lattice_points(skin, options_of(skin)).xyz;
  ASSERT_GT(xyz.size(), 3 * 50U);
  const SkinDistance distance(skin);
  for (LocalIndex v = 0; v < static_cast<LocalIndex>(xyz.size() / 3); ++v) {
    EXPECT_TRUE(distance.is_inside(place(xyz, v), 0.05));
  }
  EXPECT_EQ(xyz, lattice_points(skin, options_of(skin)).xyz);
}

TEST(LatticePoints, AreTheSameForAnyNumberOfThreads)
{
  const surface::DomainSkin skin = testing::ball_skin(12);
  surface::CoarseOptions options;
  options.max_size = 0.05;
  const std::vector<double> alone = lattice_points(skin, options).xyz;
  EXPECT_GT(alone.size(), 3U * 2 * 4096) << "some chunks";
  set_num_threads(3);
  const std::vector<double> side_by_side = lattice_points(skin, options).xyz;
  set_num_threads(1);
  EXPECT_EQ(alone, side_by_side);
}

// A larger edge gives fewer points: spacing grows away from the skin.
TEST(LatticePoints, GrowUpToTheLargestEdge)
{
  surface::DomainSkin skin = testing::cube_skin(16, 0.25);
  const auto num_fine = lattice_points(skin, options_of(skin)).side.size();
  skin.max_size = 2.0;
  const auto num_coarse = lattice_points(skin, options_of(skin)).side.size();
  EXPECT_LT(2 * num_coarse, num_fine);
  EXPECT_GT(num_coarse, 0U);
}

std::vector<double> all_points(const surface::DomainSkin& skin)
{
  std::vector<double> xyz = skin.vertex_xyz;
  const std::vector<double> inside = lattice_points(skin, options_of(skin)).xyz;
  xyz.insert(xyz.end(), inside.begin(), inside.end());
  return xyz;
}

// What the tets that are kept leave of a volume, the holes have.
void expect_holes_have_the_rest(const surface::DomainSkin& skin, const std::vector<double>& xyz,
                                KeptTets& kept)
{
  const std::vector<surface::DomainSkin> holes = kept.holes();
  double volume = 0.0;
  std::vector<LocalIndex> vertices;
  for (const surface::DomainSkin& hole : holes) {
    const testing::SurfaceTopology topology = testing::topology_of(hole.triangle_vertices);
    EXPECT_EQ(topology.num_unmatched_edges, 0);
    EXPECT_TRUE(hole.is_hole);
    volume += testing::volume_inside(hole.vertex_xyz, hole.triangle_vertices);
    vertices.insert(vertices.end(), hole.vertex.begin(), hole.vertex.end());
    for (std::size_t i = 0; i < hole.vertex.size(); ++i) {
      EXPECT_EQ(place(hole.vertex_xyz, static_cast<LocalIndex>(i)), place(xyz, hole.vertex[i]));
    }
  }
  const std::vector<LocalIndex> tets = kept.tet_vertices();
  for (std::size_t i = 0; i < tets.size(); i += 4) {
    volume += volume_of(xyz, std::span(tets).subspan(i, 4));
  }
  const double whole = testing::volume_inside(skin.vertex_xyz, skin.triangle_vertices);
  EXPECT_NEAR(volume, whole, 1e-9 * whole);
  std::ranges::sort(vertices);
  EXPECT_EQ(std::ranges::adjacent_find(vertices), vertices.end());  // No two holes share one.
}

TEST(KeptTets, HolesHaveWhatTheyLeave)
{
  for (const surface::DomainSkin& skin :
       {testing::cube_skin(4, 0.5), testing::l_shape_skin(6, 1.0 / 3.0), testing::ball_skin(6)}) {
    const std::vector<double> xyz = all_points(skin);
    KeptTets kept(skin, xyz, {});
    expect_holes_have_the_rest(skin, xyz, kept);
    kept.take_out_flat();
    expect_holes_have_the_rest(skin, xyz, kept);
    const std::size_t num_before = kept.tet_vertices().size();
    kept.take_out_around(std::array<LocalIndex, 2>{0, 9});
    expect_holes_have_the_rest(skin, xyz, kept);
    EXPECT_LT(kept.tet_vertices().size(), num_before);
    const std::vector<LocalIndex> tets = kept.tet_vertices();
    EXPECT_EQ(std::ranges::count(tets, 0), 0);
    EXPECT_EQ(std::ranges::count(tets, 9), 0);
  }
}

// Flips all squares of a cube_skin(): none of its triangles is a face of a Delaunay tet then.
surface::DomainSkin with_other_diagonals(surface::DomainSkin skin)
{
  for (std::size_t i = 0; i < skin.triangle_vertices.size(); i += 6) {
    LocalIndex* const v = &skin.triangle_vertices[i];  // a b d, b c d
    const std::array<LocalIndex, 6> flipped{v[0], v[1], v[4], v[0], v[4], v[2]};
    std::ranges::copy(flipped, v);
  }
  return skin;
}

TEST(KeptTets, PointsInsideTellTheSideWhereNoTriangleDoes)
{
  surface::DomainSkin skin = with_other_diagonals(testing::cube_skin(6, 1.0));
  skin.max_size = 0.7;  // Most tets lie deeper than the skin's.
  const std::vector<double> xyz = all_points(skin);
  KeptTets kept(skin, xyz, {});
  expect_holes_have_the_rest(skin, xyz, kept);
  double volume = 0.0;
  const std::vector<LocalIndex> tets = kept.tet_vertices();
  for (std::size_t i = 0; i < tets.size(); i += 4) {
    volume += volume_of(xyz, std::span(tets).subspan(i, 4));
  }
  EXPECT_GT(volume, 0.25 * 6.0 * 6.0 * 6.0);
}

TEST(KeptTets, TrianglesInsideHaveAPatchOfTheirOwn)
{
  const surface::DomainSkin skin = testing::cube_skin(4, 0.5);  // Patches 0 to 5.
  const std::vector<double> xyz = all_points(skin);
  KeptTets kept(skin, xyz, {});
  kept.take_out_around(std::array<LocalIndex, 1>{0});
  const std::vector<surface::DomainSkin> holes = kept.holes();
  ASSERT_FALSE(holes.empty());
  const auto num_of_skin = static_cast<LocalIndex>(skin.vertex.size());
  for (const surface::DomainSkin& hole : holes) {
    for (std::size_t i = 0; i < hole.triangle_patch.size(); ++i) {
      EXPECT_LE(hole.triangle_patch[i], 6);
      const LocalIndex* v = &hole.triangle_vertices[3 * i];
      const bool has_inner =
          std::any_of(v, v + 3, [&](LocalIndex u) { return hole.vertex[at(u)] >= num_of_skin; });
      if (has_inner) {
        EXPECT_EQ(hole.triangle_patch[i], 6);
      }
    }
  }
}

TEST(FillWithLattice, OneTetNeedsNoFiller)
{
  const surface::DomainSkin skin = one_tet();
  const auto tets = fill_with_lattice(skin, options_of(skin), no_filler);
  ASSERT_TRUE(tets.has_value());
  expect_fills(skin, *tets);
}

TEST(FillWithLattice, NoTriangleMissingNeedsNoFiller)
{
  static_cast<void>(take_noted_repairs());
  for (const surface::DomainSkin& skin :
       {testing::cube_skin(6, 1.0), testing::l_shape_skin(8, 0.25)}) {
    const auto tets = fill_with_lattice(skin, options_of(skin), no_filler);
    ASSERT_TRUE(tets.has_value());
    EXPECT_GT(tets->vertex_xyz.size(), skin.vertex_xyz.size());
    expect_fills(skin, *tets);
  }
  EXPECT_EQ(take_noted_repairs(), RepairCounts());
}

TEST(FillWithLattice, AFillerFillsTheHolesOfABall)
{
  static_cast<void>(take_noted_repairs());
  const surface::DomainSkin skin = testing::ball_skin(8);
  const auto tets = fill_with_lattice(skin, options_of(skin), fan);
  ASSERT_TRUE(tets.has_value());
  expect_fills(skin, *tets);
  EXPECT_GT(take_noted_repairs()[Repair::lattice_holes], 0);
  const auto again = fill_with_lattice(skin, options_of(skin), fan);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->vertex_xyz, tets->vertex_xyz);
  EXPECT_EQ(again->tet_vertices, tets->tet_vertices);
}

TEST(FillWithLattice, AFillerThatGivesUpIsAskedAboutLargerHoles)
{
  static_cast<void>(take_noted_repairs());
  const surface::DomainSkin skin = testing::ball_skin(8);
  std::vector<double> volumes;
  const HoleFiller filler = [&](const surface::DomainSkin& hole) -> surface::DomainTets {
    volumes.push_back(testing::volume_inside(hole.vertex_xyz, hole.triangle_vertices));
    throw NetgenError("nothing is filled");
  };
  const auto tets = fill_with_lattice(skin, options_of(skin), filler);
  EXPECT_FALSE(tets.has_value());
  EXPECT_GT(volumes.size(), 1U);
  EXPECT_GT(volumes.back(), volumes.front());
  EXPECT_EQ(take_noted_repairs(), RepairCounts());  // What is dropped is not noted.
}

TEST(FillWithLattice, TooLittleIsNoFill)
{
  const surface::DomainSkin skin = testing::ball_skin(8);
  const HoleFiller nothing = [](const surface::DomainSkin& hole) {
    return surface::DomainTets{hole.vertex_xyz, {}};
  };
  EXPECT_FALSE(fill_with_lattice(skin, options_of(skin), nothing).has_value());
}

TEST(FillWithLattice, ASkinThatLooksInwardsIsRefused)
{
  surface::DomainSkin skin = one_tet();
  for (std::size_t i = 0; i < skin.triangle_vertices.size(); i += 3) {
    std::swap(skin.triangle_vertices[i], skin.triangle_vertices[i + 1]);
  }
  std::swap(skin.triangle_vertices[0], skin.triangle_vertices[1]);  // But one.
  EXPECT_FALSE(fill_with_lattice(skin, options_of(skin), fan).has_value());
}

}  // namespace
}  // namespace tessera::coarse

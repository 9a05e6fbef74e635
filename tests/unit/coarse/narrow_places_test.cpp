// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/narrow_places.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/coarse/sharp_tets.hpp"

#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

constexpr double kSmall_deg = 5.0;
constexpr double kWallSize = 0.1;  // The least size in walls for a largest one of 1.

// A plate of one layer of tets, every side a patch.
mesh::CoarseMesh plate(double thickness)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(1);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) mesh.vertex_xyz[3 * at(v) + 2] *= thickness;
  return mesh;
}

TEST(NarrowPlaces, AreNoneInACube)
{
  EXPECT_TRUE(sizes_of_narrow_places(testing::kuhn_cube(3), kSmall_deg, 0.5).size.empty());
}

TEST(NarrowPlaces, AskForEdgesOfSomeTimesTheThicknessOfAWall)
{
  constexpr double kThickness = 0.03;
  const mesh::SizePoints sizes = sizes_of_narrow_places(plate(kThickness), kSmall_deg, 1.0);
  ASSERT_FALSE(sizes.size.empty());
  ASSERT_EQ(sizes.xyz.size(), 3 * sizes.size.size());
  for (const double size : sizes.size) {
    EXPECT_GE(size, 4.0 * kThickness);
    EXPECT_LE(size, 8.0 * kThickness * (1.0 + 1e-12));
  }
  for (std::size_t i = 0; i < sizes.size.size(); ++i) {
    EXPECT_LE(sizes.xyz[3 * i + 2], kThickness);
  }
}

TEST(NarrowPlaces, AskForNoLessThanATenthOfTheLargestSizeInAWall)
{
  const mesh::SizePoints sizes = sizes_of_narrow_places(plate(1e-6), kSmall_deg, 1.0);
  ASSERT_FALSE(sizes.size.empty());
  EXPECT_EQ(std::ranges::min(sizes.size), 0.1);
}

TEST(NarrowPlaces, AreLeftWhereTheMeshWouldBeOutOfProportion)
{
  EXPECT_TRUE(sizes_of_narrow_places(plate(1e-3), kSmall_deg, 0.05).size.empty());
}

TEST(NarrowPlaces, AskForHalfOfItInAWallThatIsStillTooThin)
{
  const mesh::CoarseMesh mesh = plate(1e-6);
  const FinerBefore once{.num_meshes = 1, .num_first_tets = mesh.num_tets()};
  const mesh::SizePoints sizes = sizes_of_narrow_places(mesh, kSmall_deg, 1.0, once);
  ASSERT_FALSE(sizes.size.empty());
  EXPECT_EQ(std::ranges::min(sizes.size), 0.05);
}

// The bound goes by the first mesh, or each mesh could have four times the tets of the last.
TEST(NarrowPlaces, AreLeftWhereTheMeshHasGrownAlready)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(18);  // 34,992 tets.
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) mesh.vertex_xyz[3 * at(v) + 2] *= 0.02;
  const FinerBefore few{.num_meshes = 1, .num_first_tets = 6};
  const FinerBefore many{.num_meshes = 1, .num_first_tets = mesh.num_tets()};
  ASSERT_GT(find_sharp_tets(mesh, kSmall_deg).num_others, 0);
  EXPECT_TRUE(sizes_of_narrow_places(mesh, kSmall_deg, 0.05, few).size.empty());
  EXPECT_FALSE(sizes_of_narrow_places(mesh, kSmall_deg, 0.05, many).size.empty());
}

// A flat tet with a corner inside is none between two sheets.
TEST(NarrowPlaces, AreNoFlatTetsInside)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(2);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.position(v) == Vec3{0.5, 0.5, 0.5}) mesh.vertex_xyz[3 * at(v) + 2] = 0.02;
  }
  ASSERT_GT(find_sharp_tets(mesh, kSmall_deg).num_others, 0);
  EXPECT_TRUE(sizes_of_narrow_places(mesh, kSmall_deg, 1.0).size.empty());
}

// The rows of a cube's top next to one of its edges, made narrow; a patch of their own or not.
mesh::CoarseMesh cube_with_strip(double width, bool is_patch)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(3);
  constexpr double kRow = 0.4;  // The first row ends before it, the second after it.
  std::vector<char> is_in_row(at(mesh.num_vertices()));
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const Vec3 p = mesh.position(v);
    is_in_row[at(v)] = p[1] < kRow && p[2] == 1.0 ? 1 : 0;
    if (p[1] > 0.0 && p[1] < kRow) mesh.vertex_xyz[3 * at(v) + 1] = width;
  }
  if (!is_patch) return mesh;
  const auto strip = static_cast<LocalIndex>(mesh.patch_names.size());
  mesh.patch_names.emplace_back("strip");
  mesh.patch_surface.push_back(strip);
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    if (std::all_of(v, v + 3, [&](LocalIndex i) { return is_in_row[at(i)] != 0; })) {
      mesh.face_patch[at(f)] = strip;
    }
  }
  return mesh;
}

// The smallest size in the middle of the strip, or that of the walls beside it.
double size_in_strip(const mesh::SizePoints& sizes)
{
  double least = kWallSize;
  for (std::size_t i = 0; i < sizes.size.size(); ++i) {
    const bool is_there = std::abs(sizes.xyz[3 * i] - 0.5) < 0.16 && sizes.xyz[3 * i + 2] == 1.0;
    if (is_there) least = std::min(least, sizes.size[i]);
  }
  return least;
}

TEST(NarrowPlaces, AskForEdgesOfSomeTimesTheWidthOfAStrip)
{
  constexpr double kWidth = 0.01;
  const auto sizes = [&](bool is_patch) {
    return sizes_of_narrow_places(cube_with_strip(kWidth, is_patch), kSmall_deg, 1.0);
  };
  EXPECT_NEAR(size_in_strip(sizes(true)), 8.0 * kWidth, 0.1 * kWidth);
  EXPECT_EQ(size_in_strip(sizes(false)), kWallSize);
}

TEST(NarrowPlaces, AskForAPartOfTheLargestSizeInAStripOfHardlyAnyWidth)
{
  const auto sizes = sizes_of_narrow_places(cube_with_strip(1e-6, true), kSmall_deg, 20.0);
  EXPECT_EQ(size_in_strip(sizes), 0.002 * 20.0);
}

TEST(NarrowPlaces, AskForAQuarterOfItInAStripThatIsStillTooNarrow)
{
  const mesh::CoarseMesh mesh = cube_with_strip(1e-6, true);
  const FinerBefore once{.num_meshes = 1, .num_first_tets = mesh.num_tets()};
  const auto sizes = sizes_of_narrow_places(mesh, kSmall_deg, 20.0, once);
  EXPECT_EQ(size_in_strip(sizes), 0.0005 * 20.0);
}

TEST(NarrowPlaces, LeaveStripsWhereTheMeshWouldBeOutOfProportion)
{
  const auto sizes = sizes_of_narrow_places(cube_with_strip(1e-6, true), kSmall_deg, 1.0);
  EXPECT_EQ(size_in_strip(sizes), kWallSize);
}

}  // namespace
}  // namespace tessera::coarse

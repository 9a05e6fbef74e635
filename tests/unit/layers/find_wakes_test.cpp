// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/layers/find_wakes.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tessera/layers/grow_layers.hpp"
#include "tessera/topology/split_patches.hpp"

#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/wedge_cube.hpp"

namespace tessera::layers {
namespace {

constexpr double kSharp = 0.1;  // 11 degrees.

// Layers on both sides of the wedge, 0.05 thick; on `more` as well.
std::vector<LayerOptions> on_wedge(const std::string& more = "")
{
  std::vector<LayerOptions> options;
  for (const char* patch : {"upper", "lower"}) {
    options.push_back({.patch = patch, .first = 0.02, .growth = 1.5, .count = 2});
  }
  if (!more.empty()) options.push_back({.patch = more, .first = 0.02, .growth = 1.5, .count = 2});
  return options;
}

// A strip of two triangles a cell.
TEST(FindWakes, GoOnFromASharpEdgeUpToPatchesWithoutLayers)
{
  mesh::CoarseMesh cube = testing::wedge_cube(kSharp);
  const auto wakes = find_wakes(cube, on_wedge(), false);
  EXPECT_EQ(wakes.size(), 8U);
  for (const mesh::WakeTriangle& triangle : wakes) {
    EXPECT_EQ(triangle.wall, 6);
    double least_x = 1.0;
    for (const LocalIndex v : triangle.vertices) {
      EXPECT_NEAR(cube.position(v)[2], 0.5, 1e-12);
      EXPECT_GE(cube.position(v)[0], 0.5);
      least_x = std::min(least_x, cube.position(v)[0]);
    }
    EXPECT_EQ(least_x, 0.5);
  }
}

// Each triangle has a vertex of the edge that is on no other wall: only these are opened.
TEST(FindWakes, EndBesideOtherWalls)
{
  mesh::CoarseMesh cube = testing::wedge_cube(kSharp);
  const auto wakes = find_wakes(cube, on_wedge("y0"), false);
  EXPECT_FALSE(wakes.empty());
  for (const mesh::WakeTriangle& triangle : wakes) {
    const auto opened = std::ranges::count_if(triangle.vertices, [&](LocalIndex v) {
      return cube.position(v)[0] == 0.5 && cube.position(v)[1] > 0.0;
    });
    EXPECT_GE(opened, 1);
  }
}

TEST(FindWakes, AreNoneWhereOneColumnWillDo)
{
  mesh::CoarseMesh blunt = testing::wedge_cube(0.27);  // 30 degrees.
  EXPECT_TRUE(find_wakes(blunt, on_wedge(), false).empty());
  mesh::CoarseMesh cube = testing::kuhn_cube(3);
  EXPECT_TRUE(
      find_wakes(cube, std::vector{LayerOptions{.patch = "*", .first = 0.01, .count = 1}}, false)
          .empty());
  EXPECT_EQ(cube.vertex_xyz, testing::kuhn_cube(3).vertex_xyz);
}

// The vertices in front of the edge are moved out of the middle first.
TEST(FindWakes, AreFlatUnlessTetsAreKept)
{
  for (const bool keep_tets : {false, true}) {
    mesh::CoarseMesh cube = testing::wedge_cube(kSharp);
    for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
      const Vec3 place = cube.position(v);
      const bool is_inside = place[0] == 0.75 && place[1] > 0.0 && place[1] < 1.0;
      if (is_inside && place[2] == 0.5) cube.vertex_xyz[3 * at(v) + 2] += 0.05;
    }
    const FlatArray<double> before = cube.vertex_xyz;
    const auto wakes = find_wakes(cube, on_wedge(), keep_tets);
    EXPECT_FALSE(wakes.empty());
    EXPECT_EQ(cube.vertex_xyz == before, keep_tets);
    double most = 0.0;
    for (const mesh::WakeTriangle& triangle : wakes) {
      for (const LocalIndex v : triangle.vertices) {
        most = std::max(most, std::abs(cube.position(v)[2] - 0.5));
      }
    }
    EXPECT_NEAR(most, keep_tets ? 0.05 : 0.0, 1e-3);
  }
}

// With a wake all of the wedge has layers of full height; without, none at its edge.
TEST(FindWakes, LetLayersGoAroundASharpEdge)
{
  for (const bool with_wakes : {false, true}) {
    mesh::CoarseMesh cube = testing::wedge_cube(kSharp);
    if (with_wakes) topology::open_wakes(cube, find_wakes(cube, on_wedge(), false));
    const LayerCover cover = grow_layers(cube, on_wedge(), testing::FlatModel(), false);
    topology::close_joints(cube);
    EXPECT_EQ(cover.patches.size(), 2U);
    const PatchCover sum = cover.sum();
    EXPECT_NEAR(sum.area, 2.0 * 0.5 * std::hypot(1.0, kSharp), 1e-9);
    EXPECT_NEAR(sum.full / sum.area, with_wakes ? 1.0 : 0.5, 1e-6);
  }
}

}  // namespace
}  // namespace tessera::layers

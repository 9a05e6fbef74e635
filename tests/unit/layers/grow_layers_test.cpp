// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/layers/grow_layers.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/topology/split_patches.hpp"

#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::layers {
namespace {

const testing::FlatModel kModel;

// Of thickness 0.05 + 0.1.
LayerOptions two_layers(const std::string& patch)
{
  return {.patch = patch, .first = 0.05, .growth = 2.0, .count = 2};
}

std::string error_of(const std::vector<LayerOptions>& options)
{
  mesh::CoarseMesh cube = testing::two_material_cube(2);
  return testing::message_of<ConfigError>([&] { (void)grow_layers(cube, options, kModel, false); });
}

// At the rim columns stay on the other sides of the cube, at its corners on its edges.
TEST(GrowLayers, OnOneSideOfACubeMakesItShorter)
{
  for (const bool keep_tets : {false, true}) {
    mesh::CoarseMesh cube = testing::kuhn_cube(3);
    const LayerCover cover =
        grow_layers(cube, std::vector{two_layers(cube.patch_names[0])}, kModel, keep_tets);
    EXPECT_NEAR(testing::volume_of(cube), 0.85, 1e-9);
    ASSERT_EQ(cover.patches.size(), 1U);
    EXPECT_NEAR(cover.patches[0].area, 1.0, 1e-12);
    EXPECT_NEAR(cover.patches[0].full, 1.0, 1e-12);
    EXPECT_EQ(cube.layers.most_layers, 2);
    for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
      if (cube.layers.wall(v) == cube.position(v)) continue;
      EXPECT_EQ(cube.layers.wall(v)[0], 0.0);
      EXPECT_NEAR(cube.position(v)[0], 0.15, 1e-12);
      EXPECT_NEAR(cube.layers.wall(v)[1], cube.position(v)[1], 1e-12);
    }
    if (keep_tets) {
      EXPECT_EQ(cube.tet_vertices, testing::kuhn_cube(3).tet_vertices);
    }
  }
}

TEST(GrowLayers, OnAllSidesOfACubeMakesItSmaller)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(3);
  const LayerCover cover = grow_layers(cube, std::vector{two_layers("*")}, kModel, false);
  EXPECT_NEAR(testing::volume_of(cube), 0.7 * 0.7 * 0.7, 0.01);
  EXPECT_NEAR(cover.sum().full, 6.0, 1e-12);
}

// The one layer of 0.03 at x = 0 is thinner than the two at y = 0, so at the edge between them it
// holds.
TEST(GrowLayers, OfSeveralEntriesMeetInTheThinnestOnes)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(3);
  const std::vector<LayerOptions> options{{.patch = cube.patch_names[0], .first = 0.03, .count = 1},
                                          two_layers(cube.patch_names[2])};
  (void)grow_layers(cube, options, kModel, false);
  EXPECT_EQ(cube.layers.most_layers, 2);
  const auto layers_at = [&](LocalIndex v) {
    return cube.layers.num_layers(cube.layers.vertex_stack[at(v)]);
  };
  LocalIndex num_seen = 0;
  for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
    const Vec3 wall = cube.layers.wall(v);
    if (wall == cube.position(v)) continue;
    EXPECT_EQ(layers_at(v), wall[0] == 0.0 ? 1 : 2);
    if (wall[0] != 0.0) {
      EXPECT_NEAR(cube.position(v)[1], 0.15, 1e-12);
    }
    if (wall[1] != 0.0) {
      EXPECT_NEAR(cube.position(v)[0], 0.03, 1e-12);
    }
    ++num_seen;
  }
  EXPECT_EQ(num_seen, 28);
}

// More than there is room for: thinner, and still a sound mesh.
TEST(GrowLayers, ThickerThanHalfTheCubeGoAsFarAsTheyCan)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const LayerCover cover = grow_layers(
      cube, std::vector{LayerOptions{.patch = "*", .first = 0.2, .count = 4}}, kModel, false);
  EXPECT_GT(testing::volume_of(cube), 0.0);
  EXPECT_LT(testing::volume_of(cube), 1.0);
  EXPECT_LT(cover.sum().full, 6.0);
  EXPECT_NO_THROW(mesh::validate(cube));
}

// A cube that leans: four of its edges are at 34 degrees, four at 146.
TEST(GrowLayers, CloseTowardsAnAcuteEdge)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(4);
  for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
    cube.vertex_xyz[3 * at(v)] += 1.5 * cube.position(v)[2];
  }
  (void)grow_layers(cube, std::vector{LayerOptions{.patch = "*", .first = 0.02, .count = 2}},
                    kModel, false);
  LocalIndex num_acute = 0;
  LocalIndex num_obtuse = 0;
  for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
    const Vec3 wall = cube.layers.wall(v);
    const double x = wall[0] - 1.5 * wall[2];
    const bool is_on_edge = (x == 0.0 || x == 1.0) && (wall[2] == 0.0 || wall[2] == 1.0);
    if (!is_on_edge || wall[1] == 0.0 || wall[1] == 1.0) continue;
    const bool is_acute = x == wall[2];
    EXPECT_EQ(wall == cube.position(v), is_acute);
    ++(is_acute ? num_acute : num_obtuse);
  }
  EXPECT_EQ(num_acute, 6);
  EXPECT_EQ(num_obtuse, 6);
}

TEST(GrowLayers, OfAPatternAreOnTheOutsideOnly)
{
  mesh::CoarseMesh cube = testing::two_material_cube(2);
  const LayerCover cover = grow_layers(cube, std::vector{two_layers("*")}, kModel, false);
  EXPECT_EQ(cover.patches.size(), 6U);
  EXPECT_FALSE(cube.layers.is_wall(6));
}

// The face between two materials in the middle of a cube, open.
TEST(GrowLayers, StandOnTheSidesOfASplit)
{
  mesh::CoarseMesh closed = testing::two_material_cube(4);
  const std::string between = closed.patch_names[6];
  topology::split_patches(closed, {.patches = {{between}}});
  for (const auto& [name, num_walls] : {std::pair(between, 2), std::pair(between + "_minus", 1)}) {
    mesh::CoarseMesh cube = closed;
    const LayerCover cover = grow_layers(cube, std::vector{two_layers(name)}, kModel, true);
    EXPECT_EQ(cover.patches.size(), at(num_walls));
    EXPECT_NEAR(cover.sum().full, num_walls, 1e-12);
    EXPECT_NEAR(testing::volume_of(cube), 1.0 - 0.15 * num_walls, 1e-9);
    LocalIndex num_moved = 0;
    for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
      if (cube.layers.wall(v) == cube.position(v)) continue;
      EXPECT_NEAR(std::abs(cube.position(v)[0] - closed.position(v)[0]), 0.15, 1e-12);
      ++num_moved;
    }
    EXPECT_EQ(num_moved, 25 * num_walls);
  }
}

// Walls beside a split whose sides have no layers: on both materials, then on one of them. Each
// time the copies of a vertex stay at one place.
TEST(GrowLayers, KeepTheSidesOfASplitTogether)
{
  mesh::CoarseMesh closed = testing::two_material_cube(4);
  // The floor of each material is a patch of its own.
  const LocalIndex floor = 4;
  closed.patch_names.emplace_back("floor_2");
  closed.patch_surface.push_back(LocalIndex{closed.patch_surface[at(floor)]});
  for (LocalIndex f = 0; f < closed.num_faces(); ++f) {
    if (closed.face_patch[at(f)] != floor) continue;
    double x = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
      x += closed.position(closed.face_vertices[3 * at(f) + c])[0];
    if (x > 1.5) closed.face_patch[at(f)] = 7;
  }
  topology::split_patches(closed, {.patches = {{closed.patch_names[6]}}});
  const LayerOptions thin{.patch = "floor_2", .first = 0.03, .count = 1};
  for (const auto& walls :
       {std::vector{two_layers(closed.patch_names[floor]), thin}, std::vector{thin}}) {
    mesh::CoarseMesh cube = closed;
    (void)grow_layers(cube, walls, kModel, true);
    LocalIndex num_copies = 0;
    LocalIndex num_moved = 0;
    for (LocalIndex v = 1; v < cube.num_vertices(); ++v) {
      if (closed.position(v) != closed.position(v - 1)) continue;
      ++num_copies;
      EXPECT_EQ(cube.position(v), cube.position(v - 1));
      if (cube.position(v) == closed.position(v)) continue;
      ++num_moved;
      EXPECT_NEAR(cube.position(v)[2], 0.03, 1e-12);
      EXPECT_EQ(cube.layers.vertex_stack[at(v)], cube.layers.vertex_stack[at(v - 1)]);
      EXPECT_EQ(cube.layers.num_layers(cube.layers.vertex_stack[at(v)]), 1);
    }
    EXPECT_EQ(num_copies, 25);
    // But for its two ends, where no curve leads along the sides of the cube.
    EXPECT_EQ(num_moved, walls.size() == 2 ? 3 : 0);
  }
}

// One name for a patch on the outside and one inside: only the first one can be a wall.
TEST(GrowLayers, LeaveOutWhatLiesInsideOfAPatchOfTheirName)
{
  mesh::CoarseMesh cube = testing::two_material_cube(2);
  cube.patch_names[6] = cube.patch_names[0];
  const LayerCover cover =
      grow_layers(cube, std::vector{two_layers(cube.patch_names[0])}, kModel, true);
  EXPECT_EQ(cover.patches.size(), 1U);
  EXPECT_TRUE(cube.layers.is_wall(0));
  EXPECT_FALSE(cube.layers.is_wall(6));
}

TEST(GrowLayers, RefusesWhatItCannotDo)
{
  const auto names = testing::two_material_cube(2).patch_names;
  EXPECT_NE(error_of({two_layers("nothing")}).find("nothing"), std::string::npos);
  EXPECT_NE(error_of({two_layers(names[0]), two_layers("*")}).find("one entry only"),
            std::string::npos);
  EXPECT_NE(error_of({two_layers(names[6])}).find("lies inside of the model"), std::string::npos);
  EXPECT_NE(error_of({{.patch = names[0], .first = 9.0, .count = 1}}).find("box"),
            std::string::npos);
}

}  // namespace
}  // namespace tessera::layers

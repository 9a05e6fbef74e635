// SPDX-License-Identifier: BSD-3-Clause
#include "layers/image_columns.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tessera/topology/periodic_sides.hpp"

#include "support/meshes.hpp"

namespace tessera::layers {
namespace {

constexpr Vec3 kUp{0.0, 0.0, 1.0};

// A cube with a wall at z = 0. Columns go up as long as nothing else is said.
class ImageColumns : public ::testing::Test {
 protected:
  void join(const topology::PeriodicSide& side)
  {
    topology::join_periodic_sides(cube_, std::vector{side});
    walls_.wall_of_vertex.assign(at(cube_.num_vertices()), kNoIndex);
    for (LocalIndex v = 0; v < cube_.num_vertices(); ++v) {
      if (cube_.position(v)[2] != 0.0) continue;
      const auto row = static_cast<LocalIndex>(walls_.vertices.size());
      walls_.wall_of_vertex[at(v)] = row;
      walls_.vertices.push_back({.vertex = v, .column = kUp, .origin = row});
    }
    for (LocalIndex f = 0; f < cube_.num_faces(); ++f) {
      if (cube_.patch_names[at(cube_.face_patch[at(f)])] != "z0") continue;
      const LocalIndex* v = &cube_.face_vertices[3 * at(f)];
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(v[c], v[(c + 1) % 3]);
        on_walls_.insert({low, high});
      }
    }
  }

  void join_along_x() { join({.from = "x0", .to = "x1", .translation = {1.0, 0.0, 0.0}}); }

  [[nodiscard]] LocalIndex vertex_at(double x, double y) const
  {
    LocalIndex v = 0;
    while (cube_.position(v) != Vec3{x, y, 0.0}) ++v;
    return v;
  }

  WallVertex& at_place(double x, double y)
  {
    return walls_.vertices[at(walls_.wall_of_vertex[at(vertex_at(x, y))])];
  }

  void expect_column(double x, double y, const Vec3& expected)
  {
    EXPECT_LT(norm(at_place(x, y).column - expected), 1e-15) << x << " " << y;
  }

  mesh::CoarseMesh cube_ = testing::kuhn_cube(2);
  WallSurface walls_{};
  std::set<WallEdge> on_walls_{};
};

TEST_F(ImageColumns, AreTheMeanOfDirectionsAndTheShortestOfLengths)
{
  join_along_x();
  at_place(0.0, 0.5).column = {0.3, 0.0, 0.4};
  at_place(1.0, 0.5).column = {-1.2, 0.0, 1.6};
  join_image_columns(cube_, on_walls_, walls_);
  expect_column(0.0, 0.5, {0.0, 0.0, 0.5});
  expect_column(1.0, 0.5, {0.0, 0.0, 0.5});
  EXPECT_EQ(at_place(1.0, 0.5).origin, walls_.wall_of_vertex[at(vertex_at(0.0, 0.5))]);
  const Affine& there = walls_.images[at(at_place(1.0, 0.5).image)];
  EXPECT_EQ(there.shift, (Vec3{1.0, 0.0, 0.0}));
  EXPECT_EQ(at_place(0.0, 0.5).image, 0);
  EXPECT_EQ(walls_.images.front(), Affine{});
}

TEST_F(ImageColumns, StayWhereThereIsNoImage)
{
  join_along_x();
  at_place(0.5, 0.5).column = {0.3, 0.0, 0.4};
  join_image_columns(cube_, on_walls_, walls_);
  EXPECT_EQ(at_place(0.5, 0.5).column, (Vec3{0.3, 0.0, 0.4}));
  EXPECT_EQ(at_place(0.5, 0.5).origin, walls_.wall_of_vertex[at(vertex_at(0.5, 0.5))]);
}

// A quarter turn about z takes (0, y) to (y, 0).
TEST_F(ImageColumns, TurnWithTheirSides)
{
  join({.from = "x0", .to = "y0", .axis_point = {}, .axis = kUp, .angle_deg = -90.0});
  at_place(0.0, 0.5).column = {0.3, 0.0, 0.4};
  at_place(0.5, 0.0).column = {0.0, -0.6, 0.8};
  join_image_columns(cube_, on_walls_, walls_);
  expect_column(0.0, 0.5, {0.3, 0.0, 0.4});
  expect_column(0.5, 0.0, {0.0, -0.3, 0.4});
  expect_column(0.0, 0.0, kUp);  // On the axis, its own image.
}

TEST_F(ImageColumns, AreNoneWhereTheWallGoesOnWithoutLayers)
{
  join_along_x();
  const LocalIndex middle = vertex_at(1.0, 0.5);
  const LocalIndex end = vertex_at(1.0, 1.0);
  on_walls_.erase({std::min(middle, end), std::max(middle, end)});
  join_image_columns(cube_, on_walls_, walls_);
  for (const double x : {0.0, 1.0}) {
    expect_column(x, 0.0, kUp);
    expect_column(x, 0.5, {});
    expect_column(x, 1.0, {});
  }
  EXPECT_EQ(at_place(1.0, 1.0).origin, walls_.wall_of_vertex[at(end)]);
}

TEST_F(ImageColumns, AreNoneIfOneIsOnNoWall)
{
  join_along_x();
  walls_.wall_of_vertex[at(vertex_at(1.0, 0.5))] = kNoIndex;
  join_image_columns(cube_, on_walls_, walls_);
  expect_column(0.0, 0.5, {});
  expect_column(0.0, 0.0, kUp);
}

TEST_F(ImageColumns, AreNoneIfOneHasNone)
{
  join_along_x();
  at_place(1.0, 0.5).column = {};
  at_place(0.0, 1.0).column = {};
  join_image_columns(cube_, on_walls_, walls_);
  for (const double x : {0.0, 1.0}) {
    expect_column(x, 0.5, {});
    expect_column(x, 1.0, {});
  }
}

TEST_F(ImageColumns, StayWithoutImages)
{
  join_along_x();
  at_place(0.0, 0.5).column = {0.3, 0.0, 0.4};
  join_image_columns(testing::kuhn_cube(2), on_walls_, walls_);
  EXPECT_EQ(at_place(0.0, 0.5).column, (Vec3{0.3, 0.0, 0.4}));
  EXPECT_TRUE(walls_.images.empty());
}

}  // namespace
}  // namespace tessera::layers

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/optimize/optimize.hpp"

#include "sample_meshes.hpp"

namespace tessera::optimize {
namespace {

// What is said of a jittered cube after a change.
std::string refusal_of(const std::function<void(TetMesh&)>& change)
{
  TetMesh mesh = testing::jittered_cube(3, 0.5, 1);
  change(mesh);
  try {
    static_cast<void>(optimize(mesh, fast_schedule()));
  } catch (const MeshError& error) {
    return error.what();
  }
  return {};
}

TEST(OptimizeInput, IsValidWithoutAChange)
{
  EXPECT_EQ(refusal_of([](TetMesh&) {}), "");
}

TEST(OptimizeInput, RefusesIndicesOutOfRange)
{
  EXPECT_EQ(refusal_of([](TetMesh& mesh) { mesh.tet_vertices[4 * 7 + 2] = 64; }),
            "tet 7 has vertex 64 of 64");
  EXPECT_EQ(refusal_of([](TetMesh& mesh) { mesh.tet_vertices[4 * 7] = -1; }),
            "tet 7 has vertex -1 of 64");
}

TEST(OptimizeInput, RefusesPositionsThatAreNotFinite)
{
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity(), 1e301}) {
    const std::string refusal = refusal_of([x](TetMesh& mesh) { mesh.vertex_xyz[4] = x; });
    EXPECT_EQ(refusal, "vertex 1 of tet 0 is not finite");
  }
}

TEST(OptimizeInput, RefusesInvertedAndFlatTets)
{
  EXPECT_EQ(refusal_of([](TetMesh& mesh) {
              std::swap(mesh.tet_vertices[4 * 9], mesh.tet_vertices[4 * 9 + 1]);
            }),
            "tet 9 is flat or inverted");
  const std::string flat = refusal_of([](TetMesh& mesh) {
    mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), {9, 0, 0, 10, 0, 0, 9, 1, 0, 10, 1, 0});
    mesh.tet_vertices.insert(mesh.tet_vertices.end(), {64, 65, 66, 67});
  });
  EXPECT_EQ(flat, "tet 162 is flat or inverted");
}

TEST(OptimizeInput, RefusesATetWithOneVertexTwice)
{
  EXPECT_NE(refusal_of([](TetMesh& mesh) { mesh.tet_vertices[5] = mesh.tet_vertices[4]; }), "");
}

TEST(OptimizeInput, RefusesATriangleOfThreeTets)
{
  const TetMesh mesh{.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, -2},
                     .tet_vertices = {0, 1, 2, 3, 0, 2, 1, 4, 0, 2, 1, 5}};
  EXPECT_THROW(static_cast<void>(optimize(mesh, fast_schedule())), MeshError);
}

TEST(OptimizeInput, RefusesTwoTetsOnOneSideOfATriangle)
{
  const TetMesh mesh{.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 2},
                     .tet_vertices = {0, 1, 2, 3, 0, 1, 2, 4}};
  EXPECT_THROW(static_cast<void>(optimize(mesh, fast_schedule())), MeshError);
}

TEST(OptimizeInput, RefusesArraysThatDoNotFit)
{
  EXPECT_NE(refusal_of([](TetMesh& mesh) { mesh.vertex_xyz.pop_back(); }), "");
  EXPECT_NE(refusal_of([](TetMesh& mesh) { mesh.tet_vertices.pop_back(); }), "");
  EXPECT_NE(refusal_of([](TetMesh& mesh) { mesh.vertex_fixed.assign(3, 0); }), "");
  EXPECT_NE(refusal_of([](TetMesh& mesh) { mesh.tet_neighbours.assign(8, kNoIndex); }), "");
}

TEST(OptimizeInput, RefusesWrongNeighbours)
{
  const auto with_neighbours = [](const std::function<void(TetMesh&)>& change) {
    return refusal_of([&](TetMesh& mesh) {
      mesh.tet_neighbours = testing::neighbours_of(mesh.tet_vertices);
      change(mesh);
    });
  };
  EXPECT_EQ(with_neighbours([](TetMesh&) {}), "");
  EXPECT_NE(with_neighbours([](TetMesh& mesh) { mesh.tet_neighbours[8] = 1 << 20; }), "");
  EXPECT_NE(with_neighbours([](TetMesh& mesh) { mesh.tet_neighbours[8] = -7; }), "");
  EXPECT_NE(with_neighbours(
                [](TetMesh& mesh) { std::swap(mesh.tet_neighbours[8], mesh.tet_neighbours[9]); }),
            "");
  // A face inside that is said to be on the boundary.
  EXPECT_NE(with_neighbours([](TetMesh& mesh) {
              for (LocalIndex& corner : mesh.tet_neighbours) {
                if (corner == kNoIndex) continue;
                corner = kNoIndex;
                return;
              }
            }),
            "");
}

TEST(OptimizeInput, NamesUnknownSteps)
{
  EXPECT_THROW(static_cast<void>(parse_steps("mxs")), ConfigError);
}

}  // namespace
}  // namespace tessera::optimize

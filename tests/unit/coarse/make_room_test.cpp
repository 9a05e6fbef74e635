// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/make_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/tet.hpp"

#include "support/curved_models.hpp"
#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

// Of the bottom, over kuhn_cube(4): a parabola over each of the four cells in the middle. The
// vertices above them are off the geometry.
testing::GraphModel::Height arches(double height)
{
  return [height](double x, double y) {
    if (std::max(std::abs(x - 0.5), std::abs(y - 0.5)) > 0.25) return 0.0;
    const double s = 4.0 * x - std::floor(4.0 * x);
    return 4.0 * height * s * (1.0 - s);
  };
}

// Over kuhn_cube(1): a parabola over the diagonal of the bottom, nothing over its sides.
double ridge(double x, double y) { return 1.05 * std::min(x, y) * (1.0 - std::max(x, y)); }

// Corners of tets whose child there, after ten levels, is not positive.
int num_folded(const mesh::CoarseMesh& mesh, const testing::GraphModel::Height& height)
{
  const auto is_folded = [&](const std::array<Vec3, 4>& tet, const Vec3& corner) {
    std::array<Vec3, 4> child = tet;
    for (Vec3& point : child) {
      const bool is_on_bottom = point[2] == 0.0 && corner[2] == 0.0;
      point = corner + (1.0 / 1024.0) * (point - corner);
      if (is_on_bottom) point[2] = height(point[0], point[1]);
    }
    return !(tet_volume(child) > 0.0);
  };
  int num = 0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto tet = corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t);
    for (const Vec3& corner : tet) num += is_folded(tet, corner) ? 1 : 0;
  }
  return num;
}

TEST(MakeRoom, MovesVerticesWhereChildrenOfFineLevelsWouldFold)
{
  cut::CutMesh filled{.mesh = testing::kuhn_cube(4)};
  const mesh::CoarseMesh before = filled.mesh;
  ASSERT_GT(num_folded(before, arches(0.065)), 0);
  const testing::GraphModel model(arches(0.065));
  EXPECT_GT(make_room_for_arcs(filled, model), 0);
  EXPECT_EQ(num_folded(filled.mesh, arches(0.065)), 0);
  EXPECT_NO_THROW(mesh::validate(filled.mesh));
  EXPECT_EQ(filled.mesh.tet_vertices, before.tet_vertices);
  for (const LocalIndex v : before.face_vertices) {
    EXPECT_EQ(filled.mesh.position(v), before.position(v));
  }
  EXPECT_EQ(make_room_for_arcs(filled, model), 0) << "all have room";
}

TEST(MakeRoom, PutsAVertexWhereAnEdgeInsideBeginsOutside)
{
  cut::CutMesh filled{.mesh = testing::kuhn_cube(1)};
  const mesh::CoarseMesh before = filled.mesh;
  filled.tet_part.assign(at(before.num_tets()), 3);
  ASSERT_GT(num_folded(before, ridge), 0);
  EXPECT_EQ(make_room_for_arcs(filled, testing::GraphModel(ridge)), 1);
  EXPECT_EQ(num_folded(filled.mesh, ridge), 0);
  EXPECT_NO_THROW(mesh::validate(filled.mesh));
  EXPECT_EQ(filled.mesh.num_vertices(), before.num_vertices() + 1);
  EXPECT_EQ(filled.mesh.face_vertices, before.face_vertices);
  EXPECT_EQ(filled.tet_part, std::vector<LocalIndex>(at(filled.mesh.num_tets()), 3));
}

TEST(MakeRoom, NoTetOfAnotherPartIsTaken)
{
  cut::CutMesh filled{.mesh = testing::kuhn_cube(1)};
  const mesh::CoarseMesh before = filled.mesh;
  for (LocalIndex t = 0; t < before.num_tets(); ++t) filled.tet_part.push_back(t);
  make_room_for_arcs(filled, testing::GraphModel(ridge));
  std::vector<double> volumes(at(before.num_tets()), 0.0);
  for (std::size_t t = 0; t < filled.tet_part.size(); ++t) {
    volumes[at(filled.tet_part[t])] +=
        tet_volume(corners_at<4>(filled.mesh.vertex_xyz, filled.mesh.tet_vertices, t));
  }
  for (const double volume : volumes) EXPECT_NEAR(volume, 1.0 / 6.0, 1e-12);
}

TEST(MakeRoom, LeavesTetsThatHaveRoom)
{
  cut::CutMesh filled{.mesh = testing::kuhn_cube(4)};
  const mesh::CoarseMesh before = filled.mesh;
  for (const double height : {-0.065, 0.0, 0.04}) {
    ASSERT_EQ(num_folded(before, arches(height)), 0);
    EXPECT_EQ(make_room_for_arcs(filled, testing::GraphModel(arches(height))), 0);
  }
  EXPECT_EQ(filled.mesh.vertex_xyz, before.vertex_xyz);
}

}  // namespace
}  // namespace tessera::coarse

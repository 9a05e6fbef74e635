// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/make_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tessera/base/tet.hpp"

#include "support/curved_models.hpp"
#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

constexpr double kCell = 0.25;

// A parabola over each of the four cells in the middle, nothing at its ends. The vertices above
// them are off the geometry.
auto arches(double height)
{
  return [height](double x, double y) {
    if (std::max(std::abs(x - 0.5), std::abs(y - 0.5)) > kCell) return 0.0;
    const double s = x / kCell - std::floor(x / kCell);
    return 4.0 * height * s * (1.0 - s);
  };
}

struct MakeRoom : ::testing::Test {
  cut::CutMesh filled{.mesh = testing::kuhn_cube(4)};
  mesh::CoarseMesh& cube = filled.mesh;

  // Tets with a child in a corner, after ten levels, that is not positive.
  [[nodiscard]] int num_folded(double height) const
  {
    const auto is_folded = [&](const std::array<Vec3, 4>& tet, std::size_t corner) {
      std::array<Vec3, 4> child = tet;
      for (Vec3& point : child) {
        const bool is_on_bottom = point[2] == 0.0 && tet[corner][2] == 0.0;
        point = tet[corner] + (1.0 / 1024.0) * (point - tet[corner]);
        if (is_on_bottom) point[2] = arches(height)(point[0], point[1]);
      }
      return !(tet_volume(child) > 0.0);
    };
    int num = 0;
    for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
      const auto tet = corners_at<4>(cube.vertex_xyz, cube.tet_vertices, t);
      for (std::size_t corner = 0; corner < 4; ++corner) num += is_folded(tet, corner) ? 1 : 0;
    }
    return num;
  }
};

TEST_F(MakeRoom, MovesVerticesThatChildrenOfFineLevelsWouldFoldAt)
{
  constexpr double kHeight = 0.07;
  ASSERT_GT(num_folded(kHeight), 0);
  const FlatArray<double> before = cube.vertex_xyz;
  const testing::GraphModel model(arches(kHeight));
  EXPECT_GT(make_room_for_arcs(filled, model), 0);
  EXPECT_EQ(num_folded(kHeight), 0);
  EXPECT_NO_THROW(mesh::validate(cube));
  for (const LocalIndex v : cube.face_vertices) {
    EXPECT_EQ(cube.position(v), point_at(std::span<const double>(before), v));
  }
  EXPECT_EQ(make_room_for_arcs(filled, model), 0) << "all have room";
}

TEST_F(MakeRoom, LeavesTetsThatHaveRoom)
{
  const FlatArray<double> before = cube.vertex_xyz;
  for (const double height : {-0.07, 0.0, 0.04}) {
    ASSERT_EQ(num_folded(height), 0);
    EXPECT_EQ(make_room_for_arcs(filled, testing::GraphModel(arches(height))), 0);
  }
  EXPECT_EQ(cube.vertex_xyz, before);
}

}  // namespace
}  // namespace tessera::coarse

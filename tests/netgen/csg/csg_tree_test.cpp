// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"

#include "netgen/csg/access.hpp"
#include "netgen/csg/parse.hpp"
#include "netgen/csg/tree.hpp"

namespace tessera::netgen {
namespace {

constexpr double kTolerance = 1e-9;

// The surfaces are, in this order: six of the cube, ball, half, far.
constexpr const char* kText =
    "algebraic3d\n"
    "solid cube = orthobrick (-1, -1, -1; 1, 1, 1);\n"
    "solid ball = sphere (0, 0, 1; 0.5);\n"
    "solid half = plane (0, 0, 0; 1, 0, 0);\n"
    "solid far = sphere (5, 0, 0; 1);\n"
    "solid all = (cube and not ball and half) or far;\n"
    "tlo all;\n";
constexpr int kBall = 6;
constexpr int kHalf = 7;

struct Tree {
  explicit Tree(const char* text) : geometry(parse_csg(text, "tree.geo")) {}

  [[nodiscard]] std::set<int> surfaces(const Vec3& point) const
  {
    return surfaces_at(to_netgen(point), *geometry, solid, kTolerance);
  }
  [[nodiscard]] Place place(const Vec3& point) const
  {
    return place_of(to_netgen(point), solid, kTolerance);
  }

  std::unique_ptr<::netgen::CSGeometry> geometry;
  int first = 0;
  ::netgen::Solid& solid = *geometry->GetTopLevelObject(first)->GetSolid();
};

// No point of the grid lies on a surface.
TEST(CsgTree, PlacesPointsAsTheOperationsSay)
{
  const Tree tree(kText);
  int num_inside = 0;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 9; ++j) {
      for (int k = 0; k < 9; ++k) {
        const Vec3 p{-1.4 + 0.31 * i, -1.24 + 0.3 * j, -1.24 + 0.3 * k};
        const bool in_cube = std::abs(p[0]) < 1.0 && std::abs(p[1]) < 1.0 && std::abs(p[2]) < 1.0;
        const bool in_ball = norm(p - Vec3{0, 0, 1}) < 0.5;
        const bool in_far = norm(p - Vec3{5, 0, 0}) < 1.0;
        const bool is_inside = (in_cube && !in_ball && p[0] < 0.0) || in_far;
        num_inside += is_inside ? 1 : 0;
        EXPECT_EQ(tree.place(p), is_inside ? Place::inside : Place::outside)
            << p[0] << ' ' << p[1] << ' ' << p[2];
      }
    }
  }
  EXPECT_GT(num_inside, 0);
}

TEST(CsgTree, PutsPointsOnWhatBoundsTheSolidAlone)
{
  const Tree tree(kText);
  EXPECT_EQ(tree.place({0, 0.7, 0.2}), Place::on);
  EXPECT_EQ(tree.place({0, 0, 0.7}), Place::outside);    // Within the ball.
  EXPECT_EQ(tree.place({0.5, 0.7, 1}), Place::outside);  // Beyond the plane.
  EXPECT_EQ(tree.place({0, 3, 0}), Place::outside);
}

TEST(CsgTree, HasTheSurfacesThatMeetAtAPoint)
{
  const Tree tree(kText);
  EXPECT_EQ(surfaces_of(*tree.geometry, tree.solid), (std::set{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(tree.surfaces({0, 0, 0.5}), (std::set{kBall, kHalf}));
  EXPECT_EQ(tree.surfaces({0, 0.7, 0.2}), std::set{kHalf});
  EXPECT_EQ(tree.surfaces({-1, -1, -1}).size(), 3U);
  EXPECT_EQ(tree.surfaces({-0.5, 0, 0}), std::set<int>());
  EXPECT_EQ(tree.surfaces({0, 0, 0.7}), std::set<int>());
}

// Where a body swallows the surface of another there is none.
TEST(CsgTree, HasNoSurfaceInsideOfAUnion)
{
  constexpr const char* kUnion =
      "algebraic3d\nsolid left = sphere (0, 0, 0; 1);\nsolid right = sphere (1, 0, 0; 1);\n"
      "solid both = left or right;\ntlo both;\n";
  const Tree tree(kUnion);
  EXPECT_EQ(tree.surfaces({1, 0, 0}), std::set<int>());
  EXPECT_EQ(tree.place({1, 0, 0}), Place::inside);
  EXPECT_EQ(tree.surfaces({-1, 0, 0}), std::set{0});
}

}  // namespace
}  // namespace tessera::netgen

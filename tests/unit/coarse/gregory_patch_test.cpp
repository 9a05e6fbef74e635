// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/gregory_patch.hpp"

#include <gtest/gtest.h>

namespace tessera::coarse {
namespace {

using Corners = GregoryPatch::Corners;
using Sides = GregoryPatch::Sides;

constexpr Vec3 kA{0.0, 0.0, 0.0};
constexpr Vec3 kB{3.0, 0.0, 0.0};
// At right angles to the normal at its end, and curved.
constexpr std::array<Vec3, 2> kSideAB{{{1.0, 0.0, 0.5}, {2.0, 0.0, 0.5}}};

std::array<Vec3, 2> thirds(const Vec3& a, const Vec3& b)
{
  return {a + 1.0 / 3.0 * (b - a), b + 1.0 / 3.0 * (a - b)};
}

Sides straight(const Corners& p)
{
  return {thirds(p[0], p[1]), thirds(p[1], p[2]), thirds(p[2], p[0])};
}

// The normals at A and B, at right angles to the side there.
const Vec3 kNormalA = unit({-0.5, 0.0, 1.0});
const Vec3 kNormalB = unit({0.5, 0.0, 1.0});

// A control point on the way from `from` towards `to` that keeps to the plane of the normal.
Vec3 in_plane(const Vec3& from, const Vec3& to, const Vec3& normal)
{
  const Vec3 step = 1.0 / 3.0 * (to - from);
  return from + step - dot(step, normal) * normal;
}

// With the side from A to B, or from B to A, and a third corner.
GregoryPatch patch_over(const Vec3& third, bool is_forward)
{
  const Vec3& first = is_forward ? kA : kB;
  const Vec3& second = is_forward ? kB : kA;
  const Vec3& normal_first = is_forward ? kNormalA : kNormalB;
  const Vec3& normal_second = is_forward ? kNormalB : kNormalA;
  const Vec3 up{0.0, 0.0, 1.0};
  const Sides sides{{{kSideAB[is_forward ? 0 : 1], kSideAB[is_forward ? 1 : 0]},
                     {in_plane(second, third, normal_second), in_plane(third, second, up)},
                     {in_plane(third, first, up), in_plane(first, third, normal_first)}}};
  return {{first, second, third}, sides, {normal_first, normal_second, up}};
}

// Along its first side, by finite differences.
Vec3 normal_on_side(const GregoryPatch& patch, double along)
{
  constexpr double kStep = 1e-5;
  const Vec3 here = patch.at({1.0 - along, along, 0.0});
  const Vec3 beside = patch.at({1.0 - along - kStep, along + kStep, 0.0});
  const Vec3 inside = patch.at({(1.0 - along) * (1.0 - kStep), along * (1.0 - kStep), kStep});
  return unit(cross(beside - here, inside - here));
}

TEST(GregoryPatch, OfStraightSidesInAPlaneIsTheTriangle)
{
  const Corners p{{{0.0, 0.0, 1.0}, {4.0, 1.0, 1.0}, {1.0, 3.0, 1.0}}};
  const Vec3 up{0.0, 0.0, 1.0};
  const GregoryPatch patch(p, straight(p), {up, up, up});
  for (const double a : {0.0, 0.125, 0.5, 0.75}) {
    for (const double b : {0.0, 0.125, 0.25}) {
      const double c = 1.0 - a - b;
      EXPECT_LT(norm(patch.at({a, b, c}) - (a * p[0] + b * p[1] + c * p[2])), 1e-14);
    }
  }
}

TEST(GregoryPatch, HasItsCornersAndItsSides)
{
  const Vec3 third{1.5, 3.0, 0.0};
  const GregoryPatch patch = patch_over(third, true);
  EXPECT_EQ(patch.at({1.0, 0.0, 0.0}), kA);
  EXPECT_EQ(patch.at({0.0, 1.0, 0.0}), kB);
  EXPECT_EQ(patch.at({0.0, 0.0, 1.0}), third);
  // The middle of Bezier's cubic: an eighth of the ends, three of the points between.
  EXPECT_LT(norm(patch.at({0.5, 0.5, 0.0}) - Vec3{1.5, 0.0, 0.375}), 1e-15);
}

TEST(GregoryPatch, MeetsItsNeighbourWithoutACrease)
{
  const GregoryPatch left = patch_over({1.0, 3.0, -0.5}, true);
  const GregoryPatch right = patch_over({2.5, -2.0, -1.0}, false);
  for (const double along : {0.1, 0.3, 0.5, 0.8}) {
    EXPECT_LT(norm(left.at({1.0 - along, along, 0.0}) - right.at({along, 1.0 - along, 0.0})),
              1e-14);
    EXPECT_LT(norm(normal_on_side(left, along) - normal_on_side(right, 1.0 - along)), 1e-3);
  }
}

TEST(GregoryPatch, IsTheSameWithNormalsOfEitherSign)
{
  const Corners p{{kA, kB, {1.0, 3.0, 0.0}}};
  const Corners up{{kNormalA, kNormalB, {0.0, 0.0, 1.0}}};
  Corners down;
  for (std::size_t c = 0; c < 3; ++c) down[c] = -1.0 * up[c];
  Sides sides = straight(p);
  sides[0] = kSideAB;
  const std::array<double, 3> weights{0.25, 0.25, 0.5};
  EXPECT_LT(norm(GregoryPatch(p, sides, up).at(weights) - GregoryPatch(p, sides, down).at(weights)),
            1e-15);
}

}  // namespace
}  // namespace tessera::coarse

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/sizing/size_field.hpp"

#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::sizing {
namespace {

using mesh::GridField;
using mesh::TetField;
using testing::kuhn_cube;
using testing::message_of;

SizeOptions field_options(double grading) { return {.grading = grading, .field = "f.vtu"}; }

SizeField size_field(const mesh::PointField& field, double grading = 1.0)
{
  return SizeField(field_options(grading), kuhn_cube(1), &field);
}

std::string error_of(const mesh::PointField& field)
{
  return message_of<InputError>([&] { (void)size_field(field); });
}

template <class Value>
TetField tet_field(int n, Value value)
{
  const mesh::CoarseMesh cube = kuhn_cube(n);
  TetField field{cube.vertex_xyz.to_vector(), cube.tet_vertices.to_vector(), {}};
  for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
    field.values.push_back(value(cube.position(v)));
  }
  return field;
}

// Of the unit cube, as kuhn_cube(n).
template <class Value>
GridField grid_field(int n, Value value)
{
  const double step = 1.0 / n;
  GridField field{{}, {Vec3{step, 0, 0}, {0, step, 0}, {0, 0, step}}, {n + 1, n + 1, n + 1}, {}};
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i)
        field.values.push_back(value(Vec3{i * step, j * step, k * step}));
    }
  }
  return field;
}

double linear(const Vec3& p) { return 1.0 + 0.2 * p[0] - 0.3 * p[1] + 0.1 * p[2]; }

std::vector<double> random_points(std::size_t num_points)
{
  std::mt19937_64 random(7);
  std::vector<double> xyz(3 * num_points);
  for (double& x : xyz) x = static_cast<double>(random()) / 0x1p64;
  return xyz;
}

void expect_linear(const SizeField& field)
{
  const std::vector<double> xyz = random_points(1000);
  const std::vector<double> sizes = field.at(xyz);
  ASSERT_EQ(sizes.size(), 1000U);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_NEAR(sizes[i], linear(point_at(std::span<const double>(xyz), i)), 1e-14);
  }
}

TEST(PointFields, AreLinearInTets) { expect_linear(size_field(tet_field(3, linear))); }

TEST(PointFields, AreLinearInTetsOfTheOtherOrientation)
{
  TetField field = tet_field(3, linear);
  for (std::size_t t = 0; t < field.tet_points.size(); t += 4) {
    std::swap(field.tet_points[t], field.tet_points[t + 1]);
  }
  expect_linear(size_field(field));
}

TEST(PointFields, AreLinearInGrids) { expect_linear(size_field(grid_field(3, linear))); }

TEST(PointFields, GridsMayBeTurned)
{
  // A quarter turn around z, and steps of different lengths: i along y, j against x.
  const GridField field{
      {1.0, 0.0, 0.0}, {Vec3{0.0, 0.5, 0.0}, {-0.25, 0.0, 0.0}, {0.0, 0.0, 1.0}}, {3, 5, 2}, [] {
        std::vector<double> values;
        for (int k = 0; k < 2; ++k) {
          for (int j = 0; j < 5; ++j) {
            for (int i = 0; i < 3; ++i) {
              values.push_back(linear({1.0 - 0.25 * j, 0.5 * i, 1.0 * k}));
            }
          }
        }
        return values;
      }()};
  expect_linear(size_field(field));
}

TEST(PointFields, GrowOutsideFromTheNearestPoint)
{
  for (const mesh::PointField& field :
       {mesh::PointField(tet_field(3, linear)), mesh::PointField(grid_field(3, linear))}) {
    const SizeField sizes = size_field(field, 0.5);
    EXPECT_NEAR(sizes.at(Vec3{0.4, 0.3, 3.0}).front(), linear({0.4, 0.3, 1.0}) + 0.5 * 2.0, 1e-14);
    EXPECT_NEAR(sizes.at(Vec3{-3.0, 5.0, 0.1}).front(), linear({0.0, 1.0, 0.1}) + 0.5 * 5.0, 1e-14);
  }
}

TEST(PointFields, GrowthIsLimitedBetweenTheirPoints)
{
  // One small value in a corner: along the edges of the cube it grows by the grading, to the bound.
  const auto corner = [](const Vec3& p) { return norm(p) == 0.0 ? 0.1 : 2.0; };
  for (const mesh::PointField& field :
       {mesh::PointField(tet_field(8, corner)), mesh::PointField(grid_field(8, corner))}) {
    const SizeField sizes = size_field(field, 0.4);
    EXPECT_NEAR(sizes.at(Vec3{0.5, 0.0, 0.0}).front(), 0.3, 1e-14);
    EXPECT_NEAR(sizes.at(Vec3{0.0, 0.0, 1.0}).front(), 0.5, 1e-14);
    EXPECT_NEAR(sizes.at(Vec3{0.5, 0.5, 0.5}).front(), 0.1 + 0.4 * std::sqrt(0.75), 1e-14);
    EXPECT_NEAR(sizes.at(Vec3{1.0 / 16.0, 0.0, 0.0}).front(), 0.125, 1e-14);
  }
}

TEST(PointFields, PiecesThatShareOnlyPositionsAreJoinedAndTheLeastValueCounts)
{
  TetField field = tet_field(4, [](const Vec3&) { return 2.0; });
  TetField other = field;  // The neighbour in x, with points of its own.
  const auto num_points = static_cast<LocalIndex>(field.values.size());
  for (std::size_t i = 0; i < other.point_xyz.size(); i += 3) other.point_xyz[i] += 1.0;
  for (LocalIndex& point : other.tet_points) point += num_points;
  for (std::size_t i = 0; i < other.values.size(); ++i) {
    if (other.point_xyz[3 * i] == 1.0) other.values[i] = 0.2;  // On the common side.
  }
  field.point_xyz.insert(field.point_xyz.end(), other.point_xyz.begin(), other.point_xyz.end());
  field.tet_points.insert(field.tet_points.end(), other.tet_points.begin(), other.tet_points.end());
  field.values.insert(field.values.end(), other.values.begin(), other.values.end());
  const SizeField sizes = size_field(field, 0.5);
  EXPECT_NEAR(sizes.at(Vec3{1.0, 0.5, 0.5}).front(), 0.2, 1e-14);
  EXPECT_NEAR(sizes.at(Vec3{0.5, 0.5, 0.5}).front(), 0.2 + 0.25, 1e-14);
  EXPECT_NEAR(sizes.at(Vec3{1.5, 0.5, 0.5}).front(), 0.2 + 0.25, 1e-14);
}

TEST(PointFields, FlatTetsAndUnusedPointsDoNotCount)
{
  TetField field = tet_field(2, linear);
  const auto unused = static_cast<LocalIndex>(field.values.size());
  field.point_xyz.insert(field.point_xyz.end(), {9.0, 9.0, 9.0});
  field.values.push_back(std::numeric_limits<double>::quiet_NaN());
  field.tet_points.insert(field.tet_points.end(), {0, 1, 1, unused});
  expect_linear(size_field(field));
}

TEST(PointFields, SizesAtManyPointsAreThoseAtEachAlone)
{
  const SizeField sizes = size_field(tet_field(4, linear), 0.3);
  const std::vector<double> xyz = random_points(200);
  const std::vector<double> together = sizes.at(xyz);
  for (std::size_t i = 0; i < together.size(); ++i) {
    EXPECT_EQ(sizes.at(point_at(std::span<const double>(xyz), i)).front(), together[i]);
  }
}

TEST(PointFieldErrors, SizesThatAreNotPositiveAreNamedWithTheirPlace)
{
  for (const double wrong : {0.0, -2.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    const auto value = [&](const Vec3& p) { return p == Vec3{1.0, 0.5, 0.0} ? wrong : 1.0; };
    for (const mesh::PointField& field :
         {mesh::PointField(tet_field(2, value)), mesh::PointField(grid_field(2, value))}) {
      const std::string message = error_of(field);
      EXPECT_NE(message.find("size.field = \"f.vtu\", array \"size\": its size at (1, 0.5, 0) is"),
                std::string::npos)
          << message;
    }
  }
}

TEST(PointFieldErrors, AFieldElsewhereNamesBothBoxes)
{
  TetField field = tet_field(2, linear);
  for (double& x : field.point_xyz) x = 1000.0 * x + 1001.0;
  EXPECT_NE(error_of(field).find("its box is (1001, 1001, 1001) to (2001, 2001, 2001), which does "
                                 "not meet the model's, (0, 0, 0) to (1, 1, 1)"),
            std::string::npos)
      << error_of(field);
}

TEST(PointFieldErrors, AFieldWithoutAVolume)
{
  TetField field = tet_field(2, linear);
  for (std::size_t i = 2; i < field.point_xyz.size(); i += 3) field.point_xyz[i] = 0.5;
  EXPECT_NE(error_of(field).find("none of its cells has a volume"), std::string::npos);
}

TEST(PointFieldErrors, TheFieldIsTheOneOfTheOptions)
{
  const mesh::PointField field = tet_field(1, linear);
  EXPECT_THROW(SizeField({.target = 1.0}, kuhn_cube(1), &field), UsageError);
  EXPECT_THROW(SizeField(field_options(0.3), kuhn_cube(1)), UsageError);
}

}  // namespace
}  // namespace tessera::sizing

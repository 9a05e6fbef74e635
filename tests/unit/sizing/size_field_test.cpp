// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/sizing/size_field.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::sizing {
namespace {

using testing::kuhn_cube;
using testing::message_of;
using testing::two_material_cube;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SizeOptions one_region(Shape shape, double size = 0.1, double growth = 0.5)
{
  return {.regions = {{std::move(shape), size, growth}}};
}

double size_at(const SizeOptions& options, const Vec3& point)
{
  return SizeField(options, kuhn_cube(2)).at(point).front();
}

// What a region of size 0.1 and growth 0.5 wants tells how far it is.
double distance_to(const Shape& shape, const Vec3& point)
{
  return (size_at(one_region(shape), point) - 0.1) / 0.5;
}

std::string error_of(const SizeOptions& options, const mesh::CoarseMesh& coarse = kuhn_cube(2))
{
  return message_of<ConfigError>([&] { (void)SizeField(options, coarse); });
}

TEST(SizeField, IsTheTargetAloneWithinItsBounds)
{
  EXPECT_EQ(size_at({.target = 0.7}, {0.1, 0.2, 0.3}), 0.7);
  EXPECT_EQ(size_at({.target = 0.7, .min = 0.8}, {0.1, 0.2, 0.3}), 0.8);
  EXPECT_EQ(size_at({.target = 0.7, .max = 0.6}, {0.1, 0.2, 0.3}), 0.6);
  EXPECT_EQ(size_at({}, {0.1, 0.2, 0.3}), kInfinity);
  EXPECT_EQ(size_at({.max = 2.0}, {0.1, 0.2, 0.3}), 2.0);
  EXPECT_EQ(SizeField({.target = 0.7}, kuhn_cube(1)).steepest(), 0.0);
}

TEST(SizeField, TakesManyPointsAtOnceAndNone)
{
  const SizeField field(one_region(Ball{{0.0, 0.0, 0.0}, 0.5}), kuhn_cube(2));
  const std::vector<double> xyz{0.0, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 0.0, 2.5};
  EXPECT_EQ(field.at(xyz), (std::vector<double>{0.1, 0.6, 1.1}));
  EXPECT_TRUE(field.at({}).empty());
}

TEST(SizeField, DistanceToABall)
{
  const Ball ball{{0.5, 0.5, 0.5}, 0.25};
  EXPECT_DOUBLE_EQ(distance_to(ball, {0.5, 0.6, 0.6}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to(ball, {0.5, 0.5, 1.5}), 0.75);
  EXPECT_DOUBLE_EQ(distance_to(ball, {3.5, 4.5, 0.5}), 4.75);
}

TEST(SizeField, DistanceToABox)
{
  const Box box{{0.0, 0.1, 0.2}, {1.0, 0.5, 0.6}};
  EXPECT_DOUBLE_EQ(distance_to(box, {0.5, 0.3, 0.4}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to(box, {0.5, 0.3, 2.6}), 2.0);   // A side,
  EXPECT_DOUBLE_EQ(distance_to(box, {4.0, 0.3, -3.8}), 5.0);  // an edge,
  EXPECT_DOUBLE_EQ(distance_to(box, {-1.0, 2.5, 2.6}), 3.0);  // a corner.
}

TEST(SizeField, DistanceToACylinder)
{
  const Cylinder cylinder{{0.0, 0.5, 0.5}, {1.0, 0.5, 0.5}, 0.25};
  EXPECT_NEAR(distance_to(cylinder, {0.3, 0.6, 0.7}), 0.0, 1e-15);
  EXPECT_NEAR(distance_to(cylinder, {0.3, 0.5, 2.75}), 2.0, 1e-15);  // The mantle,
  EXPECT_NEAR(distance_to(cylinder, {-1.5, 0.6, 0.5}), 1.5, 1e-15);  // an end,
  EXPECT_NEAR(distance_to(cylinder, {4.0, 4.75, 0.5}), 5.0, 1e-14);  // its rim.
}

TEST(SizeField, DistanceToAHalfSpaceIsThatToItsPlaneOnTheSideOfTheNormal)
{
  const HalfSpace half_space{{0.5, 0.0, 0.0}, {3.0, 0.0, 0.0}};
  EXPECT_DOUBLE_EQ(distance_to(half_space, {0.4, 7.0, 7.0}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to(half_space, {2.5, 7.0, 7.0}), 2.0);
}

TEST(SizeField, DistanceToAPatchIsThatToItsTriangles)
{
  mesh::CoarseMesh cube = kuhn_cube(2);
  cube.patch_names[1] = "outlet";  // x = 1.
  const SizeField field(one_region(PatchPattern{"out*"}), cube);
  EXPECT_DOUBLE_EQ(field.at(Vec3{1.0, 0.3, 0.7}).front(), 0.1);
  EXPECT_DOUBLE_EQ(field.at(Vec3{0.2, 0.3, 0.7}).front(), 0.1 + 0.5 * 0.8);
  EXPECT_DOUBLE_EQ(field.at(Vec3{1.0, 4.0, 5.0}).front(), 0.1 + 0.5 * 5.0);
}

TEST(SizeField, DistanceToAMaterialIsZeroInItAndElseToItsTets)
{
  mesh::CoarseMesh cube = two_material_cube(2);
  cube.material_names = {"iron", "steel"};  // Steel beyond x = 1/2.
  const SizeField field(one_region(MaterialPattern{"steel"}), cube);
  EXPECT_EQ(field.at(Vec3{0.93, 0.31, 0.72}).front(), 0.1);
  EXPECT_DOUBLE_EQ(field.at(Vec3{0.1, 0.31, 0.72}).front(), 0.1 + 0.5 * 0.4);
  const SizeField both(one_region(MaterialPattern{"*"}), cube);
  EXPECT_EQ(both.at(Vec3{0.1, 0.31, 0.72}).front(), 0.1);
}

// With curves along the x and the y axis, and one that no segment lies on.
mesh::CoarseMesh cube_with_curves()
{
  mesh::CoarseMesh cube = kuhn_cube(1);
  const auto vertex_at = [&](const Vec3& place) {
    LocalIndex v = 0;
    while (cube.position(v) != place) ++v;
    return v;
  };
  const LocalIndex origin = vertex_at({0.0, 0.0, 0.0});
  cube.segment_vertices = {origin, vertex_at({1.0, 0.0, 0.0}), vertex_at({0.0, 1.0, 0.0}), origin};
  cube.segment_curve = {4, 11};
  cube.curves = {{4, "5", "rim"}, {11, "12", ""}, {12, "13", "gone"}};
  return cube;
}

TEST(SizeField, DistanceToACurveIsThatToItsSegments)
{
  const mesh::CoarseMesh cube = cube_with_curves();
  for (const char* pattern : {"5", "rim", "r?m"}) {
    const SizeField field(one_region(CurvePattern{pattern}), cube);
    EXPECT_DOUBLE_EQ(field.at(Vec3{0.3, 0.0, 0.0}).front(), 0.1);
    EXPECT_DOUBLE_EQ(field.at(Vec3{0.3, 0.6, 0.8}).front(), 0.1 + 0.5 * 1.0);
    EXPECT_DOUBLE_EQ(field.at(Vec3{1.3, 0.4, 0.0}).front(), 0.1 + 0.5 * 0.5);
  }
  const SizeField both(one_region(CurvePattern{"*"}), cube);
  EXPECT_DOUBLE_EQ(both.at(Vec3{0.3, 0.6, 0.0}).front(), 0.1 + 0.5 * 0.3);
}

TEST(SizeFieldErrors, UnknownCurvesListTheKnownOnes)
{
  EXPECT_EQ(error_of(one_region(CurvePattern{"11"}), cube_with_curves()),
            "[[size.region]] number 1 (curve): curve = \"11\": the model has no such curve; it has "
            "\"12\", \"rim\", \"gone\"; `tessera info MODEL` lists them");
  EXPECT_EQ(error_of(one_region(CurvePattern{"gone"}), cube_with_curves()),
            "[[size.region]] number 1 (curve): curve = \"gone\": the coarse mesh has no segment on "
            "it; leave it out");
  EXPECT_EQ(error_of(one_region(CurvePattern{"1"})),
            "[[size.region]] number 1 (curve): curve = \"1\": the model has no curves; choose "
            "another shape");
}

TEST(SizeField, SmallestOfAllWins)
{
  const SizeOptions options{
      .target = 0.3,
      .min = 0.05,
      .max = 0.25,
      .regions = {{Ball{{0.0, 0.0, 0.0}, 0.1}, 0.01, 0.5}, {Ball{{1.0, 0.0, 0.0}, 0.1}, 0.2, 0.5}}};
  EXPECT_EQ(size_at(options, {0.0, 0.0, 0.0}), 0.05);         // The first ball, bounded.
  EXPECT_DOUBLE_EQ(size_at(options, {0.3, 0.0, 0.0}), 0.11);  // The growth around it.
  EXPECT_EQ(size_at(options, {1.0, 0.05, 0.0}), 0.2);         // The second ball.
  EXPECT_EQ(size_at(options, {0.5, 1.0, 1.0}), 0.25);         // The target, bounded.
}

TEST(SizeField, GrowthIsTheGradingUnlessARegionHasItsOwn)
{
  SizeOptions options = one_region(Ball{{0.0, 0.0, 0.0}, 0.5}, 0.1, 0.0);
  options.grading = 0.25;
  EXPECT_DOUBLE_EQ(size_at(options, {2.5, 0.0, 0.0}), 0.6);
  EXPECT_EQ(SizeField(options, kuhn_cube(1)).steepest(), 0.25);
  options.regions.push_back({Ball{{0.0, 0.0, 0.0}, 0.1}, 5.0, 0.75});
  EXPECT_EQ(SizeField(options, kuhn_cube(1)).steepest(), 0.75);
}

TEST(SizeFieldErrors, RegionsThatMeetNothingNameTheModelsBox)
{
  const Shape far[] = {Box{{2.0, 0.0, 0.0}, {3.0, 1.0, 1.0}}, Ball{{-1.0, 0.5, 0.5}, 0.25},
                       Cylinder{{0.0, 2.0, 0.0}, {1.0, 2.0, 0.0}, 0.5},
                       HalfSpace{{0.0, 0.0, -2.0}, {0.0, 0.0, 1.0}}};
  for (const Shape& shape : far) {
    const std::string message = error_of(one_region(shape));
    EXPECT_NE(message.find("[[size.region]] number 1 (" + std::string(word_of(shape))),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("whose box is (0, 0, 0) to (1, 1, 1)"), std::string::npos) << message;
  }
}

TEST(SizeFieldErrors, ASmallRegionInsideOfATetMeetsTheMesh)
{
  const mesh::CoarseMesh cube = kuhn_cube(1);
  const Vec3 inside{0.41, 0.22, 0.13};
  EXPECT_EQ(error_of(one_region(Ball{inside, 1e-6}), cube), "");
  EXPECT_EQ(error_of(one_region(Box{inside, inside}), cube), "");
  EXPECT_EQ(error_of(one_region(Cylinder{inside, {0.42, 0.22, 0.13}, 1e-6}), cube), "");
}

TEST(SizeFieldErrors, ARegionInACavityMeetsNothing)
{
  mesh::CoarseMesh cube = kuhn_cube(8);  // Without the tets of its middle.
  std::vector<LocalIndex> tets;
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    Vec3 centre{};
    for (const LocalIndex v : cube.tet(t)) centre = centre + 0.25 * cube.position(v);
    bool is_in_middle = true;
    for (const double x : centre) is_in_middle = is_in_middle && x > 0.25 && x < 0.75;
    if (!is_in_middle) tets.insert(tets.end(), cube.tet(t).begin(), cube.tet(t).end());
  }
  cube.tet_vertices = tets;
  EXPECT_NE(error_of(one_region(Ball{{0.5, 0.5, 0.5}, 0.1}), cube), "");
  EXPECT_EQ(error_of(one_region(Ball{{0.5, 0.5, 0.5}, 0.3}), cube), "");
  EXPECT_NE(error_of(one_region(Box{{0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}}), cube), "");
}

TEST(SizeFieldErrors, UnknownNamesListTheKnownOnesNearestFirst)
{
  mesh::CoarseMesh cube = two_material_cube(2);
  cube.patch_names = {"wall", "inlet", "outlet", "wall", "top", "bottom", "core"};
  cube.material_names = {"iron", "steel"};
  EXPECT_EQ(
      error_of(one_region(PatchPattern{"inlt"}), cube),
      "[[size.region]] number 1 (patch): patch = \"inlt\": the model has no such patch; it has "
      "\"inlet\", \"wall\", \"core\", \"outlet\", \"top\", \"bottom\"");
  SizeOptions options = one_region(MaterialPattern{"*"});
  options.regions.push_back({MaterialPattern{"stel"}, 0.1, 0.0});
  EXPECT_EQ(error_of(options, cube),
            "[[size.region]] number 2 (material): material = \"stel\": the model has no such "
            "material; it has \"steel\", \"iron\"");
}

TEST(SizeFieldErrors, ANameWithCharactersOfPatternsIsAlsoAName)
{
  mesh::CoarseMesh cube = kuhn_cube(2);
  cube.patch_names[1] = "f[1]*";
  const SizeField field(one_region(PatchPattern{"f[1]*"}), cube);
  EXPECT_DOUBLE_EQ(field.at(Vec3{0.2, 0.3, 0.7}).front(), 0.1 + 0.5 * 0.8);
}

TEST(SizeFieldErrors, ShapesWithoutSenseAreRefused)
{
  EXPECT_NE(error_of(one_region(Cylinder{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, 1.0})), "");
  EXPECT_NE(error_of(one_region(HalfSpace{{0.5, 0.5, 0.5}, {0.0, 0.0, 0.0}})), "");
  EXPECT_NE(error_of(one_region(Box{{0.5, 0.5, 0.5}, {0.6, 0.4, 0.6}})), "");
}

}  // namespace
}  // namespace tessera::sizing

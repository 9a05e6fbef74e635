// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/side_shift.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/flat_model.hpp"

namespace tessera::surface {
namespace {

constexpr Vec3 kShift{2.0, 3.0, 5.0};

// A model of curves only: each puts a point onto itself. Curve 1 is the image of curve 0, and so
// on.
class CurvesModel final : public testing::FlatModel {
 public:
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double) const override
  {
    return {curves_.at(at(curve))(point), 0.0};
  }

  // A curve and its image, and chords of the first between these points.
  void add(const std::function<Vec3(const Vec3&)>& onto, const std::vector<Vec3>& points)
  {
    const auto curve = static_cast<LocalIndex>(curves_.size());
    curves_.push_back(onto);
    curves_.push_back([onto](const Vec3& point) { return onto(point - kShift) + kShift; });
    pairs_.push_back({curve, curve + 1});
    add_chords(curve, points);
  }

  void add_chords(LocalIndex curve, const std::vector<Vec3>& points)
  {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto next = static_cast<LocalIndex>(chords_.vertex_xyz.size());
      chords_.vertex_xyz.insert(chords_.vertex_xyz.end(), {points[i - 1], points[i]});
      chords_.edges.push_back({next, next + 1});
      chords_.edge_curve.push_back(curve);
    }
  }

  [[nodiscard]] Vec3 shift_from(const Vec3& guess) const
  {
    return shift_by_curves(SurfaceReference(chords_), *this, pairs_, guess);
  }

 private:
  std::vector<std::function<Vec3(const Vec3&)>> curves_{};
  std::vector<std::array<LocalIndex, 2>> pairs_{};
  PatchSurface chords_{};
};

// Through the origin.
std::function<Vec3(const Vec3&)> line_along(const Vec3& direction)
{
  return [d = unit(direction)](const Vec3& point) { return dot(d, point) * d; };
}

// Of radius 1 about the origin, in the plane across z.
Vec3 onto_circle(const Vec3& point) { return unit({point[0], point[1], 0.0}); }

TEST(ShiftByCurves, FollowsACircleFromItsChords)
{
  CurvesModel model;
  std::vector<Vec3> points;
  for (int i = 0; i <= 7; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 7.0;
    points.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  model.add(onto_circle, points);
  EXPECT_LT(norm(model.shift_from(kShift + Vec3{0.02, -0.01, 0.03}) - kShift), 1e-13);
  EXPECT_LT(norm(model.shift_from(kShift) - kShift), 1e-15);
}

TEST(ShiftByCurves, FollowsLinesThatCrossInOneStep)
{
  CurvesModel model;
  model.add(line_along({1.0, 0.0, 0.0}), {{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}});
  model.add(line_along({0.0, 1.0, 0.0}), {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
  EXPECT_LT(norm(model.shift_from(kShift + Vec3{0.5, 0.25, -0.5}) - kShift), 1e-14);
}

// Along one line all shifts are as good. A curve that nobody asks for does not help.
TEST(ShiftByCurves, StaysAsGivenIfADirectionIsOpen)
{
  CurvesModel model;
  const Vec3 guess = kShift + Vec3{0.5, 0.25, -0.5};
  model.add(line_along({1.0, 2.0, 3.0}), {{1.0, 2.0, 3.0}, {2.0, 4.0, 6.0}, {3.0, 6.0, 9.0}});
  model.add_chords(2, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  EXPECT_EQ(model.shift_from(guess), guess);
}

TEST(ShiftByCurves, StaysAsGivenWithoutCurvesOrChords)
{
  CurvesModel model;
  EXPECT_EQ(model.shift_from({1.0, 0.0, 0.0}), (Vec3{1.0, 0.0, 0.0}));
  model.add(onto_circle, {});
  EXPECT_EQ(model.shift_from({1.0, 0.0, 0.0}), (Vec3{1.0, 0.0, 0.0}));
}

TEST(ShiftByCurves, PassesOnWhatAProjectionThrows)
{
  CurvesModel model;
  model.add([](const Vec3&) -> Vec3 { throw GeometryError("off the curve"); },
            {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  EXPECT_THROW((void)model.shift_from(kShift), GeometryError);
}

}  // namespace
}  // namespace tessera::surface

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/canvas.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

using Triangle = std::array<Vec3, 3>;

// Looks along y: x to the right, z up.
Camera camera()
{
  return {
      .view = view_from({0.0, -1.0, 0.0}), .width = 20, .height = 20, .middle = {}, .scale = 10.0};
}

Triangle upright(double y, double shift = 0.0)
{
  return {{{-0.9 + shift, y, -0.9}, {0.9 + shift, y, -0.9}, {0.0 + shift, y, 0.9}}};
}

TEST(Canvas, ShowsWhatIsInFrontInWhateverOrderItIsDrawn)
{
  for (const bool is_far_first : {true, false}) {
    Canvas canvas(camera());
    if (is_far_first) canvas.draw(upright(0.5), 7);
    canvas.draw(upright(-0.5), 3);
    if (!is_far_first) canvas.draw(upright(0.5), 7);
    EXPECT_EQ(canvas.row(10, 12), 3);
    EXPECT_EQ(canvas.row(0, 0), kNoIndex);
  }
}

TEST(Canvas, ShowsTheLowestRowOfTrianglesAtOneDepth)
{
  for (const auto& rows : {std::array{5, 2, 9}, std::array{9, 5, 2}, std::array{2, 9, 5}}) {
    Canvas canvas(camera());
    for (const LocalIndex row : rows) canvas.draw(upright(0.0), row);
    EXPECT_EQ(canvas.row(10, 12), 2);
  }
}

TEST(Canvas, PutTogetherFromPartsIsTheWhole)
{
  Canvas whole(camera());
  std::vector<Canvas> parts(3, Canvas(camera()));
  for (int t = 0; t < 12; ++t) {
    const Triangle triangle = upright(0.1 * ((5 * t) % 12) - 0.6, 0.05 * t - 0.3);
    whole.draw(triangle, t, Sides::drawn);
    parts[static_cast<std::size_t>(t) % 3].draw(triangle, t, Sides::drawn);
  }
  Canvas merged(camera());
  merged.pixels().resize(merged.num_pixels());
  for (Canvas& part : parts) {
    std::ranges::transform(merged.pixels(), part.pixels(), merged.pixels().begin(),
                           [](auto a, auto b) { return std::max(a, b); });
  }
  EXPECT_EQ(merged.pixels(), whole.pixels());
  EXPECT_GT(std::set(whole.pixels().begin(), whole.pixels().end()).size(), 5U);
}

TEST(Canvas, KeepsLargeRowsAndShades)
{
  Canvas canvas(camera());
  const LocalIndex row = Canvas::kMostRows - 1;
  canvas.draw(upright(0.0), row);
  EXPECT_EQ(canvas.row(10, 12), row);
  EXPECT_GE(canvas.shade(10, 12), 0);
  EXPECT_LT(canvas.shade(10, 12), Canvas::kNumShades);
}

TEST(Canvas, DrawsLinesOnlyWhereTheyAreWanted)
{
  for (const Sides sides : {Sides::hidden, Sides::drawn}) {
    Canvas canvas(camera());
    canvas.draw(upright(0.0), 0, sides);
    int num_lines = 0;
    int num_pixels = 0;
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) {
        num_lines += canvas.is_side(x, y) ? 1 : 0;
        num_pixels += canvas.row(x, y) == 0 ? 1 : 0;
      }
    }
    EXPECT_EQ(num_lines > 0, sides == Sides::drawn);
    EXPECT_GT(num_pixels, 2 * num_lines);
  }
}

TEST(Canvas, LeavesOutTrianglesSeenFromTheSide)
{
  Canvas canvas(camera());
  canvas.draw({{{0.0, -1.0, -0.5}, {0.0, 1.0, -0.5}, {0.0, 0.0, 0.5}}}, 1);
  EXPECT_TRUE(canvas.pixels().empty());
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) EXPECT_EQ(canvas.row(x, y), kNoIndex);
  }
}

TEST(FitCamera, HasAllPointsWithinTheMargin)
{
  const std::vector<double> xyz{0, 0, 0, 30, 0, 0, 0, 4, 0, 0, 0, 5, 30, 4, 5};
  const Camera fitted = fit_camera(view_from({1.0, -1.7, 1.1}), xyz, {400, 300, 10});
  EXPECT_EQ(fitted.width, 400);
  EXPECT_LT(fitted.height, 300);  // The model is wide.
  EXPECT_GE(fitted.height, 100);
  for (std::size_t v = 0; v < 5; ++v) {
    const Vec3 p = fitted.on_picture(point_at(std::span<const double>(xyz), v));
    EXPECT_GE(p[0], 10.0 - 1e-9);
    EXPECT_LE(p[0], 390.0 + 1e-9);
    EXPECT_GE(p[1], 9.0);
    EXPECT_LE(p[1], fitted.height - 9.0);
  }
}

TEST(Paint, MakesBordersBlackAndTheRestColoured)
{
  Canvas canvas(camera());
  canvas.draw(upright(0.0), 0);
  const Picture with = paint(canvas, {.colours = distinct_colours()});
  const Picture without = paint(canvas, {.colours = distinct_colours(), .has_borders = false});
  constexpr std::uint8_t kBlack = 1;
  EXPECT_GT(std::ranges::count(with.pixels, kBlack), 10);
  EXPECT_EQ(std::ranges::count(without.pixels, kBlack), 0);
  EXPECT_LE(with.palette.size(), 256U);
  EXPECT_LT(*std::ranges::max_element(with.pixels), with.palette.size());
}

}  // namespace
}  // namespace tessera::pipeline

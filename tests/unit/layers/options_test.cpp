// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/layers/options.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera::layers {
namespace {

TEST(LayerOptions, EndsAreThoseOfAGeometricSeries)
{
  const LayerOptions options{.patch = "wall", .first = 0.1, .growth = 2.0, .count = 3};
  EXPECT_DOUBLE_EQ(thickness(options), 0.7);
  const std::vector<double> ends = layer_ends(options);
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_DOUBLE_EQ(ends[0], 4.0 / 7.0);  // The one at the tets is the highest.
  EXPECT_DOUBLE_EQ(ends[1], 6.0 / 7.0);
  EXPECT_EQ(ends[2], 1.0);
}

TEST(LayerOptions, AThicknessTakesTheNumberThatComesNearest)
{
  LayerOptions options{.patch = "wall", .first = 0.1, .growth = 1.0, .thickness = 0.34};
  EXPECT_EQ(num_layers(options), 3);
  options.thickness = 0.36;
  EXPECT_EQ(num_layers(options), 4);
  options.thickness = 10.0;
  EXPECT_EQ(num_layers(options), kMostLayers);
  EXPECT_EQ(defect_of(options), "");
  options.thickness = 1e9;
  EXPECT_EQ(num_layers(options), kMostLayers + 1);
  EXPECT_NE(defect_of(options).find("more than 100 layers"), std::string::npos);
}

TEST(LayerOptions, LeadUpToTheSizeInside)
{
  const LayerOptions four{.first = 0.5, .growth = 2.0, .count = 4};
  EXPECT_EQ(last_height(four), 4.0);
  LayerOptions options{.patch = "wall", .first = 0.1, .growth = 1.2};
  EXPECT_FALSE(is_complete(options));
  options.count = count_up_to(options, 1.0);
  EXPECT_EQ(options.count, 12);
  const double last = options.first * std::pow(options.growth, options.count - 1);
  EXPECT_NEAR(last * options.growth, 0.816, 0.1 * 0.816);
  EXPECT_EQ(count_up_to(options, 0.1), 1);
  options.growth = 1.001;
  EXPECT_GT(count_up_to(options, 1.0), kMostLayers);
  options.growth = 1.0;
  EXPECT_EQ(count_up_to(options, 1.0), 0);
}

TEST(LayerOptions, MustNotHaveBothCountAndThickness)
{
  EXPECT_EQ(defect_of({.patch = "a", .first = 1.0}), "");
  EXPECT_NE(defect_of({.patch = "a", .first = 1.0, .count = 2, .thickness = 3.0}), "");
  EXPECT_NE(defect_of({.patch = "a", .first = 1.0, .thickness = 0.5}), "");
  EXPECT_EQ(defect_of({.patch = "a", .first = 1.0, .count = 2}), "");
  EXPECT_EQ(defect_of({.patch = "a", .first = 1.0, .thickness = 2.0}), "");
}

}  // namespace
}  // namespace tessera::layers

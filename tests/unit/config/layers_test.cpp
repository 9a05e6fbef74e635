// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::config {
namespace {

constexpr const char* kLayer = "[[layer]]\npatch = 'wall*'\nfirst = 0.01\ncount = 5\n";

Case parsed(const std::string& lines)
{
  return parse_case("geometry.file = 'a.step'\nsize.target = 1\n" + lines, "/cases/case.toml", {});
}

std::string error_of(const std::string& lines)
{
  return testing::message_of<ConfigError>([&] { (void)parsed(lines); });
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(Layers, AreThoseOfTheCase)
{
  const Case loaded = parsed(kLayer);
  ASSERT_EQ(loaded.layers.size(), 1U);
  EXPECT_EQ(loaded.layers[0],
            (layers::LayerOptions{.patch = "wall*", .first = 0.01, .growth = 1.2, .count = 5}));
  EXPECT_EQ(parse_case(to_toml(loaded), "/cases/case.toml", {}), loaded);
}

TEST(Layers, LeadUpToTheSizeOfTheCase)
{
  EXPECT_EQ(parsed("[[layer]]\npatch = 'a'\nfirst = 0.1\n").layers[0].count, 12);
  EXPECT_TRUE(contains(error_of("[[layer]]\npatch = 'a'\nfirst = 0.1\ngrowth = 1\n"),
                       "neither count nor thickness"));
}

TEST(Splits, AreThoseOfTheCase)
{
  const Case loaded = parsed("[[split]]\npatch = 'crack*'\n");
  ASSERT_EQ(loaded.splits.patches.size(), 1U);
  EXPECT_EQ(loaded.splits.patches[0].patch, "crack*");
  EXPECT_EQ(parse_case(to_toml(loaded), "/cases/case.toml", {}), loaded);
  EXPECT_TRUE(contains(error_of("[[split]]\n"), "split.patch"));
}

TEST(Layers, RefuseWhatDoesNotGoWithThem)
{
  const std::string layer = kLayer;
  EXPECT_TRUE(contains(error_of("output.order = 2\n" + layer), "[[layer]] excludes output.order"));
  EXPECT_TRUE(contains(error_of("decompose.method = 'geometry'\n" + layer),
                       "[[layer]] excludes decompose.method"));
  EXPECT_TRUE(contains(error_of(layer + "thickness = 1\n"), "both count and thickness"));
  EXPECT_TRUE(contains(error_of("[[layer]]\npatch = 'a'\nfirst = -1\ncount = 1\n"), "layer.first"));
}

}  // namespace
}  // namespace tessera::config

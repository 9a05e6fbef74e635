// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/periodic_pairs.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::mesh {
namespace {

const Affine kTurn{{{{0.5, -std::sqrt(0.75), 0.0}, {std::sqrt(0.75), 0.5, 0.0}, {0.0, 0.0, 1.0}}},
                   {0.1, -2e-17, 3.0}};
const Affine kShift{.shift = {1.0, 0.0, 0.0}};

TEST(TransformsOf, NumbersThemAsTheyFirstCome)
{
  const std::vector<PeriodicPair> pairs{
      {"a", "b", kTurn}, {"c", "d", kTurn}, {"e", "f", kShift}, {"g", "h", {}}, {"i", "j", kShift}};
  EXPECT_EQ(transforms_of(pairs), (std::vector<LocalIndex>{0, 0, 1, 2, 1}));
  EXPECT_TRUE(transforms_of({}).empty());
}

TEST(NameOfPartners, CountsFromOne)
{
  EXPECT_EQ(name_of_partners(0), "periodic_partner_1");
  EXPECT_EQ(name_of_partners(9), "periodic_partner_10");
}

TEST(MatrixOf, HasTheShiftAsItsLastColumn)
{
  const Affine there{{{{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}}, {4.0, 5.0, 6.0}};
  EXPECT_EQ(matrix_of(there),
            (std::array<double, 12>{0.0, -1.0, 0.0, 4.0, 1.0, 0.0, 0.0, 5.0, 0.0, 0.0, 1.0, 6.0}));
}

TEST(ToTexts, ReadBackAsTheSame)
{
  const std::vector<PeriodicPair> pairs{{"left side", "", kTurn}, {"-", "\"", kShift}};
  const std::vector<std::string> texts = to_texts(pairs);
  ASSERT_EQ(texts.size(), 6U);
  EXPECT_EQ(texts[5], "1 0 0 1 0 1 0 0 0 0 1 0");
  EXPECT_EQ(periodic_pairs(texts), pairs);
  EXPECT_TRUE(periodic_pairs({}).empty());
}

TEST(PeriodicPairs, AreRefusedIfTheyAreNone)
{
  using Texts = std::vector<std::string>;
  const auto error_of = [](const Texts& texts) {
    return testing::message_of<InputError>([&] { (void)periodic_pairs(texts); });
  };
  EXPECT_NE(error_of({"a", "b"}).find("must be three a pair"), std::string::npos);
  EXPECT_NE(error_of({"a", "b", "1 0 0 1 0 1 0 0 0 0 1"}).find("3 x 4"), std::string::npos);
  EXPECT_NE(error_of({"a", "b", "1 0 0 1 0 1 0 0 0 0 1 x"}).find("3 x 4"), std::string::npos);
  EXPECT_NE(error_of({"a", "b", "1 0 0 1 0 1 0 0 0 0 1 0 7"}).find("3 x 4"), std::string::npos);
}

}  // namespace
}  // namespace tessera::mesh

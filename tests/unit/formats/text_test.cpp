// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "formats/files/text_records.hpp"
#include "formats/labels.hpp"
#include "formats/plain_name.hpp"

namespace tessera::formats {
namespace {

using Labels = std::vector<std::string>;

TEST(TextRecords, NumbersStandAtTheRight)
{
  EXPECT_EQ(TextRecords().integer(42, 5).text(",").real(-0.5, 6).take(), "   42,  -0.5");
  EXPECT_EQ(num_digits(0), 1U);
  EXPECT_EQ(num_digits(9), 1U);
  EXPECT_EQ(num_digits(10), 2U);
  EXPECT_EQ(num_digits(2147483647), 10U);
}

TEST(TextRecords, LongFieldsReadBackToTheSameBits)
{
  for (const double number :
       {1.0 / 3.0, -2.2250738585072014e-308, 1e23, 0.0, -1234567.8901234567}) {
    const std::string field = TextRecords().real(number, kRealWidth).take();
    EXPECT_EQ(field.size(), kRealWidth);
    EXPECT_EQ(std::strtod(field.c_str(), nullptr), number);
  }
}

TEST(TextRecords, ShortFieldsLoseTheLastDigitsOnly)
{
  for (const double number :
       {-1.2345678901234567e-5, -0.012345678901234567, 1.7976931348623157e308}) {
    const std::string field = TextRecords().real(number, 20).take();
    EXPECT_EQ(field.size(), 20U);
    EXPECT_NEAR(std::strtod(field.c_str(), nullptr) / number, 1.0, 1e-12);
  }
}

TEST(Labels, HaveTheCharactersOfAbaqusAndALetterFirst)
{
  EXPECT_EQ(labels_of({"steel rod", "3rd", "", "a-b_c"}, {}, 80),
            (Labels{"STEEL_ROD", "X_3RD", "X_", "A-B_C"}));
}

TEST(Labels, AreNeverTheSameNorReserved)
{
  EXPECT_EQ(labels_of({"Skin", "SKIN", "skin", "all"}, {"ALL"}, 80),
            (Labels{"SKIN", "SKIN_2", "SKIN_3", "ALL_2"}));
  const std::string name(100, 'a');
  EXPECT_EQ(labels_of({name, name}, {}, 12), (Labels{"AAAAAAAAAAAA", "AAAAAAAAAA_2"}));
}

TEST(PlainName, HasNoLineEnds) { EXPECT_EQ(plain_name("a\nb\rc"), "a_b_c"); }

}  // namespace
}  // namespace tessera::formats

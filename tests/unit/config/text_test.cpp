// SPDX-License-Identifier: BSD-3-Clause
#include "config/text.hpp"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace tessera::config {
namespace {

TEST(Text, TomlStringEscapesQuotesBackslashesAndControlCharacters)
{
  EXPECT_EQ(toml_string("a \"b\" \\ \n\x7f ü"), R"("a \"b\" \\ \u000A\u007F ü")");
}

TEST(Text, NumberTextIsAFloatAndReadsBackTheSame)
{
  EXPECT_EQ(number_text(20.0), "20.0");
  for (const double value : {0.1, 1.0 / 3.0, 1e-5, 1e30, 5e-324, 123456789.125}) {
    const std::string text = number_text(value);
    EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text;
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
  }
}

TEST(Text, PrintableHasNoControlCharacters) { EXPECT_EQ(printable("a\x1b[31m\nü"), "a?[31m?ü"); }

TEST(Text, Utf8IsToldFromOtherBytes)
{
  for (const char* valid : {"", "plain", "ü €", "\xF0\x9F\x98\x80"}) EXPECT_TRUE(is_utf8(valid));
  // Lone continuation, truncated, overlong, surrogate, beyond U+10FFFF, Latin-1.
  for (const char* invalid : {"\x80", "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80",
                              "\xF4\x90\x80\x80", "gr\xFC\xDF"}) {
    EXPECT_FALSE(is_utf8(invalid)) << printable(invalid);
  }
}

TEST(Text, TrimmedLosesBlanksAtBothEndsOnly)
{
  EXPECT_EQ(trimmed(" \t a b \r\n"), "a b");
  EXPECT_EQ(trimmed(" \n "), "");
}

}  // namespace
}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/enum_words.hpp"

#include <gtest/gtest.h>

namespace tessera {
namespace {

enum class Colour : int { red, green, blue = 7, unnamed };

// Neither the order nor the numbers of the enumeration; one value is left out.
constexpr auto enum_words(Colour /*tag*/)
{
  return std::to_array<EnumWord<Colour>>(
      {{Colour::blue, "azure"}, {Colour::red, "ruby"}, {Colour::green, "jade"}});
}

TEST(EnumWords, LeadThereAndBackWhateverTheOrder)
{
  EXPECT_EQ(word_of(Colour::red), "ruby");
  EXPECT_EQ(word_of(Colour::green), "jade");
  EXPECT_EQ(word_of(Colour::blue), "azure");
  for (const EnumWord<Colour>& entry : kEnumWords<Colour>) {
    EXPECT_EQ(value_of<Colour>(word_of(entry.value)), entry.value);
  }
}

TEST(EnumWords, AreListedInTheOrderOfTheTable)
{
  EXPECT_EQ(kWords<Colour>, (std::array<std::string_view, 3>{"azure", "ruby", "jade"}));
}

TEST(EnumWords, AStrangeWordHasNoValue)
{
  for (const char* word : {"", "rub", "ruby ", "Ruby", "red"}) {
    EXPECT_EQ(value_of<Colour>(word), std::nullopt) << word;
  }
}

TEST(EnumWords, AValueWithoutAWordIsAnError)
{
  EXPECT_THROW(static_cast<void>(word_of(Colour::unnamed)), Error);
}

TEST(EnumWords, AreKnownWhenTheProgramIsCompiled)
{
  static_assert(word_of(Colour::green) == "jade");
  static_assert(value_of<Colour>("jade") == Colour::green);
  static_assert(!EnumWithWords<int>);
}

}  // namespace
}  // namespace tessera

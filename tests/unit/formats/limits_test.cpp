// SPDX-License-Identifier: BSD-3-Clause
#include "formats/limits.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::formats {
namespace {

Outline outline_with(GlobalIndex num_tets)
{
  Outline outline;
  outline.first_cell = {0, num_tets};
  outline.first_point = {0, 5};
  return outline;
}

TEST(Limits, AMeshThatFitsPasses)
{
  EXPECT_NO_THROW(require_32_bit_numbers(outline_with(2147483647), io::Format::medit));
}

TEST(Limits, ALargerOneIsRefusedWithNumbersAndAFormatThatHoldsIt)
{
  try {
    require_32_bit_numbers(outline_with(2147483648), io::Format::abaqus);
    FAIL() << "it passed";
  } catch (const ConfigError& error) {
    const std::string message = error.what();
    for (const char* const word : {"2147483648", "2147483647", "abaqus", "xdmf"})
      EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace tessera::formats

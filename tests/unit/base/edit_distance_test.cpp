// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/edit_distance.hpp"

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements)
{
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("max_size", "max_size"), 0U);
  EXPECT_EQ(edit_distance("max_sise", "max_size"), 1U);
  EXPECT_EQ(edit_distance("maxsize", "max_size"), 1U);
  EXPECT_EQ(edit_distance("level", "levels"), edit_distance("levels", "level"));
}

}  // namespace
}  // namespace tessera

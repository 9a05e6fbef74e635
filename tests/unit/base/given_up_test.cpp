// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/given_up.hpp"

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

TEST(GivenUp, IsALineOfTheLogWithWhatAndWhy)
{
  ::testing::internal::CaptureStderr();
  note_given_up("better shapes", GeometryError("no point of curve 3 is found"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "given up: better shapes: no point of curve 3 is found\n");
}

}  // namespace
}  // namespace tessera

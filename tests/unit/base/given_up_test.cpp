// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/given_up.hpp"

#include <optional>

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

TEST(Attempts, SayOnceHowOftenAndWhyAtFirst)
{
  ::testing::internal::CaptureStderr();
  {
    Attempts places("places of edges");
    EXPECT_EQ(places.run<GeometryError>([] { return 3; }), 3);
    for (const char* const why : {"no point of curve 3", "no point of curve 4"}) {
      const auto fails = [&]() -> int { throw GeometryError(why); };
      EXPECT_EQ(places.run<GeometryError>(fails), std::nullopt);
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "given up 2 times: places of edges: no point of curve 3\n");
}

TEST(Attempts, SayNothingIfAllIsWell)
{
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(Attempts("places").run<GeometryError>([] { return 3; }), 3);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Attempts, LetOtherErrorsPass)
{
  Attempts places("places");
  const auto fails = []() -> int { throw MeshError("a hole"); };
  EXPECT_THROW(static_cast<void>(places.run<GeometryError>(fails)), MeshError);
}

}  // namespace
}  // namespace tessera

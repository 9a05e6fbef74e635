// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/jobs/run_program.hpp"

#include <gtest/gtest.h>

namespace tessera::jobs {
namespace {

TEST(RunProgram, KnowsWhatIsOnThePath)
{
  EXPECT_TRUE(is_on_path("sh"));
  EXPECT_FALSE(is_on_path("no-program-has-this-name"));
}

}  // namespace
}  // namespace tessera::jobs

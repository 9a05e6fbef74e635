// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/mpi_version.hpp"

#include <algorithm>
#include <cctype>

#include <gtest/gtest.h>

namespace tessera::comm {
namespace {

// Nobody has called MPI_Init here.
TEST(MpiVersion, IsANameAndANumber)
{
  const std::string version = mpi_version();
  EXPECT_TRUE(version.starts_with("Open MPI ") || version.starts_with("MPICH")) << version;
  EXPECT_TRUE(std::ranges::any_of(version, [](unsigned char c) { return std::isdigit(c) != 0; }));
  EXPECT_EQ(version.find_first_of(",\n"), std::string::npos) << version;
  EXPECT_EQ(version.find(" v"), std::string::npos) << version;
}

}  // namespace
}  // namespace tessera::comm

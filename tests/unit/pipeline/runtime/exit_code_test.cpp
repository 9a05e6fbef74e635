// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/exit_code.hpp"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::pipeline {
namespace {

TEST(ExitCode, NumbersAreThoseThatScriptsRelyOn)
{
  EXPECT_EQ(static_cast<int>(ExitCode::ok), 0);
  EXPECT_EQ(static_cast<int>(ExitCode::failed), 2);
  EXPECT_EQ(static_cast<int>(ExitCode::degraded), 3);
  EXPECT_EQ(static_cast<int>(ExitCode::wrong_input), 64);
  EXPECT_EQ(static_cast<int>(ExitCode::internal), 70);
  EXPECT_EQ(static_cast<int>(ExitCode::cannot_write), 73);
  EXPECT_EQ(static_cast<int>(ExitCode::stopped), 75);
}

TEST(ExitCode, EveryErrorHasOne)
{
  EXPECT_EQ(exit_code_of(ConfigError("")), ExitCode::wrong_input);
  EXPECT_EQ(exit_code_of(InputError("")), ExitCode::wrong_input);
  EXPECT_EQ(exit_code_of(GeometryError("")), ExitCode::wrong_input);
  EXPECT_EQ(exit_code_of(MeshError("")), ExitCode::failed);
  EXPECT_EQ(exit_code_of(NetgenError("")), ExitCode::failed);
  EXPECT_EQ(exit_code_of(OutputError("")), ExitCode::cannot_write);
  EXPECT_EQ(exit_code_of(Interrupted("")), ExitCode::stopped);
  EXPECT_EQ(exit_code_of(Error("")), ExitCode::internal);
  EXPECT_EQ(exit_code_of(std::logic_error("")), ExitCode::internal);
  EXPECT_EQ(exit_code_of(std::bad_alloc()), ExitCode::internal);
  EXPECT_EQ(exit_code_of(comm::Collective<NetgenError>("")), ExitCode::failed);
}

// Folders are made by the standard library, which says in its own way that the disk is full.
TEST(ExitCode, AFolderThatCannotBeMadeIsNoDefectOfTheProgram)
{
  const auto no_space = std::make_error_code(std::errc::no_space_on_device);
  EXPECT_EQ(exit_code_of(std::filesystem::filesystem_error("cannot create", "out", no_space)),
            ExitCode::cannot_write);
}

}  // namespace
}  // namespace tessera::pipeline

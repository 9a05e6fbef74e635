// SPDX-License-Identifier: BSD-3-Clause
// make_mesh() several times, in groups of ranks, and with everything that can go wrong at the door.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/tessera.hpp"

#include "support/mpi_tests.hpp"
#include "support/shared_folder.hpp"

#include "mpi/front_door/session_main.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;

class Door : public ::testing::Test {
 protected:
  // Eight subdomains of a brick, in a tenth of a second.
  [[nodiscard]] config::Case brick(const std::string& folder) const
  {
    config::Case brick;
    brick.geometry.file = fs::path(TESSERA_GEOMETRY_DIR) / "brick.geo";
    brick.coarse.max_size = 0.5;
    brick.decompose.subdomains = 8;
    brick.refine.levels = 1;
    brick.fill.kernel = fill::KernelKind::subdivide;
    brick.output.directory = folder_ / folder;
    brick.output.report_html = false;  // Half of the time.
    return brick;
  }

  // Ranks that are alike in `colour`, in their order or the other way round.
  [[nodiscard]] comm::Communicator group(int colour, bool is_turned) const
  {
    MPI_Comm handle = MPI_COMM_NULL;
    MPI_Comm_split(comm_.handle(), colour, is_turned ? -comm_.rank() : comm_.rank(), &handle);
    comm::Communicator ranks(handle);
    MPI_Comm_free(&handle);
    return ranks;
  }

  // Class and text of what the call throws; the digest if it returns. The same on all ranks.
  [[nodiscard]] std::string outcome(const config::Case& given, const comm::Communicator& ranks,
                                    const MeshOptions& options = {}) const
  {
    std::string said;
    try {
      said = make_mesh(given, ranks, options).digest;
    } catch (const std::exception& error) {
      EXPECT_NE(dynamic_cast<const comm::ThrownOnAllRanks*>(&error), nullptr);
      said = std::string(typeid(error).name()) + ": " + error.what();
    }
    for (const std::string& other : ranks.all_gather_values(said)) EXPECT_EQ(other, said);
    return said;
  }

  template <class E>
  [[nodiscard]] static std::string name_of()
  {
    return typeid(comm::Collective<E>).name();
  }

  comm::Communicator comm_ = testing::session_of_this_process().world();
  testing::SharedFolder folder_{comm_};
};

// With six ranks each half shares one model zygote a node, and they do so at the same time.
TEST_F(Door, TwoCommunicatorsAtOnceGiveTheSameBitsAsOne)
{
  const std::string whole = outcome(brick("whole"), comm_);
  EXPECT_EQ(whole.size(), 32U) << whole;
  for (const int way : {0, 1}) {
    const int colour = way == 0 ? comm_.rank() % 2 : 2 * comm_.rank() / comm_.size();
    const comm::Communicator half = group(colour, way == 1);
    for (const char* const time : {"first", "second"}) {
      const std::string folder = time + std::to_string(10 * way + colour);
      EXPECT_EQ(outcome(brick(folder), half), whole);
    }
  }
  EXPECT_EQ(outcome(brick("again"), comm_), whole);
}

TEST_F(Door, TwoCommunicatorsAtOnceDoNotShareAFolder)
{
  const comm::Communicator half = group(comm_.rank() % 2, false);
  MeshOptions options;
  options.existing = io::ExistingFolder::overwrite;
  const std::string said = outcome(brick("shared"), half, options);
  const bool is_made = said.size() == 32;
  EXPECT_GT(comm_.sum(is_made ? 1 : 0), 0);
  if (!is_made) {
    EXPECT_EQ(said.find(name_of<OutputError>()), 0U) << said;
    EXPECT_NE(said.find("is in use by"), std::string::npos) << said;
  }
  EXPECT_GT(read_mesh(folder_ / "shared", comm_).num_global_tets, 0);
}

TEST_F(Door, AnErrorInOneCommunicatorLeavesTheOtherAlone)
{
  const std::string whole = outcome(brick("whole"), comm_);
  const bool is_failing = comm_.rank() % 2 == 1;
  MeshOptions options;
  options.on_piece = [&](const MeshPiece&) {
    if (is_failing) throw std::logic_error("of the program");
  };
  const std::string said =
      outcome(brick(is_failing ? "failing" : "working"), group(is_failing ? 1 : 0, false), options);
  if (is_failing) {
    EXPECT_EQ(said.find(name_of<OutputError>()), 0U) << said;
  } else {
    EXPECT_EQ(said, whole);
  }
  EXPECT_EQ(outcome(brick("again"), comm_), whole);
}

TEST_F(Door, EveryErrorIsThrownOnAllRanksAndTheNextCallWorks)
{
  if (comm_.rank() == 0) {
    std::ofstream(folder_ / "open.stl")
        << "solid open\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
           "vertex 0 1 0\nendloop\nendfacet\nendsolid open\n";
    std::ofstream(folder_ / "a file");
  }
  comm_.barrier();
  config::Case given = brick("errors");
  const std::string made = outcome(given, comm_);
  const MeshOptions anew{.existing = io::ExistingFolder::overwrite};
  const auto expect = [&](const std::string& name,
                          const std::function<void(config::Case&)>& spoil) {
    config::Case spoilt = given;
    spoil(spoilt);
    const std::string said = outcome(spoilt, comm_, anew);
    EXPECT_EQ(said.find(name), 0U) << said;
    EXPECT_EQ(outcome(given, comm_, anew), made);
  };
  expect(name_of<ConfigError>(), [](config::Case& c) { c.decompose.subdomains = -3; });
  expect(name_of<InputError>(), [&](config::Case& c) { c.geometry.file = folder_ / "lost.geo"; });
  expect(name_of<GeometryError>(),
         [&](config::Case& c) { c.geometry.file = folder_ / "open.stl"; });
  expect(name_of<OutputError>(),
         [&](config::Case& c) { c.output.directory = folder_ / "a file/out"; });
}

TEST_F(Door, AnyOneRankThatThrowsInOnPieceEndsTheRunOnAllRanks)
{
  constexpr int kTries = 20;  // Which rank gets a piece is not determined.
  for (const Rank thrower : {0, comm_.size() - 1}) {
    bool has_thrown = false;
    for (int i = 0; i < kTries && !has_thrown; ++i) {
      bool had_piece = false;
      const std::string said =
          outcome(brick("thrown"), comm_,
                  {.existing = io::ExistingFolder::overwrite, .on_piece = [&](const MeshPiece&) {
                     had_piece = comm_.rank() == thrower;
                     if (had_piece) throw std::logic_error("of the program");
                   }});
      has_thrown = comm_.sum(had_piece ? 1 : 0) > 0;
      const std::string expected = "on_piece has failed on rank " + std::to_string(thrower);
      EXPECT_EQ(said.find(expected) != std::string::npos, has_thrown) << said;
      if (has_thrown) {
        EXPECT_EQ(said.find(name_of<OutputError>()), 0U) << said;
        EXPECT_NE(said.find("of the program"), std::string::npos) << said;
      }
    }
    EXPECT_TRUE(has_thrown) << thrower;
  }
}

TEST_F(Door, OnPieceCannotCallMakeMesh)
{
  const comm::Communicator alone(MPI_COMM_SELF);
  const std::string said = outcome(brick("outer"), comm_, {.on_piece = [&](const MeshPiece&) {
                                     static_cast<void>(make_mesh(brick("inner"), alone));
                                   }});
  EXPECT_EQ(said.find(name_of<OutputError>()), 0U) << said;
  EXPECT_NE(said.find("is running in this process already"), std::string::npos) << said;
  EXPECT_FALSE(fs::exists(folder_ / "inner"));
  EXPECT_EQ(outcome(brick("outer"), comm_, {.existing = io::ExistingFolder::overwrite}).size(),
            32U);
}

TEST_F(Door, ARankThatNeverCallsIsNamedAndNothingIsBegun)
{
  if (comm_.size() == 1) GTEST_SKIP() << "nobody to wait for";
  const Rank absent = comm_.size() / 2;
  const std::string named = "rank " + std::to_string(absent) + " of ";
  const comm::Communicator ranks(comm_.handle());
  if (comm_.rank() != absent) {
    try {
      static_cast<void>(make_mesh(brick("absent"), ranks, {.rank_timeout_s = 0.5}));
      ADD_FAILURE() << "made a mesh";
    } catch (const UsageError& error) {
      EXPECT_EQ(std::string(error.what()).find("make_mesh(): " + named), 0U) << error.what();
    }
  }
  comm_.quiet_barrier();
  if (comm_.rank() == absent) {
    EXPECT_THROW(static_cast<void>(make_mesh(brick("absent"), ranks)), UsageError);
  }
  EXPECT_FALSE(fs::exists(folder_ / "absent"));
  EXPECT_EQ(outcome(brick("after"), comm_).size(), 32U);
}

}  // namespace
}  // namespace tessera

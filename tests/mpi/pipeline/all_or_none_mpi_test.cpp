// SPDX-License-Identifier: BSD-3-Clause
#include <new>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {
namespace {

// Type and text of what `work` throws; empty if it returns.
template <class Work>
std::string thrown_by(const Work& work)
{
  try {
    work();
  } catch (const std::exception& error) {
    const bool on_all = dynamic_cast<const comm::ThrownOnAllRanks*>(&error) != nullptr;
    return std::string(on_all ? "all: " : "one: ") + typeid(error).name() + ": " + error.what();
  }
  return "";
}

template <class Kind>
std::string collective(const std::string& text)
{
  return std::string("all: ") + typeid(comm::Collective<Kind>).name() + ": " + text;
}

struct AllOrNone : ::testing::Test {
  const comm::Communicator comm{MPI_COMM_WORLD};

  // What this rank sees if `thrower` throws a Thrown and nobody else anything.
  template <class Thrown>
  [[nodiscard]] std::string seen_if(Rank thrower, const std::string& text) const
  {
    return thrown_by([&] {
      all_or_none(comm, [&] {
        if (comm.rank() == thrower) throw Thrown(text);
      });
    });
  }
};

TEST_F(AllOrNone, NobodyThrowsIfNobodyFails)
{
  int done = 0;
  EXPECT_EQ(thrown_by([&] { all_or_none(comm, [&] { ++done; }); }), "");
  EXPECT_EQ(done, 1);
}

TEST_F(AllOrNone, AllThrowTheSameTypeAndTextIfOneFails)
{
  const std::string text = "file.geo: line 3,\n  no solid  ";
  for (Rank rank = 0; rank < comm.size(); ++rank) {
    EXPECT_EQ(seen_if<ConfigError>(rank, text), collective<InputError>(text));
    EXPECT_EQ(seen_if<InputError>(rank, text), collective<InputError>(text));
    EXPECT_EQ(seen_if<GeometryError>(rank, text), collective<InputError>(text));
    EXPECT_EQ(seen_if<MeshError>(rank, text), collective<MeshError>(text));
    EXPECT_EQ(seen_if<NetgenError>(rank, text), collective<MeshError>(text));
    EXPECT_EQ(seen_if<OutputError>(rank, text), collective<OutputError>(text));
    EXPECT_EQ(seen_if<Interrupted>(rank, text), collective<Interrupted>(text));
    EXPECT_EQ(seen_if<std::logic_error>(rank, text), collective<Error>(text));
  }
}

TEST_F(AllOrNone, AnErrorWithoutTextIsAnErrorToo)
{
  EXPECT_EQ(seen_if<MeshError>(comm.size() - 1, ""), collective<MeshError>(""));
}

TEST_F(AllOrNone, TheLowestRankSpeaksForAll)
{
  const Rank first = comm.size() / 2;
  const std::string seen = thrown_by([&] {
    all_or_none(comm, [&] {
      if (comm.rank() == first) throw OutputError("disk full");
      if (comm.rank() > first) throw MeshError("rank " + std::to_string(comm.rank()));
    });
  });
  EXPECT_EQ(seen, collective<OutputError>("disk full"));
}

TEST_F(AllOrNone, WhatAllRanksThrowPassesAsItIs)
{
  const std::string seen = thrown_by(
      [&] { all_or_none(comm, [] { throw comm::Collective<GeometryError>("open edge"); }); });
  EXPECT_EQ(seen, collective<GeometryError>("open edge"));
}

TEST_F(AllOrNone, MayBeCalledAgainAfterAnError)
{
  for (int round = 0; round < 20; ++round) {
    EXPECT_EQ(seen_if<MeshError>(round % comm.size(), "bad"), collective<MeshError>("bad"));
    EXPECT_EQ(thrown_by([&] { all_or_none(comm, [] {}); }), "");
  }
}

struct OnRoot : AllOrNone {};

TEST_F(OnRoot, GivesAllRanksTheBytesOfRankZero)
{
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100'000}}) {
    int calls = 0;
    const Bytes got = on_root(comm, [&] {
      ++calls;
      return Bytes(size, std::byte{7});
    });
    EXPECT_EQ(got, Bytes(size, std::byte{7}));
    EXPECT_EQ(calls, comm.rank() == 0 ? 1 : 0);
  }
}

TEST_F(OnRoot, AnErrorOfRankZeroIsOneEverywhere)
{
  const std::string seen = thrown_by(
      [&] { static_cast<void>(on_root(comm, [&]() -> Bytes { throw NetgenError("gave up"); })); });
  EXPECT_EQ(seen, collective<MeshError>("gave up"));
  EXPECT_EQ(on_root(comm, [] { return Bytes(3); }), Bytes(3));
}

}  // namespace
}  // namespace tessera::pipeline

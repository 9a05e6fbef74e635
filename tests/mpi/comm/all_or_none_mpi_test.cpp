// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <typeinfo>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

namespace tessera::comm {
namespace {

// Type and text of what `work` throws; empty if it returns.
template <class Work>
std::string thrown_by(const Work& work)
{
  try {
    work();
  } catch (const std::exception& error) {
    const bool on_all = dynamic_cast<const ThrownOnAllRanks*>(&error) != nullptr;
    return std::string(on_all ? "all: " : "one: ") + typeid(error).name() + ": " + error.what();
  }
  return "";
}

template <class Kind>
std::string collective(const std::string& text)
{
  return std::string("all: ") + typeid(Collective<Kind>).name() + ": " + text;
}

struct AllOrNone : ::testing::Test {
  const Communicator comm{MPI_COMM_WORLD};

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

  template <class Thrown>
  void expect_kept(const std::string& text) const
  {
    for (Rank rank = 0; rank < comm.size(); ++rank) {
      EXPECT_EQ(seen_if<Thrown>(rank, text), collective<Thrown>(text));
    }
  }

  void expect_every_class_kept(const std::string& text) const
  {
    expect_kept<Error>(text);
    expect_kept<ConfigError>(text);
    expect_kept<InputError>(text);
    expect_kept<GeometryError>(text);
    expect_kept<MeshError>(text);
    expect_kept<NetgenError>(text);
    expect_kept<OutputError>(text);
    expect_kept<Interrupted>(text);
  }
};

TEST_F(AllOrNone, NobodyThrowsIfNobodyFails)
{
  int done = 0;
  EXPECT_EQ(thrown_by([&] { all_or_none(comm, [&] { ++done; }); }), "");
  EXPECT_EQ(done, 1);
}

TEST_F(AllOrNone, AllThrowTheSameClassAndTextIfOneFails)
{
  expect_every_class_kept("file.geo: line 3,\n  no solid  ");
}

TEST_F(AllOrNone, AnErrorWithoutTextIsAnErrorToo) { expect_every_class_kept(""); }

TEST_F(AllOrNone, TextThatLooksLikeANumberIsText)
{
  expect_every_class_kept("64 tets are folded");
  expect_every_class_kept("99999999999999999999");
  expect_every_class_kept(" 7");
}

TEST_F(AllOrNone, LongTextArrivesWhole)
{
  expect_kept<MeshError>(std::string(100'000, 'x') + "\xC3\xA4\n");
}

TEST_F(AllOrNone, ExceptionsOfOthersAreErrorsOfUnknownKind)
{
  const Rank last = comm.size() - 1;
  EXPECT_EQ(seen_if<std::logic_error>(last, "no index"), collective<Error>("no index"));
  const std::string no_memory = thrown_by([&] {
    all_or_none(comm, [&] {
      if (comm.rank() == last) throw std::bad_alloc();
    });
  });
  EXPECT_EQ(no_memory, collective<Error>(std::bad_alloc().what()));
}

TEST_F(AllOrNone, AFolderThatCannotBeMadeIsAnOutputError)
{
  const auto no_space = std::make_error_code(std::errc::no_space_on_device);
  const std::filesystem::filesystem_error error("cannot create", "out", no_space);
  const std::string seen = thrown_by([&] {
    all_or_none(comm, [&] {
      if (comm.rank() == 0) throw error;
    });
  });
  EXPECT_EQ(seen, collective<OutputError>(error.what()));
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
  const std::string seen =
      thrown_by([&] { all_or_none(comm, [] { throw Collective<GeometryError>("open edge"); }); });
  EXPECT_EQ(seen, collective<GeometryError>("open edge"));
}

TEST_F(AllOrNone, AnErrorOfAnInnerCallIsThatOfTheOuterOne)
{
  for (Rank thrower = 0; thrower < comm.size(); ++thrower) {
    int behind_inner = 0;
    const std::string seen = thrown_by([&] {
      all_or_none(comm, [&] {
        all_or_none(comm, [&] {
          if (comm.rank() == thrower) throw ConfigError("no such key");
        });
        ++behind_inner;
      });
    });
    EXPECT_EQ(seen, collective<ConfigError>("no such key"));
    EXPECT_EQ(behind_inner, 0);
  }
}

TEST_F(AllOrNone, AnErrorBehindAnInnerCallReachesAll)
{
  const std::string seen = thrown_by([&] {
    all_or_none(comm, [&] {
      all_or_none(comm, [] {});
      if (comm.rank() == comm.size() - 1) throw NetgenError("gave up");
    });
  });
  EXPECT_EQ(seen, collective<NetgenError>("gave up"));
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
  EXPECT_EQ(seen, collective<NetgenError>("gave up"));
  EXPECT_EQ(on_root(comm, [] { return Bytes(3); }), Bytes(3));
}

TEST_F(OnRoot, FindTellsNoBytesFromNothing)
{
  EXPECT_EQ(on_root(comm, [] { return std::optional(Bytes(5, std::byte{1})); }),
            Bytes(5, std::byte{1}));
  EXPECT_EQ(on_root(comm, [] { return std::optional(Bytes()); }), Bytes());
  EXPECT_EQ(on_root(comm, [] { return std::optional<Bytes>(); }), std::nullopt);
}

TEST_F(OnRoot, FindThrowsTheErrorOfRankZeroEverywhere)
{
  const std::string seen = thrown_by([&] {
    static_cast<void>(
        on_root(comm, [&]() -> std::optional<Bytes> { throw InputError("is damaged"); }));
  });
  EXPECT_EQ(seen, collective<InputError>("is damaged"));
}

}  // namespace
}  // namespace tessera::comm

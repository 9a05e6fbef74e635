// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/record_log.hpp"

#include <array>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/io/record_store.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::io {
namespace {

using testing::FullDisk;
using testing::message_of;
using testing::TemporaryFolder;

[[nodiscard]] Bytes bytes_of(std::size_t size, int first)
{
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<std::byte>((i + static_cast<std::size_t>(first)) * 31 % 251);
  }
  return bytes;
}

// Two records in the file of one writer.
struct RecordLog : ::testing::Test {
  const TemporaryFolder folder{};
  const std::array<Bytes, 3> first{bytes_of(20, 1), Bytes{}, bytes_of(70'000, 2)};
  const std::array<Bytes, 1> second{bytes_of(30, 3)};
  std::vector<LogPlace> places{};

  RecordLog()
  {
    LogWriter writer(folder.path(), 4);
    places.push_back(writer.append({7, 100}, first));
    places.push_back(writer.append({8, 200}, second));
  }

  [[nodiscard]] std::filesystem::path file() const
  {
    return std::filesystem::directory_iterator(folder.path())->path();
  }

  [[nodiscard]] std::size_t num_found() const
  {
    return LogReader(folder.path()).find_places(4).size();
  }
};

TEST_F(RecordLog, GivesBackEverySegment)
{
  const LogReader reader(folder.path());
  for (LocalIndex i = 0; i < 3; ++i) EXPECT_EQ(reader.segment(places[0], i), first[at(i)]);
  EXPECT_EQ(reader.segment(places[1], 0), second[0]);
  EXPECT_THROW(static_cast<void>(reader.segment(places[1], 1)), InputError);
}

TEST_F(RecordLog, IsOneFileThatOthersFind)
{
  EXPECT_EQ(folder.num_entries(), 1U);
  const LogReader reader(folder.path());
  EXPECT_EQ(reader.files(), std::vector<LocalIndex>{4});
  const std::vector<LogPlace> found = reader.find_places(4);
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(to_bytes(found[i]), to_bytes(places[i]));
}

TEST_F(RecordLog, EveryFlippedBitIsNoticed)
{
  const std::string good = testing::file_bytes(file());
  const std::size_t begin_of_second = places[1].offset;
  const LogReader reader(folder.path());
  for (std::size_t bit = 8 * begin_of_second; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    testing::write_bytes(file(), bad);
    EXPECT_NO_THROW(static_cast<void>(reader.segment(places[0], 2)));
    EXPECT_EQ(num_found(), 1U) << "bit " << bit;
    if (bit / 8 < begin_of_second + 40) continue;  // Who has the place needs no name.
    const std::string message =
        message_of<InputError>([&] { static_cast<void>(reader.segment(places[1], 0)); });
    EXPECT_NE(message.find("log_000004"), std::string::npos) << "bit " << bit;
  }
}

TEST_F(RecordLog, WhatADeadWriterHasLeftIsFoundUpToTheTear)
{
  const std::string good = testing::file_bytes(file());
  for (const std::size_t size : {good.size() - 1, static_cast<std::size_t>(places[1].offset) + 10,
                                 static_cast<std::size_t>(places[1].offset)}) {
    testing::write_bytes(file(), good.substr(0, size));
    EXPECT_EQ(num_found(), 1U) << size;
  }
  testing::write_bytes(file(), good.substr(0, 40));
  EXPECT_EQ(num_found(), 0U);
  testing::write_bytes(file(), "");
  EXPECT_EQ(num_found(), 0U);
}

TEST_F(RecordLog, AMissingFileIsNamed)
{
  std::filesystem::remove(file());
  const LogReader reader(folder.path());
  EXPECT_NE(message_of<InputError>([&] {
              static_cast<void>(reader.segment(places[0], 0));
            }).find("log_000004"),
            std::string::npos);
}

TEST_F(RecordLog, AFullDiskIsAnOutputErrorThatLeavesTheRecordsBefore)
{
  LogWriter writer(folder.path(), 5);
  const LogPlace place = writer.append({1, 2}, second);
  {
    const FullDisk full_disk(5000);
    EXPECT_THROW(static_cast<void>(writer.append({1, 3}, first)), OutputError);
  }
  const LogReader reader(folder.path());
  EXPECT_EQ(reader.segment(place, 0), second[0]);
  EXPECT_EQ(reader.find_places(5).size(), 1U);
}

TEST_F(RecordLog, FollowsNoSymbolicLink)
{
  const TemporaryFolder other;
  std::filesystem::create_symlink(file(), other / "log_000000.record");
  EXPECT_TRUE(LogReader(other.path()).files().empty());
  const std::string before = testing::file_bytes(file());
  LogWriter writer(other.path(), 0);
  const LogPlace place = writer.append({1, 2}, second);
  EXPECT_EQ(testing::file_bytes(file()), before);
  EXPECT_EQ(LogReader(other.path()).segment(place, 0), second[0]);
}

TEST_F(RecordLog, GoesWithTheOtherRecordsOfTheFolder)
{
  testing::write_bytes(folder / "log_notes.txt", "mine");
  testing::write_bytes(folder / "log_000007.record", "not whole");
  EXPECT_EQ(LogReader(folder.path()).files(), (std::vector<LocalIndex>{4, 7}));
  remove_logs(folder.path());
  EXPECT_TRUE(LogReader(folder.path()).files().empty());
  EXPECT_EQ(folder.num_entries(), 1U);
  LogWriter writer(folder.path(), 0);
  static_cast<void>(writer.append({1, 2}, second));
  RecordStore(folder.path()).remove_all();
  EXPECT_EQ(file().filename(), "log_notes.txt");
}

}  // namespace
}  // namespace tessera::io

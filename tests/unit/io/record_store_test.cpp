// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/record_store.hpp"

#include <array>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::io {
namespace {

using testing::FullDisk;
using testing::message_of;
using testing::TemporaryFolder;

[[nodiscard]] Bytes record_of(std::size_t size)
{
  Bytes record(size);
  for (std::size_t i = 0; i < size; ++i) record[i] = static_cast<std::byte>(i * 31 % 251);
  return record;
}

[[nodiscard]] std::filesystem::path only_file(const std::filesystem::path& folder)
{
  return std::filesystem::directory_iterator(folder)->path();
}

TEST(RecordStore, GivesBackWhatWasPutAlsoThroughAnotherObject)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "run 1/pieces");
  store.put("piece_0", Bytes{});
  store.put("piece_17", record_of(100'000));
  const RecordStore same(folder / "run 1/pieces");
  EXPECT_EQ(same.get("piece_0"), Bytes{});
  EXPECT_EQ(same.get("piece_17"), record_of(100'000));
  EXPECT_TRUE(same.contains("piece_17"));
  EXPECT_FALSE(same.contains("piece_1"));
}

TEST(RecordStore, AFileSystemThatFailsIsNoDamage)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  // It opens, and cannot be read.
  std::filesystem::create_directory(folder / "pieces/piece_4.record");
  const auto get = [&] { static_cast<void>(store.get("piece_4")); };
  EXPECT_EQ(message_of<OutputError>(get),
            "cannot read back " + (folder / "pieces/piece_4.record").string() + ": Is a directory");
}

TEST(RecordStore, GivesBackEverySegment)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  const std::array<Bytes, 3> segments{record_of(20), Bytes{}, record_of(70'000)};
  store.put("piece_4", segments);
  const RecordReader reader(folder / "pieces");
  EXPECT_EQ(reader.num_segments("piece_4"), 3);
  for (LocalIndex i = 0; i < 3; ++i) {
    EXPECT_EQ(store.get("piece_4", i), segments[at(i)]);
    EXPECT_EQ(reader.segment("piece_4", i), segments[at(i)]);
  }
  EXPECT_EQ(store.find("piece_4"), segments[0]);
  EXPECT_THROW(static_cast<void>(store.get("piece_4", 3)), InputError);
  EXPECT_THROW(static_cast<void>(reader.num_segments("piece_5")), InputError);
}

TEST(RecordStore, FindsNoRecordWithADamagedSegment)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  store.put("piece_4", std::array<Bytes, 2>{record_of(20), record_of(30)});
  std::string bytes = testing::file_bytes(only_file(folder / "pieces"));
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  testing::write_bytes(only_file(folder / "pieces"), bytes);
  EXPECT_EQ(store.get("piece_4", 0), record_of(20)) << "This one is sound.";
  EXPECT_THROW(static_cast<void>(store.get("piece_4", 1)), InputError);
  EXPECT_EQ(store.find("piece_4"), std::nullopt);
}

TEST(RecordStore, ASecondPutReplacesTheFirst)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  store.put("piece_3", record_of(1000));
  store.put("piece_3", record_of(10));
  EXPECT_EQ(store.get("piece_3"), record_of(10));
}

TEST(RecordStore, EveryFlippedBitIsNoticed)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  store.put("piece_5", record_of(30));
  const std::string good = testing::file_bytes(only_file(folder / "pieces"));
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    testing::write_bytes(only_file(folder / "pieces"), bad);
    const std::string message = message_of<InputError>([&] { (void)store.get("piece_5"); });
    EXPECT_NE(message.find(only_file(folder / "pieces").string()), std::string::npos)
        << "bit " << bit;
  }
}

TEST(RecordStore, EveryOtherLengthIsNoticed)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  store.put("piece_5", record_of(30));
  const std::string good = testing::file_bytes(only_file(folder / "pieces"));
  for (std::size_t size = 0; size < good.size(); ++size) {
    testing::write_bytes(only_file(folder / "pieces"), good.substr(0, size));
    EXPECT_THROW((void)store.get("piece_5"), InputError) << size;
  }
  testing::write_bytes(only_file(folder / "pieces"), good + "x");
  EXPECT_THROW((void)store.get("piece_5"), InputError);
}

TEST(RecordStore, ARecordUnderTheNameOfAnotherPieceIsNoticed)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  store.put("piece_5", record_of(30));
  const std::filesystem::path fifth = only_file(folder / "pieces");
  store.put("piece_6", record_of(30));
  for (const auto& entry : std::filesystem::directory_iterator(folder / "pieces")) {
    if (entry.path() != fifth) std::filesystem::rename(fifth, entry.path());
  }
  EXPECT_THROW((void)store.get("piece_6"), InputError);
}

TEST(RecordStore, AMissingRecordIsNamed)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  const std::string message = message_of<InputError>([&] { (void)store.get("piece_123"); });
  EXPECT_NE(message.find("piece_123"), std::string::npos) << message;
}

TEST(RecordStore, AFullDiskIsAnOutputErrorAndLeavesNothingNew)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  store.put("piece_1", record_of(100));
  {
    const FullDisk full_disk(5000);
    EXPECT_THROW(store.put("piece_1", record_of(100'000)), OutputError);
    EXPECT_THROW(store.put("piece_2", record_of(100'000)), OutputError);
  }
  EXPECT_EQ(store.get("piece_1"), record_of(100));
  EXPECT_FALSE(store.contains("piece_2"));
  EXPECT_EQ(testing::file_bytes(only_file(folder / "pieces")).size(), 164U);
}

TEST(RecordStore, FollowsNoSymbolicLink)
{
  const TemporaryFolder folder;
  const RecordStore elsewhere(folder / "elsewhere");
  elsewhere.put("piece_1", record_of(100));
  const RecordStore store(folder / "pieces");
  std::filesystem::create_symlink(only_file(folder / "elsewhere"),
                                  folder / "pieces/piece_1.record");
  EXPECT_FALSE(store.contains("piece_1"));
  store.put("piece_1", record_of(10));
  EXPECT_EQ(store.get("piece_1"), record_of(10));
  EXPECT_EQ(elsewhere.get("piece_1"), record_of(100));

  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "link");
  EXPECT_THROW(RecordStore(folder / "link"), OutputError);
}

TEST(RecordStore, RemovesRecordsAndLeavesForeignFilesAlone)
{
  const TemporaryFolder folder;
  const RecordStore store(folder / "pieces");
  for (const char* name : {"piece_0", "piece_1", "piece_2"}) store.put(name, record_of(10));
  store.remove("piece_1");
  store.remove("piece_1");
  EXPECT_FALSE(store.contains("piece_1"));
  EXPECT_TRUE(store.contains("piece_2"));

  testing::write_bytes(folder / "pieces/piece_000009.record.tmp-77-0", "left by a dead process");
  testing::write_bytes(folder / "pieces/notes.txt", "mine");
  store.remove_all();
  EXPECT_EQ(only_file(folder / "pieces").filename(), "notes.txt");
  std::filesystem::remove(only_file(folder / "pieces"));
  store.remove_all();
  EXPECT_FALSE(std::filesystem::exists(folder / "pieces"));
  store.remove_all();
}

TEST(RecordStore, AFolderThatCannotBeMadeIsAnOutputError)
{
  const TemporaryFolder folder;
  testing::write_bytes(folder / "file", "");
  EXPECT_NE(message_of<OutputError>([&] {
              const RecordStore store(folder / "file/pieces");
            }).find("file/pieces"),
            std::string::npos);
}

}  // namespace
}  // namespace tessera::io

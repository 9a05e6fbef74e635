// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/io/piece_store.hpp"

#include "temporary_folder.hpp"

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

[[nodiscard]] std::filesystem::path only_file(const PieceStore& store)
{
  return std::filesystem::directory_iterator(store.folder())->path();
}

TEST(PieceStore, GivesBackWhatWasPutAlsoThroughAnotherObject)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "run 1/pieces");
  store.put(0, Bytes{});
  store.put(17, record_of(100'000));
  const PieceStore same(folder / "run 1/pieces");
  EXPECT_EQ(same.get(0), Bytes{});
  EXPECT_EQ(same.get(17), record_of(100'000));
  EXPECT_TRUE(same.contains(17));
  EXPECT_FALSE(same.contains(1));
}

TEST(PieceStore, ASecondPutReplacesTheFirst)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "pieces");
  store.put(3, record_of(1000));
  store.put(3, record_of(10));
  EXPECT_EQ(store.get(3), record_of(10));
}

TEST(PieceStore, EveryFlippedBitIsNoticed)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "pieces");
  store.put(5, record_of(30));
  const std::string good = testing::file_bytes(only_file(store));
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    testing::write_bytes(only_file(store), bad);
    const std::string message = message_of<InputError>([&] { (void)store.get(5); });
    EXPECT_NE(message.find(only_file(store).string()), std::string::npos) << "bit " << bit;
  }
}

TEST(PieceStore, EveryOtherLengthIsNoticed)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "pieces");
  store.put(5, record_of(30));
  const std::string good = testing::file_bytes(only_file(store));
  for (std::size_t size = 0; size < good.size(); ++size) {
    testing::write_bytes(only_file(store), good.substr(0, size));
    EXPECT_THROW((void)store.get(5), InputError) << size;
  }
  testing::write_bytes(only_file(store), good + "x");
  EXPECT_THROW((void)store.get(5), InputError);
}

TEST(PieceStore, ARecordUnderTheNameOfAnotherPieceIsNoticed)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "pieces");
  store.put(5, record_of(30));
  const std::filesystem::path fifth = only_file(store);
  store.put(6, record_of(30));
  for (const auto& entry : std::filesystem::directory_iterator(store.folder())) {
    if (entry.path() != fifth) std::filesystem::rename(fifth, entry.path());
  }
  EXPECT_THROW((void)store.get(6), InputError);
}

TEST(PieceStore, AMissingRecordIsNamed)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "pieces");
  const std::string message = message_of<InputError>([&] { (void)store.get(123); });
  EXPECT_NE(message.find("piece_000123"), std::string::npos) << message;
}

TEST(PieceStore, AFullDiskIsAnOutputErrorAndLeavesNothingNew)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "pieces");
  store.put(1, record_of(100));
  {
    const FullDisk full_disk(5000);
    EXPECT_THROW(store.put(1, record_of(100'000)), OutputError);
    EXPECT_THROW(store.put(2, record_of(100'000)), OutputError);
  }
  EXPECT_EQ(store.get(1), record_of(100));
  EXPECT_FALSE(store.contains(2));
  EXPECT_EQ(testing::file_bytes(only_file(store)).size(), 140U);
}

TEST(PieceStore, RemovesRecordsAndLeavesForeignFilesAlone)
{
  const TemporaryFolder folder;
  const PieceStore store(folder / "pieces");
  for (const LocalIndex id : {0, 1, 2}) store.put(id, record_of(10));
  store.remove(1);
  store.remove(1);
  EXPECT_FALSE(store.contains(1));
  EXPECT_TRUE(store.contains(2));

  testing::write_bytes(folder / "pieces/piece_000009.record.tmp-77-0", "left by a dead process");
  testing::write_bytes(folder / "pieces/notes.txt", "mine");
  store.remove_all();
  EXPECT_EQ(only_file(store).filename(), "notes.txt");
  std::filesystem::remove(only_file(store));
  store.remove_all();
  EXPECT_FALSE(std::filesystem::exists(folder / "pieces"));
  store.remove_all();
}

TEST(PieceStore, AFolderThatCannotBeMadeIsAnOutputError)
{
  const TemporaryFolder folder;
  testing::write_bytes(folder / "file", "");
  EXPECT_NE(message_of<OutputError>([&] {
              const PieceStore store(folder / "file/pieces");
            }).find("file/pieces"),
            std::string::npos);
}

}  // namespace
}  // namespace tessera::io

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/fill_record.hpp"

#include <array>
#include <filesystem>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

// The record of batch 4 with one file that its job has written.
struct StoredFill : ::testing::Test {
  static constexpr LocalIndex kBatch = 4;
  const testing::TemporaryFolder output{};
  const Hash128 plan{1, 2};
  const mesh::Piece piece{.subdomain = 9, .material = 3};

  StoredFill()
  {
    testing::write_bytes(output / "a.vtu", "tets of batch 4");
    FillRecord record{.plan = plan};
    record.results.resize(2);
    record.results[1].summary.subdomain = 9;
    record.files = {measure_file(output.path(), "a.vtu")};
    io::RecordStore(store_folder(output.path()))
        .put(record_name(kBatch), std::array{to_bytes(record), to_bytes(piece)});
  }

  [[nodiscard]] bool is_found() const
  {
    return find_record(output.path(), record_name(kBatch), plan).has_value();
  }
};

TEST_F(StoredFill, ComesBackWhole)
{
  const auto record = find_record(output.path(), record_name(kBatch), plan);
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->plan, plan);
  ASSERT_EQ(record->results.size(), 2U);
  EXPECT_EQ(record->results[1].summary.subdomain, 9);
  ASSERT_EQ(record->files.size(), 1U);
  EXPECT_EQ(record->files[0].path, "a.vtu");
  EXPECT_EQ(record->files[0].size, 15U);
  EXPECT_EQ(to_bytes(piece_of_record(output.path(), record_name(kBatch))), to_bytes(piece));
}

TEST_F(StoredFill, OfAnotherPlanOrBatchIsNotFound)
{
  EXPECT_FALSE(find_record(output.path(), record_name(kBatch), {1, 3}));
  EXPECT_FALSE(find_record(output.path(), record_name(kBatch + 1), plan));
}

TEST_F(StoredFill, WithAChangedFileIsNotFound)
{
  testing::write_bytes(output / "a.vtu", "tets of batch 5");
  EXPECT_FALSE(is_found());
  testing::write_bytes(output / "a.vtu", "tets of batch 4");
  EXPECT_TRUE(is_found());
}

TEST_F(StoredFill, WithAFileThatIsCutOffOrGoneIsNotFound)
{
  testing::write_bytes(output / "a.vtu", "tets of batch");
  EXPECT_FALSE(is_found());
  fs::remove(output / "a.vtu");
  EXPECT_FALSE(is_found());
}

TEST_F(StoredFill, WithALinkInPlaceOfItsFileIsNotFound)
{
  fs::rename(output / "a.vtu", output / "b.vtu");
  fs::create_symlink("b.vtu", output / "a.vtu");
  EXPECT_FALSE(is_found());
}

TEST_F(StoredFill, ThatIsDamagedIsNotFound)
{
  const fs::path store = store_folder(output.path());
  for (const auto& entry : fs::directory_iterator(store)) {
    std::string bytes = testing::file_bytes(entry.path());
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    testing::write_bytes(entry.path(), bytes);
  }
  EXPECT_FALSE(is_found());
}

TEST_F(StoredFill, AFileThatCannotBeReadIsAnOutputErrorWithTheReasonOfTheSystem)
{
  const auto message_for = [&](const char* name) {
    return testing::message_of<OutputError>(
        [&] { static_cast<void>(measure_file(output.path(), name)); });
  };
  EXPECT_EQ(message_for("c.vtu"),
            "cannot read back " + (output / "c.vtu").string() + ": No such file or directory");
  fs::create_directory(output / "d.vtu");
  EXPECT_EQ(message_for("d.vtu"),
            "cannot read back " + (output / "d.vtu").string() + ": Is a directory");
}

}  // namespace
}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/open_files.hpp"

#include <algorithm>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::io {
namespace {

std::string content_of(const OpenFile& file)
{
  std::string text(8, '\0');
  const ssize_t length = ::pread(file.descriptor, text.data(), text.size(), 0);
  text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return text;
}

TEST(OpenFiles, StayOpen)
{
  const testing::TemporaryFolder folder;
  testing::write_bytes(folder / "a", "text");
  OpenFiles files;
  const OpenFile first = files.open(folder / "a");
  EXPECT_EQ(first.path, folder / "a");
  EXPECT_EQ(content_of(first), "text");
  std::filesystem::remove(folder / "a");
  const OpenFile again = files.open(folder / "a");
  EXPECT_EQ(again.descriptor, first.descriptor);
  EXPECT_EQ(content_of(again), "text");
}

// More files than stay open: each is the right one when it is asked for.
TEST(OpenFiles, AreReadHoweverManyThereAre)
{
  const testing::TemporaryFolder folder;
  constexpr int kMany = 150;
  for (int i = 0; i < kMany; ++i) {
    testing::write_bytes(folder / std::to_string(i), std::to_string(i));
  }
  OpenFiles files;
  int largest = 0;
  for (int i = 0; i < 2 * kMany; ++i) {
    const OpenFile file = files.open(folder / std::to_string(7 * i % kMany));
    EXPECT_EQ(content_of(file), std::to_string(7 * i % kMany));
    largest = std::max(largest, file.descriptor);
  }
  EXPECT_LT(largest, 100);  // Old ones were closed.
}

TEST(OpenFiles, AreClosedAtTheEnd)
{
  const testing::TemporaryFolder folder;
  testing::write_bytes(folder / "a", "text");
  int descriptor = -1;
  {
    OpenFiles files;
    descriptor = files.open(folder / "a").descriptor;
    EXPECT_GE(::fcntl(descriptor, F_GETFD), 0);
  }
  EXPECT_LT(::fcntl(descriptor, F_GETFD), 0);
}

TEST(OpenFiles, AreRefusedByNameIfTheyAreNotThereOrLinks)
{
  const testing::TemporaryFolder folder;
  testing::write_bytes(folder / "a", "text");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  OpenFiles files;
  for (const char* const name : {"none", "link"}) {
    const std::string message =
        testing::message_of<InputError>([&] { (void)files.open(folder / name); });
    EXPECT_NE(message.find((folder / name).string()), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace tessera::io

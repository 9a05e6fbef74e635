// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/shared_bytes.hpp"

#include <csignal>
#include <cstdint>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/base/index_lists.hpp"

namespace tessera {
namespace {

struct Mixed {
  std::string name{};
  FlatArray<double> lengths{};
  bool flag = false;
  FlatArray<std::int32_t> rows{};
  IndexLists lists{};
  FlatArray<char> marks{};
  FlatArray<double> none{};

  static auto fields(auto& self)
  {
    return std::tie(self.name, self.lengths, self.flag, self.rows, self.lists, self.marks,
                    self.none);
  }
  friend bool operator==(const Mixed&, const Mixed&) = default;
};

Mixed sample()
{
  Mixed mixed{.name = "odd", .lengths = {0.5, 2.0}, .flag = true, .rows = {1, 2, 3}};
  mixed.lists.add(std::vector<LocalIndex>{4, 5});
  mixed.marks = {'a'};
  return mixed;
}

template <class T>
bool stands_in(std::span<const std::byte> bytes, const FlatArray<T>& array)
{
  const auto* const first = reinterpret_cast<const std::byte*>(array.data());
  return bytes.data() <= first && first + array.size() * sizeof(T) <= bytes.data() + bytes.size();
}

void expect_borrowed(const SharedBytes& shared)
{
  const Mixed read = from_shared_bytes<Mixed>(shared);
  EXPECT_EQ(read, sample());
  EXPECT_TRUE(stands_in(shared.bytes(), read.lengths));
  EXPECT_TRUE(stands_in(shared.bytes(), read.rows));
  EXPECT_TRUE(stands_in(shared.bytes(), read.lists.values));
  EXPECT_TRUE(stands_in(shared.bytes(), read.marks));
}

// Runs `work` in a child process. Its exit status, or -1 if it died.
template <class Work>
int status_in_child(const Work& work)
{
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string refusal_of(const SegmentName& name)
{
  try {
    static_cast<void>(SharedBytes::map_segment(name));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(SharedBytes, ArraysAreReadWhereTheyStand)
{
  expect_borrowed(to_bytes(sample()));
  expect_borrowed(to_segment(sample()));
}

TEST(SharedBytes, WithoutAKeeperArraysAreCopied)
{
  const Bytes bytes = to_bytes(sample());
  const auto read = from_bytes<Mixed>(bytes);
  EXPECT_EQ(read, sample());
  EXPECT_FALSE(stands_in(bytes, read.lengths));
}

TEST(SharedBytes, BytesThatEndTooSoonAreRefused)
{
  const Bytes bytes = to_bytes(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const SharedBytes part(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)));
    EXPECT_THROW(static_cast<void>(from_shared_bytes<Mixed>(part)), InputError) << size;
  }
}

TEST(SharedBytes, OutliveTheirOwnerInWhatBorrowsThem)
{
  Mixed read;
  {
    const SharedBytes shared = to_segment(sample());
    read = from_shared_bytes<Mixed>(shared);
  }
  EXPECT_EQ(read, sample());
}

TEST(SharedBytes, AnotherProcessMapsTheSameMemory)
{
  const SharedBytes shared = to_segment(sample());
  ASSERT_TRUE(shared.segment());
  const int status = status_in_child([&] {
    const SharedBytes mapped = SharedBytes::map_segment(*shared.segment());
    return from_shared_bytes<Mixed>(mapped) == sample()
                   && mapped.segment()->inode == shared.segment()->inode
                   && mapped.segment()->process == shared.segment()->process
               ? 0
               : 1;
  });
  EXPECT_EQ(status, 0);
}

// A process that forces a write has a page of its own then.
TEST(SharedBytes, NobodySeesWhatAnotherWrites)
{
  const SharedBytes shared = to_segment(sample());
  const SharedBytes mapped = SharedBytes::map_segment(*shared.segment());
  auto* const first = const_cast<std::byte*>(mapped.bytes().data());
  ASSERT_EQ(::mprotect(first, 1, PROT_READ | PROT_WRITE), 0);
  const std::byte before = *first;
  *first = ~before;
  EXPECT_EQ(shared.bytes().front(), before);
}

// As kernels before 6.7 refuse what is shared and could be made writable.
TEST(SharedBytes, TheMappingIsPrivateAndReadOnly)
{
  const SharedBytes shared = to_segment(sample());
  std::ifstream maps("/proc/self/maps");
  int num_mappings = 0;
  for (std::string line; std::getline(maps, line);) {
    if (line.find("memfd:tessera") == std::string::npos) continue;
    EXPECT_NE(line.find(" r--p "), std::string::npos) << line;
    ++num_mappings;
  }
  EXPECT_EQ(num_mappings, 1);
}

TEST(SharedBytes, AnotherSegmentUnderTheNameIsRefused)
{
  const SharedBytes shared = to_segment(sample());
  SegmentName other = *shared.segment();
  ++other.inode;
  EXPECT_NE(refusal_of(other).find("is another segment"), std::string::npos);
  SegmentName longer = *shared.segment();
  ++longer.size;
  EXPECT_NE(refusal_of(longer).find("is another segment"), std::string::npos);
  SegmentName closed = *shared.segment();
  closed.descriptor = 12345;
  EXPECT_NE(refusal_of(closed).find("shared memory: /proc/"), std::string::npos);
}

// A limit on the size of files counts for this memory too.
TEST(SharedBytes, TooLittleMemoryIsAnErrorAndNoSignal)
{
  const int status = status_in_child([] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      static_cast<void>(SharedBytes::make_segment(1 << 20, [](std::span<std::byte> bytes) {
        for (std::byte& byte : bytes) byte = std::byte{1};
      }));
    } catch (const Error&) {
      return 0;
    }
    return 1;
  });
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include <gtest/gtest.h>

namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

TEST(LargeBlocks, BeginOnAHugePage)
{
  for (const std::size_t size : {2 * kHugePage, 3 * kHugePage + 1, 20 * kHugePage}) {
    const std::vector<char> block(size, 'x');
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block.data()) % kHugePage, 0U) << size;
    EXPECT_EQ(block.front(), 'x');
    EXPECT_EQ(block.back(), 'x');
  }
}

TEST(LargeBlocks, ThatNobodyHasAreRefusedAsEver)
{
  constexpr std::size_t kNobodyHas = std::size_t{1} << 60;
  EXPECT_THROW((void)::operator new(kNobodyHas), std::bad_alloc);
  EXPECT_EQ(::operator new(kNobodyHas, std::nothrow), nullptr);
}

TEST(LargeBlocks, OfNothingAreBlocks)
{
  void* const one = ::operator new(0);
  EXPECT_NE(one, nullptr);
  ::operator delete(one);
}

}  // namespace

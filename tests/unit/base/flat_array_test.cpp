// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/flat_array.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using Array = FlatArray<std::int32_t>;
using Vector = std::vector<std::int32_t>;

// Values that must stay as they are, and somebody who keeps them.
struct Borrowed : ::testing::Test {
  std::shared_ptr<const Vector> values = std::make_shared<const Vector>(Vector{3, 1, 4});
  Array array = Array::borrowed(*values, values);

  void TearDown() override { EXPECT_EQ(*values, (Vector{3, 1, 4})); }
};

TEST(FlatArray, IsAVectorOfItsOwn)
{
  Array array{1, 2};
  array.push_back(3);
  array.insert(array.begin(), 0);
  EXPECT_EQ(array, (Vector{0, 1, 2, 3}));
  array.resize(5);
  EXPECT_EQ(array, (Vector{0, 1, 2, 3, 0}));
  array.assign(2, 7);
  EXPECT_EQ(array, (Vector{7, 7}));
  array = {};
  EXPECT_TRUE(array.empty());
  EXPECT_EQ(Array(3), (Vector{0, 0, 0}));
}

TEST(FlatArray, TakesTheMemoryOfAVector)
{
  Vector vector{1, 2, 3};
  const auto* const place = vector.data();
  Array array(std::move(vector));
  EXPECT_EQ(array.data(), place);
  array.push_back(4);
  EXPECT_EQ(array, (Vector{1, 2, 3, 4}));
  EXPECT_TRUE(Array(Vector{}).empty());
}

TEST(FlatArray, CopiesAVectorThatIsStillNeeded)
{
  const Vector vector{1, 2, 3};
  const Array array = vector;
  EXPECT_EQ(array, vector);
  EXPECT_NE(array.data(), vector.data());
  EXPECT_EQ(array.to_vector(), vector);
}

TEST_F(Borrowed, IsWhereTheValuesAre)
{
  EXPECT_EQ(array.data(), values->data());
  EXPECT_EQ(array, *values);
  const Array moved = std::move(array);
  EXPECT_EQ(moved.data(), values->data());
}

TEST_F(Borrowed, CopiesOwnTheirValues)
{
  Array copy = array;
  EXPECT_NE(copy.data(), values->data());
  copy.front() = 9;
  Array assigned{5, 5, 5, 5};
  assigned = array;
  assigned.front() = 9;
  EXPECT_EQ(assigned, (Vector{9, 1, 4}));
}

TEST_F(Borrowed, CanBeAssignedTo)
{
  const Array other{2, 7};
  array = other;
  EXPECT_EQ(array, (Vector{2, 7}));
  array[0] = 1;
  EXPECT_EQ(other, (Vector{2, 7}));
}

TEST_F(Borrowed, GrowsInMemoryOfItsOwn)
{
  array.push_back(1);
  array.front() = 9;
  EXPECT_EQ(array, (Vector{9, 1, 4, 1}));
}

TEST_F(Borrowed, GivesTheMemoryBackWhenNobodyBorrowsIt)
{
  EXPECT_EQ(values.use_count(), 2);
  {
    const Array moved = std::move(array);
    array = {};
    EXPECT_EQ(values.use_count(), 2);
  }
  EXPECT_EQ(values.use_count(), 1);
}

TEST_F(Borrowed, MayBeUsedAgainAfterAMove)
{
  const Array moved = std::move(array);
  array.assign({8, 8, 8});
  array.resize(6);
  EXPECT_EQ(array, (Vector{8, 8, 8, 0, 0, 0}));
  EXPECT_EQ(moved, *values);
}

TEST_F(Borrowed, SwapsWithAnArrayOfItsOwn)
{
  Array other{1};
  std::swap(array, other);
  EXPECT_EQ(other.data(), values->data());
  array.push_back(2);
  EXPECT_EQ(array, (Vector{1, 2}));
}

}  // namespace
}  // namespace tessera

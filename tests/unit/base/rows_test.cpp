// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/rows.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/flat_array.hpp"

namespace tessera {
namespace {

const std::vector<LocalIndex> kOrder{2, 0, 1};

TEST(Rows, ComeInTheOrderGiven)
{
  const std::vector<double> values{0.0, 0.5, 1.0, 1.5, 2.0, 2.5};
  EXPECT_EQ(rows_of<2>(values, kOrder), (std::vector<double>{2.0, 2.5, 0.0, 0.5, 1.0, 1.5}));
  EXPECT_EQ(rows_of(FlatArray<LocalIndex>{7, 8, 9}, kOrder).to_vector(),
            (std::vector<LocalIndex>{9, 7, 8}));
}

TEST(Rows, ArePutWhereTheyBelong)
{
  std::vector<double> to(6, -1.0);
  put_rows<2>(std::vector<double>{1.0, 2.0, 3.0, 4.0}, std::vector<LocalIndex>{2, 0}, to);
  EXPECT_EQ(to, (std::vector<double>{3.0, 4.0, -1.0, -1.0, 1.0, 2.0}));
}

TEST(Rows, TheInverseOfAnOrderUndoesIt)
{
  const std::vector<LocalIndex> values{7, 8, 9};
  EXPECT_EQ(inverse_of(kOrder), (std::vector<LocalIndex>{1, 2, 0}));
  EXPECT_EQ(rows_of(rows_of(values, kOrder), inverse_of(kOrder)), values);
}

}  // namespace
}  // namespace tessera

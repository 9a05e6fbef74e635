// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/worst_tets.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

namespace tessera::quality {
namespace {

WorstTet tet(LocalIndex subdomain, double mean_ratio, double x = 0.0)
{
  return {.subdomain = subdomain, .centre = {x, 0.0, 0.0}, .mean_ratio = mean_ratio};
}

WorstTets of_subdomain(LocalIndex subdomain, int num_tets)
{
  WorstTets worst;
  for (int t = 0; t < num_tets; ++t) {
    const double mean_ratio = 0.1 * (1 + (7 * t + subdomain) % 5);  // Many are equal.
    if (worst.takes(mean_ratio)) worst.add(tet(subdomain, mean_ratio, t));
  }
  return worst;
}

TEST(WorstTets, KeepsTheWorstInOrder)
{
  WorstTets worst;
  for (int t = 0; t < 30; ++t) worst.add(tet(0, 1.0 - 0.01 * ((11 * t) % 30)));
  ASSERT_EQ(worst.tets().size(), WorstTets::kMost);
  EXPECT_DOUBLE_EQ(worst.tets().front().mean_ratio, 0.71);
  EXPECT_DOUBLE_EQ(worst.tets().back().mean_ratio, 0.80);
  EXPECT_TRUE(std::ranges::is_sorted(worst.tets(), {}, &WorstTet::mean_ratio));
}

TEST(WorstTets, TakesNoneThatIsAsGoodAsItsBest)
{
  WorstTets worst;
  for (int t = 0; t < 10; ++t) {
    EXPECT_TRUE(worst.takes(0.5));
    worst.add(tet(0, 0.5, t));
  }
  EXPECT_FALSE(worst.takes(0.5));
  EXPECT_TRUE(worst.takes(0.49));
}

TEST(WorstTets, AreTheSameInWhateverOrderSubdomainsCome)
{
  std::vector<WorstTets> parts;
  for (LocalIndex s = 0; s < 4; ++s) parts.push_back(of_subdomain(s, 23));
  WorstTets expected;
  for (const WorstTets& part : parts) expected.add(part);
  ASSERT_EQ(expected.tets().size(), WorstTets::kMost);
  std::vector<std::size_t> order{0, 1, 2, 3};
  while (std::ranges::next_permutation(order).found) {
    WorstTets all;
    for (const std::size_t p : order) all.add(parts[p]);
    EXPECT_EQ(all.tets(), expected.tets());
  }
}

TEST(WorstTets, GoToBytesAndBack)
{
  const WorstTets worst = of_subdomain(3, 12);
  EXPECT_EQ(from_bytes<WorstTets>(to_bytes(worst)).tets(), worst.tets());
  const std::vector<WorstTet> too_many(WorstTets::kMost + 1, tet(0, 0.5));
  EXPECT_THROW(static_cast<void>(from_bytes<WorstTets>(to_bytes(too_many))), InputError);
}

}  // namespace
}  // namespace tessera::quality

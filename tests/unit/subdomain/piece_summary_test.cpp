// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_summary.hpp"

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::subdomain {
namespace {

FillResult some_result()
{
  FillResult result;
  result.summary.subdomain = 17;
  result.summary.num_tets = 5'000'000'000;
  result.summary.volume = 0.1;
  result.summary.was_limited = true;
  result.summary.seam_tets = {3, 10.0, 150.0, 0.2, 1.5};
  result.failures = {"try 1 (netgen): used too much", "try 2 (netgen): gave up"};
  result.histograms.mean_ratio.add(0.7);
  result.histograms.log2_edge_length.add(-3.0);
  result.seams = {{4, {1, 2}}, {9, {3, 4}}};
  return result;
}

TEST(FillResult, ComesBackFromBytes)
{
  const FillResult sent = some_result();
  const FillResult got = fill_result_from_bytes(to_bytes(sent));
  EXPECT_EQ(got.summary.subdomain, 17);
  EXPECT_EQ(got.summary.num_tets, 5'000'000'000);
  EXPECT_EQ(got.summary.volume, 0.1);
  EXPECT_TRUE(got.summary.was_limited);
  EXPECT_EQ(got.failures, sent.failures);
  EXPECT_EQ(got.summary.seam_tets.num_tets, 3);
  EXPECT_EQ(got.summary.seam_tets.sum_mean_ratio, 1.5);
  EXPECT_EQ(quality::to_bytes(got.histograms), quality::to_bytes(sent.histograms));
  ASSERT_EQ(got.seams.size(), 2U);
  EXPECT_EQ(got.seams[1].triangle, 9);
  EXPECT_EQ(got.seams[1].hash, (Hash128{3, 4}));
}

TEST(FillResult, TruncatedBytesAreAnInputError)
{
  const Bytes bytes = to_bytes(some_result());
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, bytes.size() - 1}) {
    EXPECT_THROW(static_cast<void>(fill_result_from_bytes(std::span(bytes).first(size))),
                 InputError);
  }
}

}  // namespace
}  // namespace tessera::subdomain

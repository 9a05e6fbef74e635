// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files/netcdf_file.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::formats {
namespace {

TEST(BigEndian, TurnsEachValueRound)
{
  const std::array<std::int32_t, 2> values{1, 0x01020304};
  EXPECT_EQ(big_endian(std::span<const std::int32_t>(values)), std::string("\0\0\0\1\1\2\3\4", 8));
}

TEST(NetcdfSections, ArraysAreAlignedAndPlacedBeyondFourGigabytes)
{
  constexpr GlobalIndex kMany = 3'000'000'000;
  const NetcdfLayout layout{
      .dimensions = {{"names", 1}, {"length", 5}, {"many", kMany}, {"few", 3}},
      .attributes = {{"title", "mesh"}},
      .variables = {{"name", NetcdfType::text, {"names", "length"}, {}, "steel"},
                    {"large", NetcdfType::int64, {"many"}, {}, {}},
                    {"small", NetcdfType::float64, {"few"}, {}, {}}}};
  const std::vector<RecordSection> sections = netcdf_sections(layout);
  ASSERT_EQ(sections.size(), 2U);
  EXPECT_EQ(sections[0].head.substr(0, 4), "CDF\x05");
  EXPECT_EQ(sections[0].head.size() % 8, 0U);
  EXPECT_EQ(sections[0].num_records, kMany);
  EXPECT_EQ(sections[1].head, "");
  EXPECT_EQ(sections[1].num_records, 3);
  // The header says where the last array begins: in the last bytes before the values.
  const auto begin = static_cast<GlobalIndex>(sections[0].head.size()) + 8 * kMany;
  const std::string told = big_endian(std::span<const GlobalIndex>(&begin, 1));
  EXPECT_NE(sections[0].head.find(told), std::string::npos);
}

}  // namespace
}  // namespace tessera::formats

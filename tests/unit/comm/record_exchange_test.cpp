// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/record_exchange.hpp"

#include <map>

#include <gtest/gtest.h>

namespace tessera::comm {
namespace {

struct Record {
  GlobalIndex key = 0;
  int place = 0;
};

using Groups = std::map<GlobalIndex, std::vector<int>>;  // Places of each key, in the order given.

Groups groups_of(const std::vector<Record>& records)
{
  Groups groups;
  for_each_group(
      std::span(records), [](const Record& record) { return record.key; },
      [](const Record& record) { return record.place; },
      [&](std::span<const std::size_t> rows) {
        std::vector<int> places;
        for (const std::size_t row : rows) {
          EXPECT_EQ(records[row].key, records[rows[0]].key);
          places.push_back(records[row].place);
        }
        EXPECT_TRUE(groups.emplace(records[rows[0]].key, places).second) << "twice";
      });
  return groups;
}

TEST(ForEachGroup, HasEqualKeysInTheOrderOfTheirPlaces)
{
  const Groups expected{{-1, {4}}, {7, {1, 2, 5}}, {8, {3}}};
  EXPECT_EQ(groups_of({{7, 5}, {8, 3}, {7, 1}, {-1, 4}, {7, 2}}), expected);
  EXPECT_EQ(groups_of({{7, 1}, {7, 2}, {-1, 4}, {7, 5}, {8, 3}}), expected);
}

TEST(ForEachGroup, HasEachOfManyKeysOnce)
{
  std::vector<Record> records;
  for (int i = 0; i < 3000; ++i) records.push_back({(13 * i) % 1000, i});
  const Groups groups = groups_of(records);
  EXPECT_EQ(groups.size(), 1000U);
  for (const auto& [key, places] : groups) {
    EXPECT_EQ(places.size(), 3U);
    EXPECT_TRUE(std::ranges::is_sorted(places));
  }
}

TEST(ForEachGroup, OfNothingIsNothing) { EXPECT_TRUE(groups_of({}).empty()); }

}  // namespace
}  // namespace tessera::comm

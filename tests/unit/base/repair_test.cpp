// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/repair.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

namespace tessera {
namespace {

// That none stands twice is seen by the compiler.
TEST(Repair, HasANameWhicheverItIs)
{
  EXPECT_EQ(kWords<Repair>.size(), kNumRepairs);
  for (std::size_t row = 0; row < kNumRepairs; ++row) {
    const auto repair = static_cast<Repair>(row);
    EXPECT_EQ(value_of<Repair>(word_of(repair)), repair);
  }
}

TEST(Repair, IsReadFromNamesThatCommasSeparate)
{
  EXPECT_TRUE(parse_repairs("").empty());
  EXPECT_EQ(parse_repairs("worst_tets,mend_folds"),
            (std::vector{Repair::mend_folds, Repair::worst_tets}));
  EXPECT_EQ(names_of(parse_repairs("worst_tets,mend_folds")), "mend_folds,worst_tets");
}

TEST(Repair, IsRefusedByANameThatThereIsNot)
{
  for (const char* const names : {"mend_fold", "mend_folds,", ",mend_folds",
                                  "mend_folds,,worst_tets", "mend_folds worst_tets"}) {
    try {
      static_cast<void>(parse_repairs(names));
      ADD_FAILURE() << names;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find("worst_tets"), std::string::npos) << error.what();
    }
  }
}

TEST(Repair, IsCountedUntilItIsTaken)
{
  static_cast<void>(take_noted_repairs());
  note_repair(Repair::mend_folds);
  note_repair(Repair::mend_folds, 2);
  RepairCounts more;
  more.add(Repair::worst_tets, 5);
  note_repairs(more);
  const RepairCounts taken = take_noted_repairs();
  EXPECT_EQ(taken[Repair::mend_folds], 3);
  EXPECT_EQ(taken[Repair::worst_tets], 5);
  EXPECT_EQ(taken[Repair::mend_surface], 0);
  EXPECT_EQ(from_bytes<RepairCounts>(to_bytes(taken)), taken);
  EXPECT_EQ(take_noted_repairs(), RepairCounts());
}

}  // namespace
}  // namespace tessera

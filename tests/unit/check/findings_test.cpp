// SPDX-License-Identifier: BSD-3-Clause
#include "check/findings.hpp"

#include <array>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"

#include "support/byte_image.hpp"

#include "check/match/records.hpp"
#include "check/match/triangles.hpp"
#include "check/piece/figures.hpp"

namespace tessera::check {
namespace {

void add(Findings& findings, Kind kind, GlobalIndex piece, GlobalIndex entity)
{
  findings.add(kind, {piece, entity},
               [&] { return std::to_string(piece) + "/" + std::to_string(entity); });
}

TEST(Findings, KeepTheFirstPlacesInWhateverOrderTheyCome)
{
  Findings up;
  Findings down;
  for (GlobalIndex i = 0; i < 50; ++i) {
    add(up, Kind::triangle, i / 7, i % 7);
    add(down, Kind::triangle, (49 - i) / 7, (49 - i) % 7);
  }
  const std::vector<Defect> defects = up.to_defects();
  ASSERT_EQ(defects.size(), 1U);
  EXPECT_EQ(defects[0].kind, "triangle");
  EXPECT_EQ(defects[0].count, 50);
  ASSERT_EQ(defects[0].offenders.size(), Findings::kNumKept);
  EXPECT_EQ(defects[0].offenders.front(), "0/0");
  EXPECT_EQ(defects[0].offenders.back(), "1/2");
  EXPECT_EQ(down.to_defects()[0].offenders, defects[0].offenders);
}

TEST(Findings, MergedPartsEqualTheWhole)
{
  Findings whole;
  std::array<Findings, 3> parts;
  for (GlobalIndex i = 0; i < 40; ++i) {
    const Kind kind = i % 2 == 0 ? Kind::unused_point : Kind::arrays;
    add(whole, kind, i % 5, i);
    add(parts[static_cast<std::size_t>(i) % 3], kind, i % 5, i);
  }
  Findings merged;
  for (const Findings& part : parts) merged.merge(from_bytes<Findings>(to_bytes(part)));
  EXPECT_EQ(to_bytes(merged), to_bytes(whole));
}

TEST(Findings, OfPartOfTheirBytesNothingIsRead)
{
  Findings findings;
  for (GlobalIndex i = 0; i < 3; ++i) add(findings, Kind::triangle, i, 2 * i);
  testing::expect_round_trip(findings);
  testing::expect_garbage_is_harmless(findings);
}

TEST(Records, NameEachFieldOnce)
{
  testing::expect_different_fields(TriangleRecord{});
  testing::expect_different_fields(VertexRecord{});
  testing::expect_different_fields(EdgeRecord{});
  testing::expect_different_fields(TriangleVerdict{});
  testing::expect_different_fields(PieceRecord{});
  testing::expect_different_fields(ShapeSums{});
}

TEST(Findings, MergeOfChosenKindsLeavesTheOthers)
{
  Findings from;
  add(from, Kind::arrays, 0, 0);
  add(from, Kind::point_id_hole, 0, 1);
  Findings into;
  into.merge(from, std::array{Kind::point_id_hole});
  EXPECT_EQ(into.count(Kind::arrays), 0);
  EXPECT_EQ(into.count(Kind::point_id_hole), 1);
}

}  // namespace
}  // namespace tessera::check

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/tet_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::quality {
namespace {

const TetCorners kRegular{{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
const TetCorners kCorner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
const TetCorners kKuhn{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}};

struct DihedralRange {
  double min_deg = 0.0;
  double max_deg = 0.0;
};

DihedralRange dihedral_range(const TetCorners& corners)
{
  const TetShape shape = shape_of(corners);
  return {angle_deg(shape.largest_cosine), angle_deg(shape.smallest_cosine)};
}

double degrees(double cosine) { return std::acos(cosine) * 180.0 / std::numbers::pi; }

template <class Map>
TetCorners mapped(TetCorners corners, const Map& map)
{
  for (Vec3& corner : corners) corner = map(corner);
  return corners;
}

TEST(MeanRatio, HasClosedForms)
{
  EXPECT_NEAR(mean_ratio(kRegular), 1.0, 1e-15);
  // 12 (3/6)^(2/3) / (3 * 1 + 3 * 2) and 12 (3/6)^(2/3) / (3 * 1 + 2 * 2 + 3).
  EXPECT_NEAR(mean_ratio(kCorner), 12.0 / 9.0 * std::pow(0.5, 2.0 / 3.0), 1e-15);
  EXPECT_NEAR(mean_ratio(kKuhn), 12.0 / 10.0 * std::pow(0.5, 2.0 / 3.0), 1e-15);
}

TEST(MeanRatio, DoesNotDependOnScaleAndPlace)
{
  for (const double scale : {1e-60, 1e-6, 3.0, 1e60}) {
    const auto moved = mapped(kCorner, [scale](const Vec3& p) {
      return scale * (p + Vec3{2, 3, 5});
    });
    EXPECT_NEAR(mean_ratio(moved), mean_ratio(kCorner), 1e-13) << scale;
  }
}

TEST(MeanRatio, DoesNotDependOnAnEvenOrderOfCorners)
{
  TetCorners turned{kKuhn[1], kKuhn[2], kKuhn[0], kKuhn[3]};
  EXPECT_NEAR(mean_ratio(turned), mean_ratio(kKuhn), 1e-15);
}

TEST(MeanRatio, OfAnInvertedTetIsNegative)
{
  TetCorners inverted = kRegular;
  std::swap(inverted[0], inverted[1]);
  EXPECT_NEAR(mean_ratio(inverted), -1.0, 1e-15);
}

TEST(MeanRatio, OfAFlatTetIsZero)
{
  EXPECT_EQ(mean_ratio({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}), 0.0);
  EXPECT_EQ(mean_ratio({{{2, 2, 2}, {2, 2, 2}, {2, 2, 2}, {2, 2, 2}}}), 0.0);
}

TEST(MeanRatio, FallsWithFlattening)
{
  double last = 1.1;
  for (const double height : {1.0, 0.3, 0.1, 1e-3, 1e-9}) {
    const auto flat = mapped(kRegular, [height](const Vec3& p) {
      return Vec3{p[0], p[1], height * p[2]};
    });
    EXPECT_LT(mean_ratio(flat), last);
    EXPECT_GT(mean_ratio(flat), 0.0);
    last = mean_ratio(flat);
  }
}

TEST(DihedralAngles, HasClosedForms)
{
  const DihedralRange regular = dihedral_range(kRegular);
  EXPECT_NEAR(regular.min_deg, degrees(1.0 / 3.0), 1e-12);
  EXPECT_NEAR(regular.max_deg, degrees(1.0 / 3.0), 1e-12);
  const DihedralRange corner = dihedral_range(kCorner);
  EXPECT_NEAR(corner.min_deg, degrees(1.0 / std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(corner.max_deg, 90.0, 1e-12);
  const DihedralRange kuhn = dihedral_range(kKuhn);
  EXPECT_NEAR(kuhn.min_deg, 45.0, 1e-12);
  EXPECT_NEAR(kuhn.max_deg, 90.0, 1e-12);
}

// Two triangles that meet along the x axis at a given angle. Where that is the smallest of the
// tet's six angles the common edge is long, where it is the largest one the edge is short.
TEST(DihedralAngles, FindsTheAngleOfAWedge)
{
  for (const double angle : {1.0, 10.0, 30.0, 100.0, 120.0, 179.0}) {
    const double radians = angle * std::numbers::pi / 180.0;
    const double half = angle < 90.0 ? 10.0 : 0.01;
    const DihedralRange found = dihedral_range(
        {{{-half, 0, 0}, {half, 0, 0}, {0, 1, 0}, {0, std::cos(radians), std::sin(radians)}}});
    EXPECT_NEAR(angle < 90.0 ? found.min_deg : found.max_deg, angle, 1e-9);
  }
}

TEST(DihedralAngles, IsThatOfAllSixEdges)
{
  TetCorners corners{{{0, 0, 0}, {1.1, 0.2, 0}, {0.3, 0.9, -0.2}, {0.1, 0.4, 0.7}}};
  const DihedralRange range = dihedral_range(corners);
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {
    const DihedralRange other = dihedral_range(
        {corners[order[0]], corners[order[1]], corners[order[2]], corners[order[3]]});
    EXPECT_NEAR(other.min_deg, range.min_deg, 1e-12);
    EXPECT_NEAR(other.max_deg, range.max_deg, 1e-12);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(DihedralAngles, DoesNotDependOnScale)
{
  for (const double scale : {1e-60, 1e60}) {
    const auto scaled = mapped(kCorner, [scale](const Vec3& p) { return scale * p; });
    EXPECT_NEAR(dihedral_range(scaled).min_deg, dihedral_range(kCorner).min_deg, 1e-12);
  }
}

TEST(DihedralAngles, OfAFlatTetIsFromZeroToAHalfTurn)
{
  const DihedralRange flat = dihedral_range({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  EXPECT_NEAR(flat.min_deg, 0.0, 1e-6);
  EXPECT_NEAR(flat.max_deg, 180.0, 1e-6);
}

TEST(DihedralAngles, OfAFaceWithoutAreaIsFromZeroToAHalfTurn)
{
  const DihedralRange needle = dihedral_range({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(needle.min_deg, 0.0);
  EXPECT_EQ(needle.max_deg, 180.0);
}

TEST(ShapesOf, HasTheBitsOfEveryTetAlone)
{
  std::vector<double> xyz;
  std::mt19937 random(7);  // The same numbers everywhere.
  for (int i = 0; i < 3 * 40; ++i) xyz.push_back(1e-3 * static_cast<double>(random() % 1000));
  std::vector<LocalIndex> tet_vertices;
  for (int i = 0; i < 4 * 101; ++i) tet_vertices.push_back(static_cast<LocalIndex>(random() % 40));
  tet_vertices.insert(tet_vertices.end(), {5, 5, 6, 7, 8, 8, 8, 8});  // Without area.
  for (const std::size_t num_tets : {std::size_t{0}, std::size_t{1}, tet_vertices.size() / 4}) {
    std::vector<TetShape> shapes(num_tets);
    shapes_of(xyz, std::span(tet_vertices).first(4 * num_tets), shapes);
    for (std::size_t t = 0; t < num_tets; ++t) {
      TetCorners corners;
      for (std::size_t c = 0; c < 4; ++c) {
        corners[c] = point_at(std::span<const double>(xyz), tet_vertices[4 * t + c]);
      }
      const TetShape alone = shape_of(corners);
      EXPECT_EQ(shapes[t].mean_ratio, alone.mean_ratio);
      EXPECT_EQ(shapes[t].mean_ratio, mean_ratio(corners));
      EXPECT_EQ(shapes[t].largest_cosine, alone.largest_cosine);
      EXPECT_EQ(shapes[t].smallest_cosine, alone.smallest_cosine);
    }
  }
}

TEST(WholeDegrees, AreThoseOfTheAngle)
{
  for (int tenth = 0; tenth <= 1800; ++tenth) {
    if (tenth % 10 == 0 && tenth > 0) continue;  // Rounding decides there.
    const double angle = 0.1 * tenth;
    const double cosine = std::cos(angle * std::numbers::pi / 180.0);
    EXPECT_EQ(whole_degrees(cosine), static_cast<std::size_t>(angle)) << angle;
  }
}

TEST(WholeDegrees, HavePlacesForFlatAnglesAndForNoNumber)
{
  EXPECT_EQ(whole_degrees(1.0), 0U);
  EXPECT_EQ(whole_degrees(-1.0), 179U);
  EXPECT_EQ(whole_degrees(1.0 + 1e-12), 0U);
  EXPECT_EQ(whole_degrees(-1.0 - 1e-12), 179U);
  EXPECT_EQ(whole_degrees(std::numeric_limits<double>::quiet_NaN()), 0U);
}

}  // namespace
}  // namespace tessera::quality

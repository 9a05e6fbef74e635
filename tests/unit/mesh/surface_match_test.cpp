// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/surface_match.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::mesh {
namespace {

// Two tets that share the triangle (0, 1, 2).
const std::vector<LocalIndex> kTets{0, 1, 2, 3, 0, 2, 1, 4};
const std::vector<LocalIndex> kSurface{1, 2, 3, 0, 3, 2, 0, 1, 3, 2, 1, 4, 0, 4, 1, 0, 2, 4};

TEST(MatchSurface, FindsTheTetBehindEveryTriangle)
{
  const SurfaceMatch match = match_surface(kSurface, 5, kTets);
  EXPECT_EQ(match.triangle_tet, (std::vector<LocalIndex>{0, 0, 0, 1, 1, 1}));
  EXPECT_TRUE(match.is_closed);
}

TEST(MatchSurface, SeesAFaceThatStandsAlone)
{
  const std::vector<LocalIndex> open(kSurface.begin() + 3, kSurface.end());
  EXPECT_FALSE(match_surface(open, 5, kTets).is_closed);
}

TEST(MatchSurface, FindsNoTetBehindATriangleSeenFromTheWrongSide)
{
  std::vector<LocalIndex> turned = kSurface;
  std::swap(turned[0], turned[1]);
  const SurfaceMatch match = match_surface(turned, 5, kTets);
  EXPECT_EQ(match.triangle_tet[0], kNoIndex);
  EXPECT_FALSE(match.is_closed);
}

TEST(MatchSurface, GivesATriangleToOneTetOnly)
{
  std::vector<LocalIndex> twice = kTets;
  twice.insert(twice.end(), kTets.begin(), kTets.begin() + 4);
  EXPECT_FALSE(match_surface(kSurface, 5, twice).is_closed);
}

}  // namespace
}  // namespace tessera::mesh

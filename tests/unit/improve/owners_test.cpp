// SPDX-License-Identifier: BSD-3-Clause
#include "improve/owners.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "improve/centroid_search.hpp"
#include "improve/owner_set.hpp"
#include "improve/region_check.hpp"
#include "improve/split_tets.hpp"

namespace tessera::improve {
namespace {

// A region of `num_owners` that fixes all its vertices; `holders` says who holds each. Without
// outside tets.
RegionMesh region_of(const TetMesh& tets, const std::vector<LocalIndex>& tet_owner,
                     const std::vector<OwnerSet>& holders, LocalIndex num_owners)
{
  RegionMesh mesh;
  mesh.subdomains.resize(at(num_owners));
  std::iota(mesh.subdomains.begin(), mesh.subdomains.end(), 10);
  mesh.vertex_xyz = tets.vertex_xyz;
  mesh.tet_vertices = tets.tet_vertices;
  mesh.tet_owner = tet_owner;
  for (std::size_t v = 0; v < holders.size(); ++v) {
    for (LocalIndex owner = 0; owner < num_owners; ++owner) {
      if (contains(holders[v], owner)) {
        mesh.fixed_places.values.push_back({owner, static_cast<LocalIndex>(v)});
      }
    }
    mesh.fixed_places.end_list();
  }
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tets.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    for (const std::size_t c : mesh::kTetFaceCorners[at(triangle.corners[0])]) {
      mesh.triangle_vertices.push_back(tets.tet_vertices[4 * at(triangle.tets[0]) + c]);
    }
    mesh.triangle_owner.push_back(tet_owner[at(triangle.tets[0])]);
    mesh.triangle_outside.push_back(kNoIndex);
  }
  return mesh;
}

std::vector<OwnerSet> allowed_in(const RegionMesh& mesh, const TetMesh& tets)
{
  return allowed_owners(mesh, tets, check_tets(mesh, tets));
}

// Two tets on either side of the triangle (0, 1, 2), with apexes 3 above and 4 below.
const std::vector<double> kBipyramid{1, 0, 0, -0.5, 0.8, 0, -0.5, -0.8, 0, 0, 0, 1, 0, 0, -1};
const TetMesh kTwoTets{kBipyramid, {0, 1, 2, 3, 0, 2, 1, 4}};
const TetMesh kThreeTets{kBipyramid, {0, 1, 4, 3, 1, 2, 4, 3, 2, 0, 4, 3}};

TEST(SplitDisputed, CutsAnEdgeBetweenVerticesOfDifferentPieces)
{
  const RegionMesh mesh = region_of(kTwoTets, {0, 1}, {3, 3, 3, 1, 2}, 2);
  TetMesh tets = kThreeTets;
  EXPECT_EQ(split_disputed(mesh, tets), 1);
  const auto allowed = allowed_in(mesh, tets);
  EXPECT_EQ(allowed.size(), 6U);
  for (const OwnerSet owners : allowed) EXPECT_TRUE(std::has_single_bit(owners));
  const auto owners = give_to_owners(mesh, tets, check_tets(mesh, tets));
  EXPECT_EQ(std::count(owners.begin(), owners.end(), 0), 3);
}

TEST(SplitDisputed, LeavesTetsAloneThatSomebodyMayHave)
{
  const RegionMesh mesh = region_of(kTwoTets, {0, 1}, {3, 3, 3, 3, 3}, 2);
  TetMesh tets = kTwoTets;
  EXPECT_EQ(split_disputed(mesh, tets), 0);
  EXPECT_EQ(tets.tet_vertices, kTwoTets.tet_vertices);
}

TEST(SplitDisputed, CutsATriangleWhosePairsAgreeButNotAllThree)
{
  // Triangle (0, 1, 2) inside: any two of its vertices have an owner in common, all three have not.
  RegionMesh mesh = region_of(kTwoTets, {0, 1}, {3, 5, 6, 7, 7}, 3);
  TetMesh tets = kTwoTets;
  // The boundary's own rule is not the point here: every owner may be behind its triangles.
  std::fill(mesh.triangle_outside.begin(), mesh.triangle_outside.end(), 0);
  EXPECT_EQ(split_disputed(mesh, tets), 1);
  const auto allowed = allowed_in(mesh, tets);
  EXPECT_EQ(allowed.size(), 6U);
  for (const OwnerSet owners : allowed) EXPECT_NE(owners, OwnerSet{0});
}

TEST(SplitDisputed, CutsATetBehindTrianglesOfTwoOwners)
{
  // In the old tets 0 and 1 have all of one side each; the optimiser leaves one tet behind
  // triangles of both.
  const RegionMesh mesh = region_of(kTwoTets, {0, 1}, {3, 3, 3, 3, 3}, 2);
  TetMesh tets = kThreeTets;
  // Each of the three new tets has one triangle of the upper owner and one of the lower.
  for (const OwnerSet owners : allowed_in(mesh, tets)) EXPECT_EQ(owners, OwnerSet{0});
  EXPECT_EQ(split_disputed(mesh, tets), 3);
  const auto allowed = allowed_in(mesh, tets);
  EXPECT_EQ(allowed.size(), 12U);
  for (const OwnerSet owners : allowed) EXPECT_NE(owners, OwnerSet{0});
}

TEST(GiveToOwners, RefusesToTakeAllTetsFromASubdomain)
{
  // Owner 1 alone holds the vertices, so owner 0 gets none of the new tets.
  RegionMesh mesh = region_of(kTwoTets, {1, 1}, {2, 2, 2, 2, 2}, 2);
  const std::vector<LocalIndex> behind = check_tets(mesh, kTwoTets);
  EXPECT_EQ(give_to_owners(mesh, kTwoTets, behind), (std::vector<LocalIndex>{1, 1}));
  mesh.tet_owner = {0, 1};
  EXPECT_THROW(static_cast<void>(give_to_owners(mesh, kTwoTets, behind)), MeshError);
}

// A row of tets 0, 1, 2, … each sharing a face with the next one: every vertex may be anybody's.
struct RowOfTets : ::testing::Test {
  TetMesh tets{};

  RowOfTets()
  {
    constexpr int kLength = 6;
    for (int i = 0; i < kLength + 3; ++i) {
      const double angle = 2.3005;  // A Boerdijk-Coxeter helix: nearly regular tets.
      const std::array<double, 3> p{0.52 * std::cos(angle * i), 0.52 * std::sin(angle * i),
                                    0.3162 * i};
      tets.vertex_xyz.insert(tets.vertex_xyz.end(), p.begin(), p.end());
    }
    for (LocalIndex i = 0; i < kLength; ++i) {
      std::array<LocalIndex, 4> tet{i, i + 1, i + 2, i + 3};
      const std::span<const double> xyz(tets.vertex_xyz);
      if (tet_volume(point_at(xyz, tet[0]), point_at(xyz, tet[1]), point_at(xyz, tet[2]),
                     point_at(xyz, tet[3]))
          < 0.0) {
        std::swap(tet[0], tet[1]);
      }
      tets.tet_vertices.insert(tets.tet_vertices.end(), tet.begin(), tet.end());
    }
  }

  // Everybody holds everything; triangles face tets of `outside`, by the tet behind them.
  [[nodiscard]] RegionMesh region(const std::vector<LocalIndex>& tet_owner,
                                  const std::vector<LocalIndex>& outside) const
  {
    const std::vector<OwnerSet> holders(tets.vertex_xyz.size() / 3, 3);
    RegionMesh mesh = region_of(tets, tet_owner, holders, 2);
    const auto behind = check_tets(mesh, tets);
    for (std::size_t i = 0; i < behind.size(); ++i) {
      mesh.triangle_outside[i] = outside[at(behind[i])];
    }
    return mesh;
  }

  [[nodiscard]] std::vector<LocalIndex> give(const RegionMesh& mesh) const
  {
    return give_to_owners(mesh, tets, check_tets(mesh, tets));
  }
};

TEST_F(RowOfTets, GoesToTheOwnersOfTheNearestTets)
{
  const std::vector<LocalIndex> owners{0, 0, 1, 1, 1, 1};
  EXPECT_EQ(give(region(owners, owners)), owners);
}

TEST_F(RowOfTets, GivesTetsAwayThatAreCutOffFromTheirOwner)
{
  // Tet 3 is owner 0's, but no tet of owner 0 is beside it, inside or outside.
  EXPECT_EQ(give(region({0, 0, 1, 0, 1, 1}, {0, 0, 1, 1, 1, 1})),
            (std::vector<LocalIndex>{0, 0, 1, 1, 1, 1}));
}

TEST_F(RowOfTets, KeepsTheLargestComponentOfAnOwnerWithNothingOutside)
{
  EXPECT_EQ(give(region({0, 1, 0, 0, 1, 1}, {1, 1, 1, 1, 1, 1})),
            (std::vector<LocalIndex>{1, 1, 0, 0, 1, 1}));
}

TEST_F(RowOfTets, KeepsTrianglesThatFaceNoPieceWithTheirOwner)
{
  // The nearest old tets would say otherwise, but the triangles of tet 3 may be on the geometry.
  RegionMesh mesh = region({0, 0, 1, 1, 1, 1}, {0, 0, 1, kNoIndex, 1, 1});
  const auto behind = check_tets(mesh, tets);
  for (std::size_t i = 0; i < behind.size(); ++i) {
    if (behind[i] == 3) mesh.triangle_owner[i] = 0;
  }
  EXPECT_EQ(give(mesh)[3], 0);
}

TEST(CentroidSearch, FindsWhatComparingAllFinds)
{
  // Tets of no volume at scattered points: only their centroids matter.
  RegionMesh mesh;
  std::uint32_t state = 1;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 8) / (1U << 24);
  };
  std::vector<Vec3> points;
  for (LocalIndex t = 0; t < 200; ++t) {
    // Coordinates on a coarse grid give many equal distances.
    const Vec3 p{std::floor(6 * random()), std::floor(6 * random()), std::floor(6 * random())};
    points.push_back(p);
    mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), p.begin(), p.end());
    for (int c = 0; c < 4; ++c) mesh.tet_vertices.push_back(t);
    mesh.tet_owner.push_back(t % 5);
  }
  const CentroidSearch search(mesh);
  for (int query = 0; query < 500; ++query) {
    const Vec3 p{std::floor(7 * random()), std::floor(7 * random()), std::floor(7 * random())};
    const auto allowed = static_cast<OwnerSet>(query % 32);
    double nearest = std::numeric_limits<double>::infinity();
    LocalIndex expected = kNoIndex;
    for (std::size_t t = 0; t < points.size(); ++t) {
      const LocalIndex owner = mesh.tet_owner[t];
      const double distance2 = dot(points[t] - p, points[t] - p);
      if (!contains(allowed, owner) || distance2 > nearest) continue;
      expected = distance2 < nearest ? owner : std::min(expected, owner);
      nearest = distance2;
    }
    EXPECT_EQ(search.nearest_owner(p, allowed), expected);
  }
}

}  // namespace
}  // namespace tessera::improve

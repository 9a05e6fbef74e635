// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/seam_regions.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::improve {
namespace {

using testing::Body;

Body octants_of(const mesh::CoarseMesh& cube) { return {cube, testing::octants(cube)}; }

// SeamRegions by phase and by how many subdomains meet there.
std::array<LocalIndex, kNumPhases> num_by_phase(const SeamRegions& regions)
{
  std::array<LocalIndex, kNumPhases> count{};
  for (int p = 0; p < kNumPhases; ++p) {
    count[static_cast<std::size_t>(p)] = regions.first_of_phase(p + 1) - regions.first_of_phase(p);
  }
  return count;
}

std::vector<LocalIndex> listed(std::span<const LocalIndex> values)
{
  return {values.begin(), values.end()};
}

TEST(SeamRegions, AreTheFacesCurvesAndPointsWhereOctantsMeet)
{
  const Body body = octants_of(testing::kuhn_cube(4));
  const SeamRegions regions(body.skeleton, body.decomposition);
  // Twelve faces between two octants, six curves between four, one point.
  EXPECT_EQ(num_by_phase(regions), (std::array<LocalIndex, 3>{12, 6, 1}));
  for (LocalIndex r = 0; r < regions.num_regions(); ++r) {
    const std::array<std::size_t, 3> expected{2, 4, 8};
    EXPECT_EQ(regions.subdomains_of(r).size(),
              expected[static_cast<std::size_t>(regions.phase_of(r))]);
  }
}

TEST(SeamRegions, StandInTheOrderOfTheirSubdomains)
{
  const Body body = octants_of(testing::kuhn_cube(2));
  const SeamRegions regions(body.skeleton, body.decomposition);
  EXPECT_EQ(listed(regions.subdomains_of(0)), (std::vector<LocalIndex>{0, 1}));
  EXPECT_EQ(listed(regions.subdomains_of(1)), (std::vector<LocalIndex>{0, 2}));
  EXPECT_EQ(listed(regions.subdomains_of(2)), (std::vector<LocalIndex>{0, 4}));
  EXPECT_EQ(listed(regions.subdomains_of(12)), (std::vector<LocalIndex>{0, 1, 2, 3}));
  EXPECT_EQ(listed(regions.subdomains_of(18)), (std::vector<LocalIndex>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(SeamRegions, AreListedForEachSubdomainThatTakesPart)
{
  const Body body = octants_of(testing::kuhn_cube(2));
  const SeamRegions regions(body.skeleton, body.decomposition);
  EXPECT_EQ(listed(regions.regions_of(0, 0)), (std::vector<LocalIndex>{0, 1, 2}));
  for (LocalIndex s = 0; s < 8; ++s) {
    for (int phase = 0; phase < kNumPhases; ++phase) {
      std::vector<LocalIndex> expected;
      for (LocalIndex r = regions.first_of_phase(phase); r < regions.first_of_phase(phase + 1);
           ++r) {
        const auto subdomains = regions.subdomains_of(r);
        if (std::find(subdomains.begin(), subdomains.end(), s) != subdomains.end()) {
          expected.push_back(r);
        }
      }
      EXPECT_EQ(listed(regions.regions_of(s, phase)), expected) << s << " phase " << phase;
    }
  }
}

TEST(SeamRegions, AreFoundByTheHostsOfTheSkeleton)
{
  const Body body = octants_of(testing::kuhn_cube(2));
  const SeamRegions regions(body.skeleton, body.decomposition);
  const mesh::HostLayout hosts(body.skeleton);
  for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
    const LocalIndex region = regions.region_of(hosts.triangle(t), 1);
    if (!body.skeleton.is_inside(t)) {
      EXPECT_EQ(region, kNoIndex);
      continue;
    }
    std::vector<LocalIndex> sides{body.skeleton.triangle_subdomains[2 * at(t)],
                                  body.skeleton.triangle_subdomains[2 * at(t) + 1]};
    std::sort(sides.begin(), sides.end());
    EXPECT_EQ(listed(regions.subdomains_of(region)), sides);
  }
  for (LocalIndex v = 0; v < body.skeleton.num_vertices(); ++v) {
    const Vec3 p = body.coarse.position(body.skeleton.vertex_coarse[at(v)]);
    const auto num_middle = std::count(p.begin(), p.end(), 0.5);
    const LocalIndex region = regions.region_of(hosts.vertex(v), 1);
    if (num_middle == 0) {
      EXPECT_EQ(region, kNoIndex);
    } else {
      EXPECT_EQ(regions.phase_of(region), num_middle - 1);
    }
  }
}

TEST(SeamRegions, KeepMaterialsApart)
{
  const Body body = octants_of(testing::two_material_cube(2));
  const SeamRegions regions(body.skeleton, body.decomposition);
  const mesh::HostLayout hosts(body.skeleton);
  // In each material four octants around one curve, which has four faces.
  EXPECT_EQ(num_by_phase(regions), (std::array<LocalIndex, 3>{8, 2, 0}));
  for (LocalIndex r = 0; r < regions.num_regions(); ++r) {
    const auto subdomains = regions.subdomains_of(r);
    for (const LocalIndex s : subdomains) {
      EXPECT_EQ(body.decomposition.subdomain_material[at(s)],
                body.decomposition.subdomain_material[at(subdomains.front())]);
    }
  }
  for (LocalIndex v = 0; v < body.skeleton.num_vertices(); ++v) {
    const Vec3 p = body.coarse.position(body.skeleton.vertex_coarse[at(v)]);
    if (p != Vec3{0.5, 0.5, 0.5}) continue;
    // The middle of the interface lies in four octants of either material.
    EXPECT_EQ(listed(regions.subdomains_of(regions.region_of(hosts.vertex(v), 1))),
              (std::vector<LocalIndex>{0, 2, 4, 6}));
    EXPECT_EQ(listed(regions.subdomains_of(regions.region_of(hosts.vertex(v), 2))),
              (std::vector<LocalIndex>{1, 3, 5, 7}));
  }
  for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
    if (body.skeleton.triangle_patch[at(t)] == kNoIndex) continue;
    EXPECT_EQ(regions.region_of(hosts.triangle(t), 1), kNoIndex);
  }
}

TEST(SeamRegions, HaveHostsOfTheirOwn)
{
  const Body body = octants_of(testing::kuhn_cube(2));
  const SeamRegions regions(body.skeleton, body.decomposition);
  const mesh::HostLayout hosts(body.skeleton);
  EXPECT_EQ(hosts.kind_of(regions.host_of(0)), mesh::HostKind::seam_region);
  EXPECT_EQ(hosts.row_of(regions.host_of(3)), 3);
  EXPECT_EQ(regions.region_of(hosts.piece(0), 1), kNoIndex);
  EXPECT_EQ(regions.region_of(regions.host_of(3), 1), kNoIndex);
  EXPECT_EQ(regions.region_made(regions.host_of(3)), 3);
  EXPECT_EQ(regions.region_made(hosts.triangle(0)), kNoIndex);
}

TEST(SeamRegions, SayWhoMayHoldAVertex)
{
  const Body body = octants_of(testing::kuhn_cube(2));
  const SeamRegions regions(body.skeleton, body.decomposition);
  const mesh::HostLayout hosts(body.skeleton);
  std::vector<std::set<LocalIndex>> holders_of_vertex(at(body.skeleton.num_vertices()));
  for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
    std::set<LocalIndex> sides;
    for (std::size_t side = 0; side < 2; ++side) {
      const LocalIndex s = body.skeleton.triangle_subdomains[2 * at(t) + side];
      if (s != kNoIndex) sides.insert(s);
    }
    EXPECT_TRUE(std::ranges::equal(regions.holders_of(hosts.triangle(t)), sides));
    for (std::size_t c = 0; c < 3; ++c) {
      holders_of_vertex[at(body.skeleton.triangle_vertices[3 * at(t) + c])].merge(std::set(sides));
    }
  }
  for (LocalIndex v = 0; v < body.skeleton.num_vertices(); ++v) {
    EXPECT_TRUE(std::ranges::equal(regions.holders_of(hosts.vertex(v)), holders_of_vertex[at(v)]));
  }
  EXPECT_TRUE(
      std::ranges::any_of(holders_of_vertex, [](const auto& set) { return set.size() == 8; }));
  EXPECT_TRUE(std::ranges::equal(regions.holders_of(regions.host_of(3)), regions.subdomains_of(3)));
}

TEST(SeamRegions, SayWhereTwoSubdomainsMayMeet)
{
  const Body body = octants_of(testing::kuhn_cube(2));
  const SeamRegions regions(body.skeleton, body.decomposition);
  const mesh::HostLayout hosts(body.skeleton);
  LocalIndex num_on_seams = 0;
  for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
    const bool is_seam = body.skeleton.is_inside(t);
    EXPECT_EQ(regions.may_be_on_seam(hosts.triangle(t)), is_seam);
    num_on_seams += is_seam ? 1 : 0;
  }
  EXPECT_GT(num_on_seams, 0);
  EXPECT_LT(num_on_seams, body.skeleton.num_triangles());
  EXPECT_TRUE(regions.may_be_on_seam(regions.host_of(0)));
}

TEST(SeamRegions, AreNoneWithOneSubdomain)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const Body body(cube, testing::one_subdomain_a_material(cube));
  EXPECT_EQ(SeamRegions(body.skeleton, body.decomposition).num_regions(), 0);
}

}  // namespace
}  // namespace tessera::improve

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/host_layout.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice.hpp"

#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

constexpr std::array kSkeletonKinds{HostKind::vertex, HostKind::edge, HostKind::triangle};

HostEntity host_of(const HostLayout& hosts, HostKind kind, LocalIndex row)
{
  switch (kind) {
    case HostKind::vertex:
      return hosts.vertex(row);
    case HostKind::edge:
      return hosts.edge(row);
    case HostKind::triangle:
      return hosts.triangle(row);
    case HostKind::piece:
      return hosts.piece(row);
    case HostKind::seam_region:
      return hosts.seam_region(row);
  }
  return kNoIndex;
}

// Counts up through all hosts, so it is also seen that they are dense.
void expect_one_after_the_other(const HostLayout& hosts, const std::array<LocalIndex, 5>& counts)
{
  HostEntity host = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto kind = static_cast<HostKind>(k);
    for (LocalIndex row = 0; row < counts[k]; ++row, ++host) {
      EXPECT_EQ(host_of(hosts, kind, row), host);
      EXPECT_EQ(hosts.kind_of(host), kind);
      EXPECT_EQ(hosts.row_of(host), row);
    }
  }
}

TEST(HostLayout, NumbersKindAfterKind)
{
  expect_one_after_the_other(HostLayout(5, 9, 7, 3), {5, 9, 7, 3, 4});
}

TEST(HostLayout, PassesOverKindsThatAreEmpty)
{
  expect_one_after_the_other(HostLayout(2, 0, 3, 0), {2, 0, 3, 0, 2});
  expect_one_after_the_other(HostLayout(0, 0, 0, 0), {0, 0, 0, 0, 2});
}

TEST(HostLayout, HasTheCountsOfTheSkeleton)
{
  const CoarseMesh coarse = testing::two_material_cube(4);
  const Skeleton skeleton = build_skeleton(coarse, testing::slabs(coarse, 2));
  const HostLayout hosts(skeleton);
  EXPECT_EQ(hosts.num_of(HostKind::vertex), skeleton.num_vertices());
  EXPECT_EQ(hosts.num_of(HostKind::edge), skeleton.num_edges());
  EXPECT_EQ(hosts.num_of(HostKind::triangle), skeleton.num_triangles());
  EXPECT_EQ(hosts.num_of(HostKind::piece), 4);
  EXPECT_EQ(hosts.num_on_skeleton(),
            skeleton.num_vertices() + skeleton.num_edges() + skeleton.num_triangles());
}

// Three corners, three sides and one inside make all points of a triangle's lattice.
TEST(HostLayout, HostsOfATriangleShareOutItsLattice)
{
  for (int levels = 0; levels <= lattice::kMaxLevels; ++levels) {
    const LocalIndex n = lattice::intervals(levels);
    GlobalIndex sum = 0;
    for (const HostKind kind : kSkeletonKinds) {
      sum += (kind == HostKind::triangle ? 1 : 3) * num_points_of_host(kind, n);
    }
    EXPECT_EQ(sum, lattice::num_triangle_points(n));
  }
}

TEST(HostLayout, OwnersAreTheLowestSubdomainsAround)
{
  const CoarseMesh coarse = testing::two_material_cube(4);
  const Skeleton skeleton = build_skeleton(coarse, testing::slabs(coarse, 2));
  const HostLayout hosts(skeleton);
  std::vector<LocalIndex> lowest(at(hosts.num_on_skeleton()), skeleton.num_subdomains());
  const auto see = [&](HostEntity host, LocalIndex subdomain) {
    lowest[at(host)] = std::min(lowest[at(host)], subdomain);
  };
  for (LocalIndex s = 0; s < skeleton.num_subdomains(); ++s) {
    for (const LocalIndex t : skeleton.triangles_of(s)) {
      see(hosts.triangle(t), s);
      for (std::size_t c = 0; c < 3; ++c) {
        see(hosts.vertex(skeleton.triangle_vertices[3 * at(t) + c]), s);
        see(hosts.edge(skeleton.triangle_edges[3 * at(t) + c]), s);
      }
    }
  }
  for (HostEntity host = 0; host < hosts.num_on_skeleton(); ++host) {
    EXPECT_EQ(owner_of_host(skeleton, hosts, host), lowest[at(host)]);
  }
}

TEST(HostPoint, ComesByHostThenByIndex)
{
  EXPECT_LT((HostPoint{1, 9}), (HostPoint{2, 0}));
  EXPECT_LT((HostPoint{2, 0}), (HostPoint{2, 1}));
  EXPECT_EQ((HostPoint{2, 1}), (HostPoint{2, 1}));
}

}  // namespace
}  // namespace tessera::mesh

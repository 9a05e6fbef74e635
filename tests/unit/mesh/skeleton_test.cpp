// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/skeleton.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

struct SkeletonOfCube : ::testing::Test {
  CoarseMesh coarse = testing::two_material_cube(4);
  Decomposition decomposition = testing::slabs(coarse, 2);  // Two slabs a material along y.
  Skeleton skeleton = build_skeleton(coarse, decomposition);
};

TEST_F(SkeletonOfCube, HoldsTheGeometryAndTheSeamsOnly)
{
  LocalIndex on_geometry = 0;
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    on_geometry += skeleton.triangle_patch[at(t)] != kNoIndex;
    EXPECT_NE(skeleton.triangle_subdomains[2 * at(t)], skeleton.triangle_subdomains[2 * at(t) + 1]);
  }
  EXPECT_EQ(on_geometry, coarse.num_faces());
}

// The divergence theorem: with the right sides, the skin of every subdomain encloses its volume.
TEST_F(SkeletonOfCube, TriangleSidesPointOutOfTheFirstSubdomain)
{
  std::vector<double> enclosed(at(decomposition.num_subdomains()), 0.0);
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    std::array<Vec3, 3> p;
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = skeleton.triangle_vertices[3 * at(t) + c];
      p[c] = coarse.position(skeleton.vertex_coarse[at(v)]);
    }
    const double volume = tet_volume({0, 0, 0}, p[0], p[1], p[2]);
    for (std::size_t side = 0; side < 2; ++side) {
      const LocalIndex s = skeleton.triangle_subdomains[2 * at(t) + side];
      if (s != kNoIndex) enclosed[at(s)] += side == 0 ? volume : -volume;
    }
  }
  for (const double volume : enclosed) EXPECT_NEAR(volume, 0.25, 1e-12);
}

TEST_F(SkeletonOfCube, OwnersAreTheLowestSubdomainAround)
{
  std::map<LocalIndex, LocalIndex> lowest;  // Over the tets, not over the skeleton.
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    for (const LocalIndex v : coarse.tet(t)) {
      const LocalIndex s = decomposition.tet_subdomain[at(t)];
      const auto [entry, is_new] = lowest.emplace(v, s);
      if (!is_new) entry->second = std::min(entry->second, s);
    }
  }
  for (LocalIndex v = 0; v < skeleton.num_vertices(); ++v) {
    EXPECT_EQ(skeleton.vertex_owner[at(v)], lowest.at(skeleton.vertex_coarse[at(v)]));
  }
}

TEST_F(SkeletonOfCube, SegmentsPutTheirEdgesOnCurves)
{
  LocalIndex on_curves = 0;
  for (LocalIndex e = 0; e < skeleton.num_edges(); ++e) {
    on_curves += skeleton.edge_curve[at(e)] != kNoIndex;
    if (skeleton.edge_curve[at(e)] != kNoIndex) {
      EXPECT_NE(skeleton.edge_patch[at(e)], kNoIndex);
    }
  }
  EXPECT_EQ(on_curves, coarse.num_segments());
}

TEST_F(SkeletonOfCube, OnlySeamsOfOneMaterialCountAsSeams)
{
  const std::vector<char> on_seam = hosts_on_seams(skeleton, decomposition);
  const HostLayout hosts(skeleton);
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const bool between_subdomains_of_one_material =
        skeleton.is_inside(t) && skeleton.triangle_patch[at(t)] == kNoIndex;
    EXPECT_EQ(on_seam[at(hosts.triangle(t))] != 0, between_subdomains_of_one_material);
  }
}

TEST(NeighboursByVertex, AreThoseThatTouch)
{
  const CoarseMesh cube = testing::kuhn_cube(4);
  const auto of = [&](const Decomposition& cut) {
    return neighbours_by_vertex(build_skeleton(cube, cut));
  };
  EXPECT_EQ(of(testing::slabs(cube, 4)),
            (std::vector<std::vector<LocalIndex>>{{1}, {0, 2}, {1, 3}, {2}}));
  const auto octants = of(testing::octants(cube));  // All of them meet in one vertex.
  ASSERT_EQ(octants.size(), 8U);
  EXPECT_EQ(octants[5], (std::vector<LocalIndex>{0, 1, 2, 3, 4, 6, 7}));
}

TEST_F(SkeletonOfCube, SkinsAreClosedAndTiedToTheSkeleton)
{
  for (LocalIndex s = 0; s < decomposition.num_subdomains(); ++s) {
    const Complex skin = skin_complex(skeleton, s);
    std::vector<int> triangles_of_edge(at(skin.num_edges()), 0);
    for (const LocalIndex e : skin.triangle_edges) ++triangles_of_edge[at(e)];
    EXPECT_TRUE(std::all_of(triangles_of_edge.begin(), triangles_of_edge.end(),
                            [](int count) { return count == 2; }));
    EXPECT_EQ(skin.num_vertices() - skin.num_edges() + skin.num_triangles(), 2);
    EXPECT_TRUE(std::is_sorted(skin.vertex_coarse.begin(), skin.vertex_coarse.end()));
  }
}

TEST_F(SkeletonOfCube, TheComplexOfAllTetsFindsTheWholeSkeleton)
{
  std::vector<LocalIndex> all(at(coarse.num_tets()));
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<LocalIndex>(t);

  const TetComplex complex = tet_complex(coarse, skeleton, all);

  const auto tied = [](const std::vector<LocalIndex>& links) {
    return std::count_if(links.begin(), links.end(), [](LocalIndex i) { return i != kNoIndex; });
  };
  EXPECT_EQ(tied(complex.faces.vertex_skeleton), skeleton.num_vertices());
  EXPECT_EQ(tied(complex.faces.edge_skeleton), skeleton.num_edges());
  EXPECT_EQ(tied(complex.faces.triangle_skeleton), skeleton.num_triangles());
  EXPECT_EQ(complex.faces.num_triangles(),
            static_cast<LocalIndex>(triangles_of_tets(coarse.tet_vertices).size()));
}

}  // namespace
}  // namespace tessera::mesh

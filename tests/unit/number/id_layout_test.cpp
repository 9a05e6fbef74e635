// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/id_layout.hpp"

#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice.hpp"

#include "support/bodies.hpp"
#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::number {
namespace {

using testing::Body;

// All on the same level.
mesh::LatticeLevels levels_of(const mesh::HostLayout& hosts, LocalIndex n)
{
  const auto level = static_cast<std::int8_t>(std::countr_zero(static_cast<unsigned>(n)));
  return {.edges = std::vector(at(hosts.num_of(mesh::HostKind::edge)), level),
          .triangles = std::vector(at(hosts.num_of(mesh::HostKind::triangle)), level)};
}

class IdsOfIntervals : public ::testing::TestWithParam<LocalIndex> {};

TEST_P(IdsOfIntervals, CountEveryVertexOfAllHostsOnce)
{
  const LocalIndex n = GetParam();
  const mesh::HostLayout hosts(5, 9, 7, 3);
  const std::vector<PieceCounts> pieces{{3, 10, 4}, {0, 1, 0}, {8, 30, 2}};
  const IdLayout ids = IdLayout::by_host(hosts, levels_of(hosts, n), pieces);
  ASSERT_TRUE(ids.is_by_host());
  std::vector<int> times(static_cast<std::size_t>(ids.num_vertices()), 0);
  for (mesh::HostEntity host = 0; host < hosts.seam_region(0); ++host) {
    const mesh::HostKind kind = hosts.kind_of(host);
    const GlobalIndex points = kind == mesh::HostKind::piece
                                   ? pieces[at(hosts.row_of(host))].interior_vertices
                                   : mesh::num_points_of_host(kind, n);
    for (LocalIndex i = 0; i < points; ++i) {
      ++times.at(static_cast<std::size_t>(ids.vertex_id({host, i})));
    }
  }
  for (const int count : times) EXPECT_EQ(count, 1);
  EXPECT_EQ(ids.num_tets(), 41);
  EXPECT_EQ(ids.num_boundary_triangles(), 6);
}

// With the skins that refine really makes: what two pieces share has one id.
TEST_P(IdsOfIntervals, OfSkinsAreDenseAndShared)
{
  int levels = 0;
  while (mesh::lattice::intervals(levels) < GetParam()) ++levels;
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const Body body(cube, testing::slabs(cube, 2));
  const IdLayout ids =
      IdLayout::by_host(mesh::HostLayout(body.skeleton),
                        mesh::lattice_levels(body.skeleton, levels), std::vector<PieceCounts>(4));
  std::map<GlobalIndex, std::array<std::uint64_t, 3>> position_of;
  std::set<std::array<std::uint64_t, 3>> positions;
  for (LocalIndex s = 0; s < 4; ++s) {
    const mesh::Skin skin = testing::skin_of(body, testing::FlatModel(), levels, s);
    for (LocalIndex v = 0; v < skin.num_vertices(); ++v) {
      const auto id = ids.vertex_id({skin.vertex_host[at(v)], skin.vertex_index[at(v)]});
      const auto point = testing::bits(point_at(std::span<const double>(skin.vertex_xyz), v));
      EXPECT_EQ(position_of.emplace(id, point).first->second, point);
      positions.insert(point);
    }
  }
  EXPECT_EQ(static_cast<GlobalIndex>(position_of.size()), ids.num_vertices());
  EXPECT_EQ(position_of.begin()->first, 0);
  EXPECT_EQ(position_of.rbegin()->first, ids.num_vertices() - 1);
  EXPECT_EQ(positions.size(), position_of.size());
}

INSTANTIATE_TEST_SUITE_P(Intervals, IdsOfIntervals, ::testing::Values(1, 2, 4, 8));

TEST(IdLayout, CellsArePrefixSums)
{
  const std::vector<PieceCounts> pieces{{0, 10, 4}, {0, 0, 0}, {0, 5, 1}};
  const mesh::HostLayout hosts(1, 1, 1, 3);
  const IdLayout ids = IdLayout::by_host(hosts, levels_of(hosts, 1), pieces);
  EXPECT_EQ(ids.first_tet(0), 0);
  EXPECT_EQ(ids.first_tet(1), 10);
  EXPECT_EQ(ids.first_tet(2), 10);
  EXPECT_EQ(ids.first_boundary_triangle(2), 4);
  EXPECT_EQ(ids.num_tets(), 15);
  EXPECT_EQ(ids.num_boundary_triangles(), 5);
}

TEST(IdLayout, WithoutPiecesHasTheSkeletonOnly)
{
  const mesh::HostLayout hosts(4, 6, 4, 0);
  const IdLayout ids = IdLayout::by_host(hosts, levels_of(hosts, 4), {});
  EXPECT_EQ(ids.num_vertices(), 4 + 6 * 3 + 4 * 3);
  EXPECT_EQ(ids.num_tets(), 0);
  EXPECT_EQ(IdLayout::by_host(mesh::HostLayout(0, 0, 0, 0), {}, {}).num_vertices(), 0);
}

TEST(IdLayout, CountsBeyond32Bits)
{
  constexpr GlobalIndex kMany = 3'000'000'000;
  const LocalIndex n = mesh::lattice::intervals(mesh::lattice::kMaxLevels);
  const LocalIndex num_edges = 15'000'000;
  const LocalIndex num_triangles = 10'000'000;
  const mesh::HostLayout hosts(5'000'000, num_edges, num_triangles, 2);
  const IdLayout ids = IdLayout::by_host(hosts, levels_of(hosts, n),
                                         {{kMany, 2 * kMany, kMany}, {kMany, 2 * kMany, kMany}});
  const GlobalIndex of_edges = GlobalIndex{1023} * num_edges;
  const GlobalIndex of_triangles = GlobalIndex{1023 * 1022 / 2} * num_triangles;
  const GlobalIndex on_skeleton = 5'000'000 + of_edges + of_triangles;
  EXPECT_EQ(ids.vertex_id({hosts.edge(num_edges - 1), 1022}), 5'000'000 + of_edges - 1);
  EXPECT_EQ(ids.vertex_id({hosts.triangle(0), 0}), 5'000'000 + of_edges);
  EXPECT_EQ(ids.vertex_id({hosts.triangle(num_triangles - 1), 1023 * 1022 / 2 - 1}),
            on_skeleton - 1);
  EXPECT_EQ(ids.interior_vertex_id(0, 0), on_skeleton);
  EXPECT_EQ(ids.interior_vertex_id(1, 7), on_skeleton + kMany + 7);
  EXPECT_EQ(ids.num_vertices(), on_skeleton + 2 * kMany);
  EXPECT_EQ(ids.first_tet(1), 2 * kMany);
  EXPECT_EQ(ids.num_tets(), 4 * kMany);
  EXPECT_EQ(ids.num_boundary_triangles(), 2 * kMany);
}

TEST(IdLayout, EdgesOnLinesAreCountedPieceByPiece)
{
  const IdLayout ids = IdLayout::by_owner({{.line_edges = 3}, {}, {.line_edges = 2}, {}});
  EXPECT_EQ(ids.first_line_edge(1), 3);
  EXPECT_EQ(ids.first_line_edge(2), 3);
  EXPECT_EQ(ids.first_line_edge(3), 5);
}

TEST(IdLayout, ByOwnerCountsThePiecesOneAfterTheOther)
{
  const std::vector<PieceCounts> pieces{{.interior_vertices = 3, .tets = 10, .owned_vertices = 7},
                                        {.interior_vertices = 1, .tets = 4, .owned_vertices = 0},
                                        {.interior_vertices = 0, .tets = 5, .owned_vertices = 2}};
  const IdLayout ids = IdLayout::by_owner(pieces);
  EXPECT_FALSE(ids.is_by_host());
  EXPECT_EQ(ids.owned_vertex_id(0, 0), 0);
  EXPECT_EQ(ids.owned_vertex_id(0, 6), 6);
  EXPECT_EQ(ids.owned_vertex_id(2, 1), 8);
  EXPECT_EQ(ids.num_vertices(), 9);
  EXPECT_EQ(ids.first_tet(2), 14);
  EXPECT_EQ(ids.num_tets(), 19);
}

}  // namespace
}  // namespace tessera::number

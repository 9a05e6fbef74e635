// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_surface.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/piece_sets.hpp"

#include "split_pieces.hpp"

namespace tessera::subdomain {
namespace {

struct SurfaceOfAPiece : ::testing::Test {
  testing::Body ball{testing::ball(2), testing::halves(testing::ball(2))};
  testing::SphereModel sphere{{1.0}};
  std::vector<FilledPiece> filled = testing::fill_all(ball, sphere, 1, fill::KernelKind::optimize);
  mesh::Piece& piece = filled.front().piece;
};

TEST_F(SurfaceOfAPiece, IsItsSkin)
{
  const number::SurfaceList list = surface_of(piece);
  const mesh::Skin skin = testing::skin_of(ball, sphere, 1, 0);
  EXPECT_EQ(list.subdomain, 0);
  EXPECT_EQ(std::ssize(list.simplices.triangles), skin.num_triangles());
  EXPECT_EQ(std::ssize(list.simplices.vertices), skin.num_vertices());
  EXPECT_EQ(2 * std::ssize(list.simplices.edges), 3 * skin.num_triangles());
  EXPECT_TRUE(std::ranges::is_sorted(list.simplices.triangles));
  EXPECT_TRUE(std::ranges::is_sorted(list.simplices.edges));
}

TEST_F(SurfaceOfAPiece, NamesAVertexWithoutAName)
{
  piece.skin_host.pop_back();
  piece.skin_index.pop_back();
  EXPECT_THROW(static_cast<void>(surface_of(piece)), MeshError);
}

TEST_F(SurfaceOfAPiece, RefusesATriangleOfThreeTets)
{
  const std::vector<LocalIndex> tet(piece.tet_vertices.begin(), piece.tet_vertices.begin() + 4);
  piece.tet_vertices.insert(piece.tet_vertices.end(), tet.begin(), tet.end());
  EXPECT_THROW(static_cast<void>(surface_of(piece)), MeshError);
}

TEST_F(SurfaceOfAPiece, HaloIsTheTetsAtTheSeam)
{
  const number::SurfaceList own = surface_of(piece);
  const number::SurfaceList other = surface_of(filled.back().piece);
  const mesh::Piece halo = halo_of(piece, own, number::compare_surfaces(own, {{other}}));
  const auto on_seam = testing::vertices_on_seams({piece, filled.back().piece});
  LocalIndex num_touching = 0;
  for (auto v = piece.tet_vertices.begin(); v != piece.tet_vertices.end(); v += 4) {
    num_touching += std::any_of(v, v + 4, [&](LocalIndex i) { return on_seam[0][at(i)] != 0; });
  }
  EXPECT_EQ(halo.num_tets(), num_touching);
  EXPECT_LT(halo.num_tets(), piece.num_tets());
  EXPECT_EQ(halo.subdomain, piece.subdomain);
  EXPECT_EQ(halo.num_boundary(), 0);
}

TEST_F(SurfaceOfAPiece, AVertexOfNoTetIsRefused)
{
  piece.vertex_xyz.insert(piece.vertex_xyz.end(), {0.0, 0.0, 0.0});
  EXPECT_THROW(static_cast<void>(testing::split_all(ball, sphere, {1, 2}, filled)), MeshError);
}

}  // namespace
}  // namespace tessera::subdomain

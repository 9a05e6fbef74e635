// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/verify/seams.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::verify {
namespace {

using testing::Body;

std::vector<Hash128> sums_of(const std::vector<mesh::Skin>& skins, const mesh::Skeleton& skeleton)
{
  std::vector<Hash128> sums(at(skeleton.num_triangles()));
  for (const mesh::Skin& skin : skins) {
    for (const SeamHash& seam : seam_hashes(skin, skeleton)) sums[at(seam.triangle)] += seam.hash;
  }
  return sums;
}

// A ball of two halves, refined twice; the second half is what the tests damage.
struct SeamOfBall : ::testing::Test {
  const Body body{testing::ball(2), testing::halves(testing::ball(2))};
  const testing::SphereModel sphere{{1.0}};
  std::vector<mesh::Skin> skins{testing::skin_of(body, sphere, 2, 0),
                                testing::skin_of(body, sphere, 2, 1)};
  mesh::Skin& skin = skins[1];

  // The first fine triangle on the seam.
  [[nodiscard]] std::size_t seam_triangle() const
  {
    const auto place =
        std::find_if(skin.triangle_parent.begin(), skin.triangle_parent.end(),
                     [&](LocalIndex parent) { return body.skeleton.is_inside(parent); });
    return static_cast<std::size_t>(place - skin.triangle_parent.begin());
  }

  [[nodiscard]] std::size_t seam_vertex() const
  {
    return at(skin.triangle_vertices[3 * seam_triangle()]);
  }

  [[nodiscard]] bool is_open() const
  {
    return first_open_seam(sums_of(skins, body.skeleton), body.skeleton).has_value();
  }
};

TEST_F(SeamOfBall, CancelsSeenFromBothSides)
{
  EXPECT_FALSE(is_open());
  const auto hashes = seam_hashes(skin, body.skeleton);
  EXPECT_FALSE(hashes.empty());
  for (const SeamHash& seam : hashes) EXPECT_FALSE(seam.hash == Hash128{});
}

TEST_F(SeamOfBall, HasOneHashForEachTriangleBetweenSubdomainsAscending)
{
  std::vector<LocalIndex> inside;
  for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
    if (body.skeleton.is_inside(t)) inside.push_back(t);
  }
  std::vector<LocalIndex> found;
  for (const SeamHash& seam : seam_hashes(skin, body.skeleton)) found.push_back(seam.triangle);
  EXPECT_EQ(found, inside);
}

TEST_F(SeamOfBall, OneSideAloneIsOpen)
{
  skins.pop_back();
  EXPECT_TRUE(is_open());
}

TEST_F(SeamOfBall, OneSideTwiceIsOpen)
{
  skins[0] = skins[1];
  EXPECT_TRUE(is_open());
}

TEST_F(SeamOfBall, OneChangedBitOfAPositionOpensIt)
{
  const std::vector<double> intact = skin.vertex_xyz;
  for (std::size_t d = 0; d < 3; ++d) {
    double& x = skin.vertex_xyz[3 * seam_vertex() + d];
    x = std::nextafter(x, 2.0);
    EXPECT_TRUE(is_open()) << d;
    skin.vertex_xyz = intact;
  }
  EXPECT_FALSE(is_open());
}

TEST_F(SeamOfBall, OneFlippedTriangleOpensIt)
{
  const std::size_t t = seam_triangle();
  std::swap(skin.triangle_vertices[3 * t], skin.triangle_vertices[3 * t + 1]);
  EXPECT_TRUE(is_open());
}

TEST_F(SeamOfBall, AllTrianglesFlippedOpenIt)
{
  for (std::size_t t = 0; t < skin.triangle_parent.size(); ++t) {
    std::swap(skin.triangle_vertices[3 * t], skin.triangle_vertices[3 * t + 1]);
  }
  EXPECT_TRUE(is_open());
}

TEST_F(SeamOfBall, ATurnedTriangleIsTheSame)
{
  for (std::size_t t = 0; t < skin.triangle_parent.size(); ++t) {
    const auto first = skin.triangle_vertices.begin() + static_cast<std::ptrdiff_t>(3 * t);
    std::rotate(first, first + 1, first + 3);
  }
  EXPECT_FALSE(is_open());
}

TEST_F(SeamOfBall, AWrongUnitOrIndexOpensIt)
{
  const std::size_t v = seam_vertex();
  ++skin.vertex_index[v];
  EXPECT_TRUE(is_open());
  --skin.vertex_index[v];
  ++skin.vertex_host[v];
  EXPECT_TRUE(is_open());
}

TEST_F(SeamOfBall, TwoSwappedIndicesOpenIt)
{
  const std::size_t t = seam_triangle();
  const auto v = at(skin.triangle_vertices[3 * t]);
  const auto w = at(skin.triangle_vertices[3 * t + 1]);
  std::swap(skin.vertex_index[v], skin.vertex_index[w]);
  std::swap(skin.vertex_host[v], skin.vertex_host[w]);
  EXPECT_TRUE(is_open());
}

TEST_F(SeamOfBall, AMissingTriangleOpensIt)
{
  const auto t = static_cast<std::ptrdiff_t>(seam_triangle());
  skin.triangle_parent.erase(skin.triangle_parent.begin() + t);
  skin.triangle_vertices.erase(skin.triangle_vertices.begin() + 3 * t,
                               skin.triangle_vertices.begin() + 3 * t + 3);
  EXPECT_TRUE(is_open());
}

TEST_F(SeamOfBall, WhatHappensOutsideDoesNotMatter)
{
  for (std::size_t t = 0; t < skin.triangle_parent.size(); ++t) {
    if (body.skeleton.is_inside(skin.triangle_parent[t])) continue;
    std::swap(skin.triangle_vertices[3 * t], skin.triangle_vertices[3 * t + 1]);
  }
  EXPECT_FALSE(is_open());
}

TEST_F(SeamOfBall, NamesTheSubdomainsThatDoNotMeet)
{
  skins.pop_back();
  const auto text = first_open_seam(sums_of(skins, body.skeleton), body.skeleton);
  ASSERT_TRUE(text.has_value());
  EXPECT_NE(text->find("subdomains"), std::string::npos);
  EXPECT_NE(text->find('0'), std::string::npos);
  EXPECT_NE(text->find('1'), std::string::npos);
}

TEST(Seams, CloseBetweenMaterialsAndAtEveryLevel)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const Body body(cube, testing::slabs(cube, 2));
  for (int levels = 0; levels < 4; ++levels) {
    std::vector<mesh::Skin> skins;
    for (LocalIndex s = 0; s < 4; ++s) {
      skins.push_back(testing::skin_of(body, testing::FlatModel(), levels, s));
    }
    const auto sums = sums_of(skins, body.skeleton);
    EXPECT_EQ(first_open_seam(sums, body.skeleton), std::nullopt) << levels;
  }
}

TEST(Seams, OfOneSubdomainAreNone)
{
  const Body body(testing::ball(2), testing::one_subdomain_a_material(testing::ball(2)));
  const auto skin = testing::skin_of(body, testing::SphereModel({1.0}), 1, 0);
  EXPECT_TRUE(seam_hashes(skin, body.skeleton).empty());
  EXPECT_TRUE(seam_hashes(mesh::Skin{}, body.skeleton).empty());
  EXPECT_EQ(first_open_seam(sums_of({skin}, body.skeleton), body.skeleton), std::nullopt);
}

// Two tets that share a face: the second one on the other side of it.
struct SurfaceOfTwo : ::testing::Test {
  static mesh::Piece tet(std::vector<double> xyz, std::vector<LocalIndex> index)
  {
    mesh::Piece piece;
    piece.vertex_xyz = std::move(xyz);
    piece.skin_host.assign(index.size(), 3);
    piece.skin_index = std::move(index);
    piece.tet_vertices = {0, 1, 2, 3};
    return piece;
  }
  const mesh::Piece below =
      tet({0, 0, -1, 0, 0, 0, 0, 1, 0, 1, 0, 0}, {9, 0, 1, 2});  // Face 0 1 2 is its corner 0's.
  mesh::Piece above = tet({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, {8, 0, 2, 1});

  [[nodiscard]] mesh::Piece both() const
  {
    mesh::Piece piece = below;
    piece.vertex_xyz.insert(piece.vertex_xyz.end(), {0, 0, 1});
    piece.skin_host.push_back(3);
    piece.skin_index.push_back(8);
    piece.tet_vertices.insert(piece.tet_vertices.end(), {4, 1, 3, 2});
    return piece;
  }

  [[nodiscard]] bool cancels() const
  {
    Hash128 sum = surface_hash(below);
    sum += surface_hash(above);
    return sum == surface_hash(both());
  }
};

TEST_F(SurfaceOfTwo, InnerFacesCancelWithinAPieceAndBetweenPieces) { EXPECT_TRUE(cancels()); }

TEST_F(SurfaceOfTwo, OtherPositionIsNoticed)
{
  above.vertex_xyz[3] = 1e-300;
  EXPECT_FALSE(cancels());
}

TEST_F(SurfaceOfTwo, OtherVertexIsNoticed)
{
  above.skin_index[1] = 5;
  EXPECT_FALSE(cancels());
}

TEST_F(SeamOfBall, OutsideDependsOnNothingInside)
{
  std::vector<char> is_outside(at(skin.num_vertices()), 0);
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    if (body.skeleton.is_inside(skin.triangle_parent[at(t)])) continue;
    for (std::size_t c = 0; c < 3; ++c) is_outside[at(skin.triangle_vertices[3 * at(t) + c])] = 1;
  }
  const auto move_one = [&](char outside) {
    const auto v = std::find(is_outside.begin(), is_outside.end(), outside) - is_outside.begin();
    skin.vertex_xyz.at(3 * static_cast<std::size_t>(v)) += 1e-12;
  };
  const Hash128 before = outside_hash(skin, body.skeleton);
  move_one(0);
  EXPECT_TRUE(outside_hash(skin, body.skeleton) == before);
  move_one(1);
  EXPECT_FALSE(outside_hash(skin, body.skeleton) == before);
}

}  // namespace
}  // namespace tessera::verify

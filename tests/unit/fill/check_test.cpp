// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/meshes.hpp"

namespace tessera::fill {
namespace {

// A cube of 3^3 cells: its skin, and its tets with the skin's vertices first.
struct CubeFill : ::testing::Test {
  FillInput skin{};
  FillOutput tets{};

  CubeFill()
  {
    const mesh::CoarseMesh cube = testing::kuhn_cube(3);
    std::map<LocalIndex, LocalIndex> place;
    const auto place_of = [&](LocalIndex v) {
      const auto [entry, is_new] = place.emplace(v, static_cast<LocalIndex>(place.size()));
      if (is_new) {
        const Vec3 p = cube.position(v);
        tets.vertex_xyz.insert(tets.vertex_xyz.end(), p.begin(), p.end());
      }
      return entry->second;
    };
    for (const auto& triangle : mesh::triangles_of_tets(cube.tet_vertices)) {
      if (triangle.tets[1] != kNoIndex) continue;
      for (const std::size_t c : mesh::kTetFaceCorners[at(triangle.corners[0])]) {
        skin.triangle_vertices.push_back(place_of(cube.tet(triangle.tets[0])[c]));
      }
    }
    skin.vertex_xyz = tets.vertex_xyz;
    for (const LocalIndex v : cube.tet_vertices) tets.tet_vertices.push_back(place_of(v));
  }

  [[nodiscard]] LocalIndex num_skin_vertices() const
  {
    return static_cast<LocalIndex>(skin.vertex_xyz.size() / 3);
  }

  // The first tet without a vertex on the skin's corner, that is: any with an inner vertex.
  [[nodiscard]] std::size_t tet_with_inner_vertex() const
  {
    const auto v = std::find_if(tets.tet_vertices.begin(), tets.tet_vertices.end(),
                                [&](LocalIndex i) { return i >= num_skin_vertices(); });
    return static_cast<std::size_t>(v - tets.tet_vertices.begin()) / 4;
  }

  void add_tet(std::array<LocalIndex, 4> tet)
  {
    tets.tet_vertices.insert(tets.tet_vertices.end(), tet.begin(), tet.end());
  }

  void expect_refused(const std::string& because) const
  {
    try {
      static_cast<void>(check_fill(skin, tets));
      ADD_FAILURE() << "accepted";
    } catch (const MeshError& error) {
      EXPECT_NE(std::string(error.what()).find(because), std::string::npos) << error.what();
    }
  }
};

TEST_F(CubeFill, IsAcceptedAndMeasured)
{
  const FillFacts facts = check_fill(skin, tets);
  EXPECT_NEAR(facts.volume, 1.0, 1e-14);
  EXPECT_NEAR(enclosed_volume(skin), 1.0, 1e-14);
}

TEST_F(CubeFill, NamesTheTetBehindEveryTriangle)
{
  const FillFacts facts = check_fill(skin, tets);
  ASSERT_EQ(facts.triangle_tet.size(), skin.triangle_vertices.size() / 3);
  for (std::size_t t = 0; t < facts.triangle_tet.size(); ++t) {
    const auto* tet = &tets.tet_vertices[4 * at(facts.triangle_tet[t])];
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(std::count(tet, tet + 4, skin.triangle_vertices[3 * t + c]), 1);
    }
  }
}

TEST_F(CubeFill, MayListTetsInAnyOrder)
{
  for (std::size_t t = 0; t + 1 < tets.tet_vertices.size() / 4; t += 2) {
    std::swap_ranges(&tets.tet_vertices[4 * t], &tets.tet_vertices[4 * t] + 4,
                     &tets.tet_vertices[4 * t + 4]);
  }
  EXPECT_NO_THROW(static_cast<void>(check_fill(skin, tets)));
}

TEST_F(CubeFill, SkinVertexMovedByOneBitIsRefused)
{
  tets.vertex_xyz[10] = std::nextafter(tets.vertex_xyz[10], 2.0);
  expect_refused("vertices of the skin");
}

TEST_F(CubeFill, SignOfAZeroCounts)
{
  const auto zero = std::find(tets.vertex_xyz.begin(), tets.vertex_xyz.end(), 0.0);
  *zero = -0.0;
  expect_refused("vertices of the skin");
}

TEST_F(CubeFill, LostSkinVerticesAreRefused)
{
  tets.vertex_xyz.resize(skin.vertex_xyz.size() - 3);
  expect_refused("vertices of the skin");
}

TEST_F(CubeFill, LostTetAtTheSkinIsRefused)
{
  tets.tet_vertices.resize(tets.tet_vertices.size() - 4);
  expect_refused("boundary is not the skin");
}

TEST_F(CubeFill, LostTetInsideIsRefused)
{
  const auto first = static_cast<std::ptrdiff_t>(4 * tet_with_inner_vertex());
  tets.tet_vertices.erase(tets.tet_vertices.begin() + first, tets.tet_vertices.begin() + first + 4);
  expect_refused("boundary is not the skin");
}

TEST_F(CubeFill, TetListedTwiceIsRefused)
{
  const std::size_t t = tet_with_inner_vertex();
  const auto* v = &tets.tet_vertices[4 * t];
  add_tet({v[0], v[1], v[2], v[3]});
  EXPECT_THROW(static_cast<void>(check_fill(skin, tets)), MeshError);
}

// Two equal tets pair up each other's faces, but the wrong way round.
TEST_F(CubeFill, TwoEqualTetsApartAreRefused)
{
  const auto first = static_cast<LocalIndex>(tets.vertex_xyz.size() / 3);
  tets.vertex_xyz.insert(tets.vertex_xyz.end(), {.4, .4, .4, .5, .4, .4, .4, .5, .4, .4, .4, .5});
  for (int times = 0; times < 2; ++times) add_tet({first, first + 1, first + 2, first + 3});
  expect_refused("boundary is not the skin");
}

TEST_F(CubeFill, InvertedTetIsRefused)
{
  const std::size_t t = tet_with_inner_vertex();
  std::swap(tets.tet_vertices[4 * t], tets.tet_vertices[4 * t + 1]);
  EXPECT_THROW(static_cast<void>(check_fill(skin, tets)), MeshError);
}

TEST_F(CubeFill, InnerVertexBeyondTheSkinIsRefused)
{
  tets.vertex_xyz.back() += 5.0;
  expect_refused("has volume");
}

TEST_F(CubeFill, FlatTetIsRefused)
{
  std::copy_n(tets.vertex_xyz.end() - 6, 3, tets.vertex_xyz.end() - 3);
  expect_refused("has volume");
}

TEST_F(CubeFill, UnusedVertexIsRefused)
{
  tets.vertex_xyz.insert(tets.vertex_xyz.end(), {0.5, 0.5, 0.5});
  expect_refused("belongs to no tet");
}

TEST_F(CubeFill, VertexNumbersOutOfRangeAreRefused)
{
  for (const LocalIndex wrong : {-1, static_cast<LocalIndex>(tets.vertex_xyz.size() / 3)}) {
    FillOutput broken = tets;
    broken.tet_vertices[7] = wrong;
    EXPECT_THROW(static_cast<void>(check_fill(skin, broken)), MeshError) << wrong;
  }
}

TEST_F(CubeFill, ExtraTetOutsideIsRefused)
{
  const auto outside = static_cast<LocalIndex>(tets.vertex_xyz.size() / 3);
  const Vec3 a = point_at(std::span<const double>(skin.vertex_xyz), skin.triangle_vertices[0]);
  const Vec3 away = a + 3.0 * (a - Vec3{0.5, 0.5, 0.5});
  tets.vertex_xyz.insert(tets.vertex_xyz.end(), away.begin(), away.end());
  const auto* v = skin.triangle_vertices.data();
  add_tet({v[0], v[1], v[2], outside});
  expect_refused("boundary is not the skin");
}

// All tets swapped: the boundary is the skin turned inside out.
TEST_F(CubeFill, WrongOrientationIsRefused)
{
  for (std::size_t t = 0; t < tets.tet_vertices.size(); t += 4) {
    std::swap(tets.tet_vertices[t], tets.tet_vertices[t + 1]);
  }
  expect_refused("boundary is not the skin");
}

TEST_F(CubeFill, SkinInsideOutIsRefused)
{
  for (std::size_t t = 0; t < skin.triangle_vertices.size(); t += 3) {
    std::swap(skin.triangle_vertices[t], skin.triangle_vertices[t + 1]);
  }
  expect_refused("boundary is not the skin");
}

TEST_F(CubeFill, NotANumberIsRefused)
{
  tets.vertex_xyz.back() = std::numeric_limits<double>::quiet_NaN();
  expect_refused("has volume");
}

TEST_F(CubeFill, InfinityIsRefused)
{
  tets.vertex_xyz.back() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(static_cast<void>(check_fill(skin, tets)), MeshError);
}

TEST_F(CubeFill, NoTetsAreRefused)
{
  tets.tet_vertices.clear();
  EXPECT_THROW(static_cast<void>(check_fill(skin, tets)), MeshError);
}

TEST_F(CubeFill, HalfARowIsRefused)
{
  FillOutput cut = tets;
  cut.tet_vertices.pop_back();
  EXPECT_THROW(static_cast<void>(check_fill(skin, cut)), MeshError);
  FillOutput torn = tets;
  torn.vertex_xyz.pop_back();
  EXPECT_THROW(static_cast<void>(check_fill(skin, torn)), MeshError);
}

// A body far from the origin keeps its digits.
TEST_F(CubeFill, FarFromTheOriginIsAccepted)
{
  for (auto* xyz : {&skin.vertex_xyz, &tets.vertex_xyz}) {
    for (double& x : *xyz) x += 4096.0;
  }
  EXPECT_NEAR(check_fill(skin, tets).volume, 1.0, 1e-9);
}

TEST(EnclosedVolume, OfNothingIsZero) { EXPECT_EQ(enclosed_volume({}), 0.0); }

}  // namespace
}  // namespace tessera::fill

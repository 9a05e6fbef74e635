// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/layers/column_ends.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/layers/grow_layers.hpp"
#include "tessera/mesh/lattice.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::subdomain {
namespace {

constexpr LocalIndex kIntervals = 4;

// A cube with one layer on x = 0 and two thicker ones on y = 0.
class ColumnEndsTest : public ::testing::Test {
 protected:
  ColumnEndsTest() : coarse_(layered_cube()), body_(coarse_, testing::slabs(coarse_, 1)) {}

  static mesh::CoarseMesh layered_cube()
  {
    mesh::CoarseMesh cube = testing::kuhn_cube(3);
    const std::vector<layers::LayerOptions> options{
        {.patch = cube.patch_names[0], .first = 0.03, .count = 1},
        {.patch = cube.patch_names[2], .first = 0.05, .growth = 2.0, .count = 2}};
    (void)layers::grow_layers(cube, options, testing::FlatModel(), true);
    return cube;
  }

  [[nodiscard]] LocalIndex coarse_vertex(LocalIndex edge, std::size_t end) const
  {
    return body_.skeleton.vertex_coarse[at(body_.skeleton.edge_vertices[2 * at(edge) + end])];
  }
  [[nodiscard]] LocalIndex stack(LocalIndex v) const { return coarse_.layers.vertex_stack[at(v)]; }
  [[nodiscard]] Vec3 column(LocalIndex v) const
  {
    return coarse_.position(v) - coarse_.layers.wall(v);
  }
  // Where a layer ends above the wall at a coarse vertex.
  [[nodiscard]] Vec3 end_of(LocalIndex v, LocalIndex layer) const
  {
    return (1.0 - coarse_.layers.ends_of(stack(v))[at(layer)]) * column(v);
  }

  mesh::CoarseMesh coarse_;
  testing::Body body_;
};

TEST_F(ColumnEndsTest, AreInterpolatedBetweenCoarseVertices)
{
  int num_alike = 0;
  int num_mixed = 0;
  for (LocalIndex e = 0; e < body_.skeleton.num_edges(); ++e) {
    const LocalIndex a = coarse_vertex(e, 0);
    const LocalIndex b = coarse_vertex(e, 1);
    if (!body_.skeleton.is_on_wall(e) || column(a) == Vec3{} || column(b) == Vec3{}) continue;
    ++(stack(a) == stack(b) ? num_alike : num_mixed);
    ColumnEnds ends(body_.coarse, body_.skeleton, mesh::HostKind::edge, e, kIntervals);
    for (LocalIndex k = 1; k < kIntervals; ++k) {
      const double t = static_cast<double>(k) / kIntervals;
      const Vec3 here = (1.0 - t) * column(a) + t * column(b);
      const auto found = ends.at_point(k - 1);
      ASSERT_EQ(found.size(), 2U);
      for (LocalIndex layer = 0; layer < 2; ++layer) {
        const auto& [part, aside] = found[at(layer)];
        const Vec3 wanted = (1.0 - t) * end_of(a, layer) + t * end_of(b, layer);
        EXPECT_LT(norm((1.0 - part) * here + aside - wanted), 1e-15);
      }
      EXPECT_EQ(found[1].part, 1.0);
      EXPECT_EQ(found[1].aside, Vec3{});
    }
  }
  EXPECT_GT(num_alike, 10);
  EXPECT_GT(num_mixed, 3);
}

TEST_F(ColumnEndsTest, AreInterpolatedOnTriangles)
{
  int num_mixed = 0;
  for (LocalIndex t = 0; t < body_.skeleton.num_triangles(); ++t) {
    if (!coarse_.layers.is_wall(body_.skeleton.triangle_patch[at(t)])) continue;
    std::array<LocalIndex, 3> v{};
    for (std::size_t c = 0; c < 3; ++c) {
      v[c] = body_.skeleton.vertex_coarse[at(body_.skeleton.triangle_vertices[3 * at(t) + c])];
    }
    if (std::ranges::count(v, stack(v[0]), [&](LocalIndex one) { return stack(one); }) == 3)
      continue;
    ++num_mixed;
    ColumnEnds ends(body_.coarse, body_.skeleton, mesh::HostKind::triangle, t, kIntervals);
    for (const auto& [i, j] : {std::pair(1, 1), std::pair(2, 1), std::pair(1, 2)}) {
      const auto found = ends.at_point(mesh::lattice::inner_triangle_index(kIntervals, i, j));
      const std::array<double, 3> weight{(kIntervals - i - j) / 4.0, i / 4.0, j / 4.0};
      Vec3 here{};
      Vec3 wanted{};
      for (std::size_t c = 0; c < 3; ++c) {
        here = here + weight[c] * column(v[c]);
        wanted = wanted + weight[c] * end_of(v[c], 0);
      }
      EXPECT_LT(norm((1.0 - found[0].part) * here + found[0].aside - wanted), 1e-15);
    }
  }
  EXPECT_GT(num_mixed, 3);
}

TEST_F(ColumnEndsTest, OfAVertexAreItsStack)
{
  int num_seen = 0;
  for (LocalIndex v = 0; v < body_.skeleton.num_vertices(); ++v) {
    const LocalIndex of_mesh = body_.skeleton.vertex_coarse[at(v)];
    if (column(of_mesh) == Vec3{}) continue;
    ColumnEnds ends(body_.coarse, body_.skeleton, mesh::HostKind::vertex, v, 1);
    const auto wanted = coarse_.layers.ends_of(stack(of_mesh));
    const auto found = ends.at_point(0);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t layer = 0; layer < wanted.size(); ++layer) {
      EXPECT_EQ(found[layer].part, wanted[layer]);
    }
    ++num_seen;
  }
  EXPECT_EQ(num_seen, 28);
}

}  // namespace
}  // namespace tessera::subdomain

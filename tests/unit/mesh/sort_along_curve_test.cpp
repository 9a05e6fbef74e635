// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/sort_along_curve.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/tet.hpp"

#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

// Corners of the rows of an array, in the order given.
template <std::size_t N>
std::vector<std::array<Vec3, N>> places_of(const CoarseMesh& mesh,
                                           const FlatArray<LocalIndex>& vertices)
{
  std::vector<std::array<Vec3, N>> places;
  for (std::size_t row = 0; row < vertices.size() / N; ++row) {
    places.push_back(corners_at<N>(mesh.vertex_xyz, vertices, row));
  }
  return places;
}

// How far apart the numbers of a tet's vertices are on average.
double mean_spread(const CoarseMesh& mesh)
{
  double sum = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto [least, most] = std::ranges::minmax(mesh.tet(t));
    sum += most - least;
  }
  return sum / mesh.num_tets();
}

TEST(SortAlongCurve, KeepsTetsFacesAndMaterials)
{
  const CoarseMesh before = testing::two_material_cube(4);
  CoarseMesh mesh = before;
  sort_along_curve(mesh);
  validate(mesh);
  EXPECT_EQ(places_of<3>(mesh, mesh.face_vertices), places_of<3>(before, before.face_vertices));
  EXPECT_EQ(places_of<2>(mesh, mesh.segment_vertices),
            places_of<2>(before, before.segment_vertices));
  const auto tets = places_of<4>(mesh, mesh.tet_vertices);
  const auto tets_before = places_of<4>(before, before.tet_vertices);
  ASSERT_TRUE(std::ranges::is_permutation(tets, tets_before));
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const auto old = std::ranges::find(tets_before, tets[t]) - tets_before.begin();
    EXPECT_EQ(mesh.tet_material[t], before.tet_material[static_cast<std::size_t>(old)]);
  }
}

// The numbers of kuhn_cube() run through whole layers.
TEST(SortAlongCurve, BringsTheVerticesOfATetTogether)
{
  CoarseMesh mesh = testing::kuhn_cube(16);
  const double before = mean_spread(mesh);
  sort_along_curve(mesh);
  EXPECT_LT(mean_spread(mesh), before);
}

TEST(SortAlongCurve, DependsOnPlacesAlone)
{
  CoarseMesh mesh = testing::kuhn_cube(3);
  sort_along_curve(mesh);
  const CoarseMesh once = mesh;
  sort_along_curve(mesh);
  EXPECT_EQ(mesh.vertex_xyz, once.vertex_xyz);
  EXPECT_EQ(mesh.tet_vertices, once.tet_vertices);
}

}  // namespace
}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/image_edges.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/topology/periodic_sides.hpp"

#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

// A cube whose sides across two directions are images of each other.
CoarseMesh periodic_cube()
{
  CoarseMesh cube = testing::two_material_cube(4);
  std::vector<topology::PeriodicSide> sides;
  for (const std::size_t axis : {0U, 1U}) {
    Vec3 along{};
    along[axis] = 1.0;
    std::array<std::string, 2> names;
    for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
      Vec3 sum{};
      for (std::size_t c = 0; c < 3; ++c)
        sum = sum + cube.position(cube.face_vertices[3 * at(f) + c]);
      if (sum[axis] == 0.0) names[0] = cube.patch_names[at(cube.face_patch[at(f)])];
      if (sum[axis] == 3.0) names[1] = cube.patch_names[at(cube.face_patch[at(f)])];
    }
    sides.push_back({.from = names[0], .to = names[1], .translation = along});
  }
  topology::join_periodic_sides(cube, sides);
  return cube;
}

TEST(ImageEdges, ArePartnersEndByEnd)
{
  const CoarseMesh cube = periodic_cube();
  const std::vector<ImageEdge> edges = image_edges(cube);
  EXPECT_GT(edges.size(), 20U);
  for (const ImageEdge& edge : edges) {
    EXPECT_LT(edge.from[0], edge.from[1]);
    EXPECT_LT(edge.to[0], edge.to[1]);
    for (std::size_t end = 0; end < 2; ++end) {
      EXPECT_EQ(cube.images.transforms[at(edge.transform)](cube.position(edge.from[end])),
                cube.position(edge.to[end]));
    }
  }
}

TEST(VertexOrbits, HaveTheCornersOfAllSides)
{
  const CoarseMesh cube = periodic_cube();
  const VertexOrbits orbits = find_vertex_orbits(cube);
  std::vector<int> sizes(at(cube.num_vertices()), 0);
  for (LocalIndex v = 0; v < cube.num_vertices(); ++v) {
    const LocalIndex base = orbits.vertices.base_of(v);
    ++sizes[at(base)];
    const Vec3 image = orbits.images[at(orbits.vertices.image_of(v))](cube.position(base));
    EXPECT_LT(norm(image - cube.position(v)), 1e-15);
  }
  EXPECT_EQ(std::ranges::count(sizes, 4), 5);  // Of the edges along the third direction.
  EXPECT_EQ(std::ranges::max(sizes), 4);
}

}  // namespace
}  // namespace tessera::mesh

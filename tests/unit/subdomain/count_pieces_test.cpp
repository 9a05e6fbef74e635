// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/count_pieces.hpp"

#include <gtest/gtest.h>

#include "support/decompositions.hpp"
#include "support/filled_cube.hpp"
#include "support/meshes.hpp"

namespace tessera::subdomain {
namespace {

// Two materials: of the triangles between them, only the lower side counts.
TEST(CountSubdividedPieces, AreThoseOfThePiecesThatAreMade)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const testing::Body body(cube, testing::slabs(cube, 2));
  const PartitionedMesh cut(body.coarse, body.decomposition, 0);
  for (int levels = 0; levels < 4; ++levels) {
    const auto counts = count_subdivided_pieces(cut, levels);
    ASSERT_EQ(counts.size(), 4U);
    for (LocalIndex s = 0; s < 4; ++s) {
      const FilledPiece made =
          testing::fill_of(body, levels, s, {.kernel = fill::KernelKind::subdivide});
      const number::PieceCounts expected = counts_of(made.result.summary);
      EXPECT_EQ(counts[at(s)].interior_vertices, expected.interior_vertices);
      EXPECT_EQ(counts[at(s)].tets, expected.tets);
      EXPECT_EQ(counts[at(s)].boundary_triangles, expected.boundary_triangles);
      EXPECT_GT(expected.boundary_triangles, 0);
    }
  }
}

}  // namespace
}  // namespace tessera::subdomain

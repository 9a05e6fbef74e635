// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_points.hpp"

#include <gtest/gtest.h>

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/tet_face_map.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

struct PointsOfCube : ::testing::Test {
  CoarseMesh coarse = testing::kuhn_cube(2);
  Decomposition decomposition = testing::slabs(coarse, 2);
  Skeleton skeleton = build_skeleton(coarse, decomposition);
  testing::FlatModel model{};
  ProjectionLimiter limiter{};
  std::vector<LocalIndex> tets{0, 5, 17, 40};
  TetComplex complex = tet_complex(coarse, skeleton, tets);
  RefinedLattice lattice =
      refine::refine_lattice(complex.faces, {coarse, skeleton, model, limiter, 3});
};

// On a flat-sided model every lattice point is the affine image of its indices.
TEST_F(PointsOfCube, AreAffineOnAFlatModel)
{
  const double n = lattice.most_intervals();
  for (LocalIndex t = 0; t < 4; ++t) {
    const TetPoints points(complex, lattice, t);
    const auto corners = coarse.tet(tets[static_cast<std::size_t>(t)]);
    for (LocalIndex k = 0; k <= lattice.most_intervals(); ++k) {
      for (LocalIndex j = 0; j + k <= lattice.most_intervals(); ++j) {
        for (LocalIndex i = 0; i + j + k <= lattice.most_intervals(); ++i) {
          const Vec3 origin = coarse.position(corners[0]);
          const Vec3 want = origin + (i / n) * (coarse.position(corners[1]) - origin)
                            + (j / n) * (coarse.position(corners[2]) - origin)
                            + (k / n) * (coarse.position(corners[3]) - origin);
          EXPECT_NEAR(norm(points.at({i, j, k}) - want), 0.0, 1e-15);
        }
      }
    }
  }
}

TEST_F(PointsOfCube, FaceMapIsItsOwnInverse)
{
  for (LocalIndex t = 0; t < 4; ++t) {
    const TetFaceMap map(complex, t);
    for (std::size_t c = 0; c < 4; ++c) {
      for (LocalIndex j = 0; j <= lattice.most_intervals(); ++j) {
        for (LocalIndex i = 0; i + j <= lattice.most_intervals(); ++i) {
          const auto back = map.triangle_point(lattice.most_intervals(), c,
                                               map.tet_point(lattice.most_intervals(), c, {i, j}));
          EXPECT_EQ(back.i, i);
          EXPECT_EQ(back.j, j);
        }
      }
    }
  }
}

}  // namespace
}  // namespace tessera::mesh

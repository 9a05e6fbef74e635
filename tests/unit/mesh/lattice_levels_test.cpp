// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/lattice_levels.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/mesh/triangle_grading.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/graded_meshes.hpp"
#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

using testing::Body;
using Bits = std::array<std::uint64_t, 3>;

// A cube of two materials, with levels from 0 to 3.
struct GradedCube : ::testing::TestWithParam<std::uint32_t> {
  CoarseMesh coarse = testing::shuffled(testing::two_material_cube(2), GetParam());
  Body body{coarse, testing::slabs(coarse, 2)};
  EdgeLevels levels = testing::random_levels(coarse, 3, 0.2, GetParam());
  LatticeLevels of_skeleton = lattice_levels(body.skeleton, levels);
};

INSTANTIATE_TEST_SUITE_P(Seeds, GradedCube, ::testing::Range(1U, 9U));

TEST_P(GradedCube, TrianglesHaveTheSmallestLevelOfTheirSides)
{
  ASSERT_FALSE(levels.is_uniform());
  const Skeleton& skeleton = body.skeleton;
  std::set<int> seen;
  for (LocalIndex e = 0; e < skeleton.num_edges(); ++e) {
    const LocalIndex* v = &skeleton.edge_vertices[2 * at(e)];
    EXPECT_EQ(of_skeleton.edge(e),
              levels.of(skeleton.vertex_coarse[at(v[0])], skeleton.vertex_coarse[at(v[1])]));
    EXPECT_EQ(of_skeleton.edge_intervals(e), 1 << of_skeleton.edge(e));
    seen.insert(of_skeleton.edge(e));
  }
  EXPECT_GT(seen.size(), 1U);
  EXPECT_EQ(of_skeleton.largest(), *seen.rbegin());
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    int least = 99;
    for (std::size_t s = 0; s < 3; ++s) {
      least = std::min(least, of_skeleton.edge(skeleton.triangle_edges[3 * at(t) + s]));
    }
    EXPECT_EQ(of_skeleton.triangle(t), least);
    EXPECT_EQ(of_skeleton.triangle_intervals(t), 1 << least);
  }
}

TEST_P(GradedCube, SmallTrianglesAreThoseThatAreMade)
{
  GlobalIndex num_cut = 0;
  for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
    const TriangleGrading grading = triangle_grading(body.skeleton, coarse, of_skeleton, t);
    GlobalIndex count = 0;
    for_each_graded_triangle(grading, [&](const auto&... /*points*/) { ++count; });
    EXPECT_EQ(num_small_triangles(body.skeleton, of_skeleton, t), count);
    num_cut += grading.is_uniform() ? 0 : 1;
  }
  EXPECT_GT(num_cut, 0);
}

// The grading that a skin finds from its points is that of the coarse mesh.
TEST_P(GradedCube, GradingIsTheSameWhereverItIsAskedFor)
{
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    const Complex skin = skin_complex(body.skeleton, s);
    const ProjectionLimiter none;
    const auto points = refine::refine_lattice(
        skin, {body.coarse, body.skeleton, testing::FlatModel(), none, levels});
    for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
      const auto here = triangle_grading(skin, points, t);
      const auto there =
          triangle_grading(body.skeleton, coarse, of_skeleton, skin.triangle_skeleton[at(t)]);
      EXPECT_EQ(here.level, there.level);
      EXPECT_EQ(here.finer, there.finer);
      EXPECT_EQ(here.order, there.order);
    }
  }
}

// Positions of numbered points, those of the triangles and those of the edges.
class NumberedPoints {
 public:
  NumberedPoints(const Body& body, const Complex& complex, const EdgeLevels& levels)
      : complex_(complex)
  {
    const ProjectionLimiter none;
    points_ = refine::refine_lattice(
        complex, {body.coarse, body.skeleton, testing::FlatModel(), none, levels});
  }

  [[nodiscard]] const LatticeLevels& levels() const { return points_.levels(); }

  [[nodiscard]] std::map<LocalIndex, Bits> all(const LatticeNumbering& numbering) const
  {
    std::map<LocalIndex, Bits> found;
    const auto see = [&](LocalIndex number, const Vec3& point) {
      EXPECT_EQ(found.emplace(number, testing::bits(point)).first->second, testing::bits(point));
    };
    for (LocalIndex e = 0; e < complex_.num_edges(); ++e) {
      for (LocalIndex k = 0; k <= levels().edge_intervals(e); ++k) {
        see(numbering.edge_point(e, k), points_.edge_point(e, k));
      }
    }
    for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) {
      const LocalIndex n = levels().triangle_intervals(t);
      for (LocalIndex j = 0; j <= n; ++j) {
        for (LocalIndex i = 0; i + j <= n; ++i) {
          see(numbering.triangle_point(t, n, {i, j}), points_.triangle_point(t, {i, j}));
          EXPECT_EQ(numbering.triangle_point(t, 2 * n, {2 * i, 2 * j}),
                    numbering.triangle_point(t, n, {i, j}));
        }
      }
    }
    return found;
  }

 private:
  const Complex& complex_;
  RefinedLattice points_{};
};

TEST_P(GradedCube, NumbersAreDenseAndThoseOfTheSkinComeFirst)
{
  const IndexLists tets_of = subdomain_tets(body.decomposition);
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    const TetComplex tets = tet_complex(coarse, body.skeleton, tets_of[s]);
    const NumberedPoints inside(body, tets.faces, levels);
    const LatticeNumbering numbering(tets.faces, inside.levels());
    const auto positions = inside.all(numbering);
    EXPECT_EQ(std::ssize(positions), numbering.num_points());
    EXPECT_EQ(positions.rbegin()->first, numbering.num_points() - 1);
    std::set<Bits> places;
    for (const auto& [number, place] : positions) places.insert(place);
    EXPECT_EQ(places.size(), positions.size());

    const Complex skin = skin_complex(body.skeleton, s);
    const NumberedPoints on_skin(body, skin, levels);
    const auto of_skin = on_skin.all(LatticeNumbering(skin, on_skin.levels()));
    EXPECT_EQ(std::ssize(of_skin), numbering.num_skeleton_points());
    for (const auto& [number, place] : of_skin) EXPECT_EQ(positions.at(number), place);
    EXPECT_LT(of_skin.size(), positions.size());
  }
}

TEST_P(GradedCube, PointsOfTheSkeletonAreCounted)
{
  std::set<Bits> places;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    const Complex skin = skin_complex(body.skeleton, s);
    const NumberedPoints points(body, skin, levels);
    for (const auto& [number, place] : points.all(LatticeNumbering(skin, points.levels()))) {
      places.insert(place);
    }
  }
  EXPECT_EQ(num_skeleton_points(body.skeleton, of_skeleton), std::ssize(places));
}

TEST(LatticeLevels, SkeletonPointsAreCountedBeyond32Bits)
{
  const CoarseMesh coarse = testing::kuhn_cube(16);
  const Body body(coarse, testing::slabs(coarse, 16));
  const auto levels = lattice_levels(body.skeleton, lattice::kMaxLevels);
  const GlobalIndex expected = body.skeleton.num_vertices()
                               + GlobalIndex{1023} * body.skeleton.num_edges()
                               + GlobalIndex{1023 * 511} * body.skeleton.num_triangles();
  EXPECT_GT(expected, GlobalIndex{1} << 32);
  EXPECT_EQ(num_skeleton_points(body.skeleton, levels), expected);
  EXPECT_EQ(num_small_triangles(body.skeleton, levels, 0), GlobalIndex{1} << 20);
}

TEST(LatticeLevels, OfNothingAreZero)
{
  EXPECT_EQ(LatticeLevels().largest(), 0);
  EXPECT_EQ(num_skeleton_points({}, {}), 0);
}

}  // namespace
}  // namespace tessera::mesh

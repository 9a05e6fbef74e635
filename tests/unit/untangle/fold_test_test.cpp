// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/untangle/fold_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_points.hpp"

#include "support/bodies.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::untangle {
namespace {

using mesh::PointLimit;
using mesh::ProjectionLimiter;
using testing::Body;

// A plate of kuhn_cube(n), so thin that what bulges from its bottom goes through its top.
mesh::CoarseMesh thin_plate(int n, double height)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(n);
  for (std::size_t z = 2; z < mesh.vertex_xyz.size(); z += 3) mesh.vertex_xyz[z] *= height;
  return mesh;
}

// A bulge of the bottom over every cell of kuhn_cube(n), 0 on the cells' sides.
testing::GraphModel bulging_bottom(int n, double height)
{
  return testing::GraphModel([=](double x, double y) {
    const auto hump = [n](double s) {
      const double in_cell = s * n - std::floor(s * n);
      return 4.0 * in_cell * (1.0 - in_cell);
    };
    return height * hump(x) * hump(y);
  });
}

struct RefinedTets {
  mesh::TetComplex complex{};
  mesh::RefinedLattice lattice{};

  RefinedTets(const Body& body, const model::Model& model, const ProjectionLimiter& limiter,
              int levels, const std::vector<LocalIndex>& tets)
      : complex(mesh::tet_complex(body.coarse, body.skeleton, tets)),
        lattice(refine::refine_lattice(complex.faces,
                                       {body.coarse, body.skeleton, model, limiter, levels}))
  {
  }
};

std::vector<LocalIndex> all_tets(const Body& body)
{
  std::vector<LocalIndex> tets(at(body.coarse.num_tets()));
  std::iota(tets.begin(), tets.end(), 0);
  return tets;
}

// Smallest volume of a child on any level, as a share of what it is without a curved patch.
double worst_child(const Body& body, const model::Model& model, const ProjectionLimiter& limiter,
                   int levels)
{
  const RefinedTets refined(body, model, limiter, levels, all_tets(body));
  double worst = std::numeric_limits<double>::max();
  for (LocalIndex t = 0; t < body.coarse.num_tets(); ++t) {
    const mesh::TetPoints points(refined.complex, refined.lattice, t);
    const auto tet = body.coarse.tet(t);
    const double whole = tet_volume(body.coarse.position(tet[0]), body.coarse.position(tet[1]),
                                    body.coarse.position(tet[2]), body.coarse.position(tet[3]));
    for (LocalIndex step = refined.lattice.most_intervals(); step >= 1; step /= 2) {
      const double children = std::pow(refined.lattice.most_intervals() / step, 3);
      mesh::lattice::for_each_child(
          refined.lattice.most_intervals(), step, points.grading().diagonal,
          [&](const auto& a, const auto& b, const auto& c, const auto& d) {
            const double volume =
                tet_volume(points.at(a), points.at(b), points.at(c), points.at(d));
            worst = std::min(worst, volume * children / whole);
          });
    }
  }
  return worst;
}

struct Plan {
  ProjectionLimiter limiter{};
  int rounds = 0;
};

// The plan stage in one process: every subdomain by itself, in rounds.
Plan make_plan(const Body& body, const model::Model& model, int levels, int most_rounds)
{
  const auto subdomains = mesh::subdomain_tets(body.decomposition);
  const auto on_geometry = vertices_on_geometry(body.coarse, body.skeleton);
  Plan plan;
  for (bool found_any = true; found_any && plan.rounds <= most_rounds; ++plan.rounds) {
    std::vector<PointLimit> all(plan.limiter.entries().begin(), plan.limiter.entries().end());
    found_any = false;
    for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
      const auto tets = tets_on_geometry(body.coarse, subdomains[s], on_geometry);
      const RefinedTets refined(body, model, plan.limiter, levels, tets);
      for (const PointLimit& smaller :
           find_folds(refined.complex, body.skeleton, refined.lattice, plan.limiter)) {
        EXPECT_LT(smaller.factor, plan.limiter.factor(smaller.key));
        all.push_back(smaller);
        found_any = true;
      }
    }
    plan.limiter = ProjectionLimiter(std::move(all));
  }
  return plan;
}

TEST(FoldTest, FactorsTakeFourStepsToZero)
{
  std::vector<double> factors{1.0};
  for (int step = 0; step < 5; ++step) factors.push_back(next_factor(factors.back()));
  EXPECT_EQ(factors, (std::vector<double>{1.0, 0.75, 0.5, 0.25, 0.0, 0.0}));
}

TEST(FoldTest, FindsNothingOnAFlatModel)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const Body body(cube, testing::slabs(cube, 2));
  for (int levels = 0; levels < 4; ++levels) {
    EXPECT_TRUE(make_plan(body, testing::FlatModel(), levels, 1).limiter.entries().empty());
  }
}

TEST(FoldTest, FindsNothingOnAFlatModelOfFlatTets)
{
  const mesh::CoarseMesh plate = thin_plate(2, 1e-6);
  const Body body(plate, testing::slabs(plate, 2));
  EXPECT_TRUE(make_plan(body, testing::FlatModel(), 3, 1).limiter.entries().empty());
}

TEST(FoldTest, AChildWithoutVolumeIsAFold)
{
  mesh::CoarseMesh plate = thin_plate(1, 0.5);
  for (std::size_t z = 2; z < plate.vertex_xyz.size(); z += 3) plate.vertex_xyz[z] = 0.0;
  const Body body(plate, testing::one_subdomain_a_material(plate));
  const ProjectionLimiter none;
  const RefinedTets refined(body, testing::FlatModel(), none, 1, all_tets(body));
  EXPECT_FALSE(find_folds(refined.complex, body.skeleton, refined.lattice, none).empty());
}

TEST(FoldTest, FindsNothingWithoutLevels)
{
  const mesh::CoarseMesh plate = thin_plate(2, 0.01);
  const Body body(plate, testing::one_subdomain_a_material(plate));
  EXPECT_TRUE(make_plan(body, bulging_bottom(2, 0.5), 0, 1).limiter.entries().empty());
}

struct Bulge {
  double height;  ///< Of the bulge; a cell is 0.1 high.
  int levels;
};

void PrintTo(const Bulge& bulge, std::ostream* out)
{
  *out << "bulge " << bulge.height << ", " << bulge.levels << " levels";
}

class FoldedPlate : public ::testing::TestWithParam<Bulge> {
 protected:
  static constexpr int kCells = 2;
  const mesh::CoarseMesh plate_ = thin_plate(kCells, 0.2);
  const testing::GraphModel model_ = bulging_bottom(kCells, GetParam().height);
  const int levels_ = GetParam().levels;
};

TEST_P(FoldedPlate, FoldsAndIsUnfolded)
{
  const Body body(plate_, testing::slabs(plate_, 2));
  ASSERT_LE(worst_child(body, model_, {}, levels_), 0.0);

  const Plan plan = make_plan(body, model_, levels_, 200);
  EXPECT_LT(plan.rounds, 200);
  EXPECT_FALSE(plan.limiter.entries().empty());
  EXPECT_GT(worst_child(body, model_, plan.limiter, levels_), 0.0);
}

TEST_P(FoldedPlate, IsUnfoldedWhateverTheSubdomains)
{
  for (const auto& decomposition :
       {testing::one_subdomain_a_material(plate_), testing::slabs(plate_, 2)}) {
    const Body body(plate_, decomposition);
    const Plan plan = make_plan(body, model_, levels_, 200);
    EXPECT_GT(worst_child(body, model_, plan.limiter, levels_), 0.0);
  }
}

TEST_P(FoldedPlate, HoldsBackOnlyNewPointsOnTheGeometryByListedSteps)
{
  const Body body(plate_, testing::one_subdomain_a_material(plate_));
  const Plan plan = make_plan(body, model_, levels_, 200);
  ASSERT_FALSE(plan.limiter.entries().empty());
  for (const PointLimit& entry : plan.limiter.entries()) {
    const bool on_edge = entry.key.carrier == mesh::LatticeCarrier::edge;
    const auto& patch = on_edge ? body.skeleton.edge_patch : body.skeleton.triangle_patch;
    EXPECT_NE(patch.at(at(entry.key.entity)), kNoIndex);
    const LocalIndex n = mesh::lattice::intervals(mesh::lattice::kMaxLevels);
    EXPECT_LT(entry.key.index, on_edge ? n - 1 : mesh::lattice::num_inner_triangle_points(n));
    EXPECT_TRUE((std::set<double>{0.75, 0.5, 0.25, 0.0}.count(entry.factor))) << entry.factor;
  }
}

TEST_P(FoldedPlate, FindingsDependOnTheArgumentsOnly)
{
  const Body body(plate_, testing::one_subdomain_a_material(plate_));
  const ProjectionLimiter none;
  const auto find = [&](const std::vector<LocalIndex>& tets) {
    const RefinedTets refined(body, model_, none, levels_, tets);
    return to_bytes(
        ProjectionLimiter(find_folds(refined.complex, body.skeleton, refined.lattice, none)));
  };
  std::vector<LocalIndex> tets = all_tets(body);
  const Bytes found = find(tets);
  EXPECT_NE(found, to_bytes(none)) << "there are no findings";
  static_cast<void>(find({tets.front()}));
  EXPECT_EQ(find(tets), found);
  std::reverse(tets.begin(), tets.end());
  EXPECT_EQ(find(tets), found);
}

INSTANTIATE_TEST_SUITE_P(BulgeAndLevels, FoldedPlate,
                         ::testing::Values(Bulge{0.12, 1}, Bulge{0.3, 1}, Bulge{0.3, 3},
                                           Bulge{0.9, 2}, Bulge{5.0, 3}));

TEST(FoldTest, TetsOnGeometryAreAllThatHaveAnEdgeThere)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(4);
  const Body body(cube, testing::slabs(cube, 2));
  std::set<std::pair<LocalIndex, LocalIndex>> edges;
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      edges.insert(std::minmax(cube.face_vertices[3 * at(f) + c],
                               cube.face_vertices[3 * at(f) + (c + 1) % 3]));
    }
  }
  const auto subdomains = mesh::subdomain_tets(body.decomposition);
  const auto on_geometry = vertices_on_geometry(body.coarse, body.skeleton);
  std::set<LocalIndex> found;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    for (const LocalIndex t : tets_on_geometry(body.coarse, subdomains[s], on_geometry)) {
      EXPECT_EQ(body.decomposition.tet_subdomain[at(t)], s);
      EXPECT_TRUE(found.insert(t).second);
    }
  }
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    const auto v = cube.tet(t);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) {
        if (edges.count(std::minmax(v[a], v[b])) == 0) continue;
        EXPECT_EQ(found.count(t), 1U) << t;
      }
    }
  }
  EXPECT_LT(found.size(), at(cube.num_tets()));
}

}  // namespace
}  // namespace tessera::untangle

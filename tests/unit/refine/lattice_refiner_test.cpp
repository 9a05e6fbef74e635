// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/lattice_refiner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice.hpp"

#include "support/bodies.hpp"
#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::refine {
namespace {

using mesh::lattice::TrianglePoint;
using testing::bits;
using testing::Body;
using testing::RefinedComplex;
using Bits = std::array<std::uint64_t, 3>;

template <class Visit>
void for_each_point(LocalIndex n, const Visit& visit)
{
  for (LocalIndex j = 0; j <= n; ++j) {
    for (LocalIndex i = 0; i + j <= n; ++i) visit(TrianglePoint{i, j});
  }
}

// Bits of all points of a complex on the skeleton, by carrier: (kind, entity, place).
std::map<std::array<LocalIndex, 3>, Bits> points_of(const RefinedComplex& refined)
{
  std::map<std::array<LocalIndex, 3>, Bits> points;
  const auto& complex = refined.complex;
  const auto& lattice = refined.lattice;
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    const LocalIndex entity = complex.edge_skeleton[at(e)];
    if (entity == kNoIndex) continue;
    for (LocalIndex k = 0; k <= lattice.most_intervals(); ++k) {
      points[{0, entity, k}] = bits(lattice.edge_point(e, k));
    }
  }
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    const LocalIndex entity = complex.triangle_skeleton[at(t)];
    if (entity == kNoIndex) continue;
    for_each_point(lattice.most_intervals(), [&](const TrianglePoint& p) {
      points[{1, entity, mesh::lattice::triangle_index(lattice.most_intervals(), p.i, p.j)}] =
          bits(lattice.triangle_point(t, p));
    });
  }
  return points;
}

struct BodyOnModel {
  Body body;
  std::shared_ptr<const model::Model> model;
};

std::map<std::string, BodyOnModel> bodies()
{
  const mesh::CoarseMesh ball = testing::ball(2);
  const mesh::CoarseMesh shell = testing::shell();
  const mesh::CoarseMesh cylinder = testing::cylinder(2);
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  std::map<std::string, BodyOnModel> all;
  all.insert({"ball",
              {{ball, testing::halves(ball)},
               std::make_shared<testing::SphereModel>(std::vector<double>{1.0})}});
  all.insert({"shell",
              {{shell, testing::halves(shell)},
               std::make_shared<testing::SphereModel>(std::vector<double>{1.0, 0.5})}});
  all.insert({"cylinder",
              {{cylinder, testing::halves(cylinder)}, std::make_shared<testing::CylinderModel>()}});
  all.insert({"cube", {{cube, testing::slabs(cube, 2)}, std::make_shared<testing::FlatModel>()}});
  return all;
}

class LatticeOfLevel : public ::testing::TestWithParam<int> {};

TEST_P(LatticeOfLevel, SharedPointsAreTheSameBitsSeenFromEverySubdomain)
{
  for (const auto& [name, made] : bodies()) {
    std::map<std::array<LocalIndex, 3>, Bits> known;
    std::size_t shared = 0;
    for (LocalIndex s = 0; s < made.body.num_subdomains(); ++s) {
      for (const auto& [key, point] :
           points_of(testing::refine_skin(made.body, *made.model, GetParam(), s))) {
        const auto [entry, is_new] = known.emplace(key, point);
        shared += is_new ? 0 : 1;
        ASSERT_EQ(entry->second, point) << name << ": " << ::testing::PrintToString(key);
      }
    }
    EXPECT_GT(shared, 0U) << name;
  }
}

// The plan looks at tets, the fill at skins.
TEST_P(LatticeOfLevel, PointsOfTetsAreTheSameBitsAsThoseOfSkins)
{
  for (const auto& [name, made] : bodies()) {
    const Body& body = made.body;
    const mesh::ProjectionLimiter none;
    std::vector<LocalIndex> tets(at(body.coarse.num_tets()));
    std::iota(tets.begin(), tets.end(), 0);
    RefinedComplex of_tets{mesh::tet_complex(body.coarse, body.skeleton, tets).faces, {}};
    of_tets.lattice = refine_lattice(of_tets.complex,
                                     {body.coarse, body.skeleton, *made.model, none, GetParam()});
    const auto known = points_of(of_tets);
    const auto skin = points_of(testing::refine_skin(body, *made.model, GetParam(), 0));
    for (const auto& [key, point] : skin) ASSERT_EQ(known.at(key), point) << name;
  }
}

TEST_P(LatticeOfLevel, SidesOfTrianglesAreTheirEdges)
{
  for (const auto& [name, made] : bodies()) {
    const auto [complex, lattice] = testing::refine_skin(made.body, *made.model, GetParam(), 1);
    for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
      for (std::size_t side = 0; side < 3; ++side) {
        const LocalIndex edge = complex.triangle_edges[3 * at(t) + side];
        for (LocalIndex k = 0; k <= lattice.most_intervals(); ++k) {
          const auto p = mesh::lattice::side_point(lattice.most_intervals(), side, k);
          ASSERT_EQ(bits(lattice.triangle_point(t, p)), bits(lattice.edge_point(edge, k))) << name;
        }
      }
    }
  }
}

TEST_P(LatticeOfLevel, OldPointsStayWhereTheyAreInTheNextLevel)
{
  for (const auto& named : bodies()) {
    const auto& name = named.first;
    const auto& made = named.second;
    const auto refined = testing::refine_skin(made.body, *made.model, GetParam(), 0);
    const auto& complex = refined.complex;
    const auto& coarse = refined.lattice;
    const auto fine = testing::refine_skin(made.body, *made.model, GetParam() + 1, 0).lattice;
    ASSERT_EQ(fine.most_intervals(), 2 * coarse.most_intervals());
    for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
      for (LocalIndex k = 0; k <= coarse.most_intervals(); ++k) {
        ASSERT_EQ(bits(fine.edge_point(e, 2 * k)), bits(coarse.edge_point(e, k))) << name;
      }
    }
    for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
      for_each_point(coarse.most_intervals(), [&](const TrianglePoint& p) {
        ASSERT_EQ(bits(fine.triangle_point(t, {2 * p.i, 2 * p.j})),
                  bits(coarse.triangle_point(t, p)))
            << name;
      });
    }
  }
}

// Visits every point of a skin that lies on a patch: visit(patch, point).
template <class Visit>
void for_each_point_on_patches(const Body& body, const RefinedComplex& refined, const Visit& visit)
{
  for (LocalIndex t = 0; t < refined.complex.num_triangles(); ++t) {
    const LocalIndex triangle = refined.complex.triangle_skeleton[at(t)];
    const LocalIndex patch = body.skeleton.triangle_patch[at(triangle)];
    if (patch == kNoIndex) continue;
    for_each_point(refined.lattice.most_intervals(), [&](const TrianglePoint& p) {
      visit(patch, refined.lattice.triangle_point(t, p));
    });
  }
}

TEST_P(LatticeOfLevel, PointsOfSpheresLieOnTheFormula)
{
  const BodyOnModel made = bodies().at("shell");
  std::array<std::size_t, 2> num_on_patch{};
  for (LocalIndex s = 0; s < 2; ++s) {
    const auto refined = testing::refine_skin(made.body, *made.model, GetParam(), s);
    for_each_point_on_patches(made.body, refined, [&](LocalIndex patch, const Vec3& p) {
      ASSERT_NEAR(norm(p), patch == 0 ? 1.0 : 0.5, 1e-12);
      ++num_on_patch.at(at(patch));
    });
  }
  for (const std::size_t num_points : num_on_patch) EXPECT_GT(num_points, 0U);
}

TEST_P(LatticeOfLevel, PointsOfTheCylinderLieOnMantleEndsAndRims)
{
  const BodyOnModel made = bodies().at("cylinder");
  std::size_t on_rims = 0;
  for (LocalIndex s = 0; s < 2; ++s) {
    const auto refined = testing::refine_skin(made.body, *made.model, GetParam(), s);
    for_each_point_on_patches(made.body, refined, [](LocalIndex patch, const Vec3& p) {
      if (patch == 0) {
        ASSERT_NEAR(std::hypot(p[0], p[1]), 1.0, 1e-12);
      } else {
        ASSERT_EQ(p[2], patch == 1 ? 0.0 : 1.0);
      }
    });
    for (LocalIndex e = 0; e < refined.complex.num_edges(); ++e) {
      const LocalIndex edge = refined.complex.edge_skeleton[at(e)];
      const LocalIndex curve = made.body.skeleton.edge_curve[at(edge)];
      if (curve == kNoIndex) continue;
      for (LocalIndex k = 0; k <= refined.lattice.most_intervals(); ++k, ++on_rims) {
        const Vec3 p = refined.lattice.edge_point(e, k);
        ASSERT_NEAR(std::hypot(p[0], p[1]), 1.0, 1e-12);
        ASSERT_EQ(p[2], curve == 0 ? 0.0 : 1.0);
      }
    }
  }
  EXPECT_EQ(on_rims, 2 * 8 * (std::size_t{1} << GetParam()) + 2 * 8);
}

TEST_P(LatticeOfLevel, IsAffineOnAFlatModel)
{
  const BodyOnModel made = bodies().at("cube");
  const Body& body = made.body;
  const auto [complex, lattice] = testing::refine_skin(body, *made.model, GetParam(), 2);
  const double n = lattice.most_intervals();
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    std::array<Vec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = complex.triangle_vertices[3 * at(t) + c];
      corners[c] = body.coarse.position(complex.vertex_coarse[at(v)]);
    }
    for_each_point(lattice.most_intervals(), [&, &points = lattice](const TrianglePoint& p) {
      const Vec3 affine = corners[0] + (p.i / n) * (corners[1] - corners[0])
                          + (p.j / n) * (corners[2] - corners[0]);
      ASSERT_LE(norm(points.triangle_point(t, p) - affine), 1e-15);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, LatticeOfLevel, ::testing::Range(0, 5));

TEST(LatticeRefiner, IsTestedOnValidMeshes)
{
  for (const auto& [name, made] : bodies()) {
    EXPECT_NO_THROW(mesh::validate(made.body.coarse)) << name;
  }
}

// Without triangles of both branches at the seam the cylinder would not test what it is for.
TEST(LatticeRefiner, CylinderHasTrianglesOfTwoBranchesAtItsSeam)
{
  const BodyOnModel made = bodies().at("cylinder");
  const auto& skeleton = made.body.skeleton;
  double lowest = 10.0;
  double highest = 0.0;
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    if (skeleton.triangle_patch[at(t)] != 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      lowest = std::min(lowest, skeleton.triangle_uv[2 * (3 * at(t) + c)]);
      highest = std::max(highest, skeleton.triangle_uv[2 * (3 * at(t) + c)]);
    }
  }
  EXPECT_EQ(lowest, 0.0);
  EXPECT_GE(highest, 2.0 * std::numbers::pi);
}

TEST(LatticeRefiner, DoesNotDependOnWhatElseIsRefined)
{
  const BodyOnModel made = bodies().at("cylinder");
  const Body& body = made.body;
  const mesh::ProjectionLimiter none;
  const auto all = points_of(testing::refine_skin(body, *made.model, 3, 0));
  std::size_t compared = 0;
  for (const LocalIndex tet : {0, 7, 21}) {
    const std::vector<LocalIndex> one{tet};
    RefinedComplex refined{mesh::tet_complex(body.coarse, body.skeleton, one).faces, {}};
    refined.lattice =
        refine_lattice(refined.complex, {body.coarse, body.skeleton, *made.model, none, 3});
    for (const auto& [key, point] : points_of(refined)) {
      const auto known = all.find(key);
      if (known == all.end()) continue;
      ++compared;
      ASSERT_EQ(known->second, point);
    }
  }
  EXPECT_GT(compared, 0U);
}

// A model without parameters, as CSG and STL are, whose curves are off its surfaces by a step of
// their own: so it shows which of the two a point was put on.
class CurvesApart final : public model::Model {
 public:
  static constexpr double kStep = 0x1p-10;

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return 1e-8; }
  [[nodiscard]] double box_diagonal() const override { return 2.0; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex, const Vec3& point, const model::SurfaceParameters&) const override
  {
    return {point, {}};
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double) const override
  {
    return {point + Vec3{kStep * (curve + 1), 0.0, 0.0}, 0.0};
  }
};

TEST(LatticeRefiner, PutsPointsOfCurvesOnThemWithoutParametersToo)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const Body body(cube, testing::one_subdomain_a_material(cube));
  const auto [complex, lattice] = testing::refine_skin(body, CurvesApart(), 1, 0);
  std::size_t on_curves = 0;
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    const LocalIndex curve = body.skeleton.edge_curve[at(complex.edge_skeleton[at(e)])];
    const Vec3 chord = midpoint(lattice.edge_point(e, 0), lattice.edge_point(e, 2));
    const double off = curve == kNoIndex ? 0.0 : CurvesApart::kStep * (curve + 1);
    EXPECT_EQ(lattice.edge_point(e, 1), (chord + Vec3{off, 0.0, 0.0}));
    on_curves += curve == kNoIndex ? 0 : 1;
  }
  EXPECT_EQ(on_curves, 12U * 2U);
}

TEST(LatticeRefiner, ComplexWithoutEntitiesGivesNoPoints)
{
  const BodyOnModel made = bodies().at("cylinder");
  const mesh::ProjectionLimiter none;
  const auto lattice = refine_lattice(
      mesh::Complex{}, {made.body.coarse, made.body.skeleton, *made.model, none, 2, true});
  EXPECT_TRUE(lattice.edge_points().empty());
  EXPECT_TRUE(lattice.triangle_points().empty());
  EXPECT_EQ(lattice.distance.largest, 0.0);
}

}  // namespace
}  // namespace tessera::refine

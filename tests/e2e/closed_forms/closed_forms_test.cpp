// SPDX-License-Identifier: BSD-3-Clause
// Bodies with a formula, as CSG and as STEP: what import, coarse mesh and refinement make of them
// together is held against the formula, not against the models' own projection.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/netgen/factory.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/surfaces.hpp"
#include "support/temporary_file.hpp"

namespace tessera {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostLevels = 3;

// A body around the origin with the z axis as its axis, and its formula.
struct ClosedForm {
  std::string name;
  std::string geo;  ///< CSG text.
  double coarse_size;
  double volume;
  double box_diagonal;
  std::function<double(const Vec3&)> distance;           ///< Of a point from the surface.
  std::function<double(const Vec3&)> distance_from_rim;  ///< Empty: the body has no curves.
};

ClosedForm sphere()
{
  constexpr double kRadius = 10.0;
  return {"sphere",
          "algebraic3d\nsolid body = sphere (0, 0, 0; 10);\ntlo body;\n",
          8.0,
          4.0 / 3.0 * kPi * std::pow(kRadius, 3),
          2.0 * kRadius * std::sqrt(3.0),
          [](const Vec3& p) { return std::abs(norm(p) - kRadius); },
          {}};
}

ClosedForm torus()
{
  constexpr double kRing = 10.0;
  constexpr double kTube = 3.0;
  return {"torus",
          "algebraic3d\nsolid body = torus (0, 0, 0; 0, 0, 1; 10; 3);\ntlo body;\n",
          3.0,
          2.0 * kPi * kPi * kRing * kTube * kTube,
          2.0 * std::hypot(kRing + kTube, kRing + kTube, kTube),
          [](const Vec3& p) {
            return std::abs(std::hypot(std::hypot(p[0], p[1]) - kRing, p[2]) - kTube);
          },
          {}};
}

ClosedForm cylinder()
{
  constexpr double kRadius = 5.0;
  constexpr double kHeight = 20.0;
  const auto from_mantle = [](const Vec3& p) { return std::abs(std::hypot(p[0], p[1]) - kRadius); };
  const auto from_ends = [](const Vec3& p) {
    return std::min(std::abs(p[2]), std::abs(p[2] - kHeight));
  };
  return {"cylinder",
          // Planes first: their triangles come first at the rims, and only the curves say "circle".
          "algebraic3d\nsolid body = plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 20; 0, 0, 1)\n"
          "  and cylinder (0, 0, 0; 0, 0, 20; 5);\ntlo body;\n",
          5.0, kPi * kRadius * kRadius * kHeight, std::hypot(2.0 * kRadius, 2.0 * kRadius, kHeight),
          [=](const Vec3& p) { return std::min(from_mantle(p), from_ends(p)); },
          [=](const Vec3& p) { return std::max(from_mantle(p), from_ends(p)); }};
}

struct TestBody {
  ClosedForm form;
  bool as_step;
};

void PrintTo(const TestBody& body, std::ostream* out)
{
  *out << body.form.name << (body.as_step ? ".step" : ".geo");
}

model::ModelSource import(const TestBody& body)
{
  if (body.as_step) {
    return netgen::import_model(
        std::filesystem::path(TESSERA_GEOMETRY_DIR) / (body.form.name + ".step"), {});
  }
  const testing::TemporaryFile file(body.form.name + ".geo", body.form.geo);
  return netgen::import_model(file.path(), {});
}

class ClosedForms : public ::testing::TestWithParam<TestBody> {
 protected:
  const ClosedForm& form_ = GetParam().form;
  const std::unique_ptr<model::Model> model_ = netgen::load_model(import(GetParam()));
  const testing::Body body_ = mesh_of(*model_, form_.coarse_size);

  static testing::Body mesh_of(const model::Model& model, double max_size)
  {
    surface::CoarseOptions options;
    options.max_size = max_size;
    const mesh::CoarseMesh coarse = netgen::make_coarse_mesher(model)->generate(options);
    mesh::validate(coarse);
    return {coarse, testing::one_subdomain_a_material(coarse)};
  }

  [[nodiscard]] mesh::Skin skin(int levels) const
  {
    return testing::skin_of(body_, *model_, levels, 0);
  }

  [[nodiscard]] double volume_error(int levels) const
  {
    const mesh::Skin refined = skin(levels);
    return std::abs(testing::volume_inside(refined.vertex_xyz, refined.triangle_vertices)
                    - form_.volume);
  }
};

TEST_P(ClosedForms, ErrorOfTheVolumeFallsWithOrderTwo)
{
  std::vector<double> errors;
  for (int levels = 0; levels <= kMostLevels; ++levels) errors.push_back(volume_error(levels));
  for (std::size_t l = 1; l < errors.size(); ++l) {
    const double order = std::log2(errors[l - 1] / errors[l]);
    EXPECT_GE(order, 1.9) << "from level " << l - 1;
    RecordProperty("order_to_level_" + std::to_string(l), std::to_string(order));
  }
}

TEST_P(ClosedForms, EveryVertexOfTheBoundaryLiesOnTheFormula)
{
  for (int levels = 0; levels <= kMostLevels; ++levels) {
    const mesh::Skin refined = skin(levels);
    double largest = 0.0;
    for (LocalIndex v = 0; v < refined.num_vertices(); ++v) {
      const Vec3 p = point_at(std::span<const double>(refined.vertex_xyz), v);
      largest = std::max(largest, form_.distance(p));
    }
    EXPECT_LE(largest, 1e-8 * form_.box_diagonal) << levels << " levels";
  }
}

// Both ends on a segment of the coarse mesh whose ends are at one end of the cylinder: NETGEN also
// puts segments on a periodic surface's seam, which is no rim.
bool is_on_rim(const testing::Body& body, LocalIndex edge)
{
  if (body.skeleton.edge_curve[at(edge)] == kNoIndex) return false;
  const auto z = [&](std::size_t end) {
    const LocalIndex v = body.skeleton.edge_vertices[2 * at(edge) + end];
    return body.coarse.position(body.skeleton.vertex_coarse[at(v)])[2];
  };
  return std::abs(z(0) - z(1)) < 1e-6;
}

using ClosedFormsWithRims = ClosedForms;

TEST_P(ClosedFormsWithRims, RimVerticesLieOnTheCircles)
{
  const auto [complex, lattice] = testing::refine_skin(body_, *model_, kMostLevels, 0);
  double length = 0.0;
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    const LocalIndex edge = complex.edge_skeleton[at(e)];
    if (!is_on_rim(body_, edge)) continue;
    for (LocalIndex k = 0; k <= lattice.most_intervals(); ++k) {
      EXPECT_LE(form_.distance_from_rim(lattice.edge_point(e, k)), 1e-8 * form_.box_diagonal);
      if (k > 0) length += norm(lattice.edge_point(e, k) - lattice.edge_point(e, k - 1));
    }
  }
  EXPECT_NEAR(length, 2.0 * 2.0 * kPi * 5.0, 0.01);  // Both circles, all around.
}

TEST_P(ClosedForms, SkinIsClosedAndOfTheRightKind)
{
  const mesh::Skin refined = skin(2);
  const auto topology = testing::topology_of(refined.triangle_vertices);
  EXPECT_EQ(topology.num_unmatched_edges, 0);
  EXPECT_EQ(topology.euler, form_.name == "torus" ? 0 : 2);
}

std::string name_of(const ::testing::TestParamInfo<TestBody>& tested)
{
  return tested.param.form.name + (tested.param.as_step ? "_step" : "_csg");
}

INSTANTIATE_TEST_SUITE_P(Bodies, ClosedForms,
                         ::testing::Values(TestBody{sphere(), false}, TestBody{sphere(), true},
                                           TestBody{cylinder(), false}, TestBody{cylinder(), true},
                                           TestBody{torus(), false}, TestBody{torus(), true}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Bodies, ClosedFormsWithRims,
                         ::testing::Values(TestBody{cylinder(), false}, TestBody{cylinder(), true}),
                         name_of);

}  // namespace
}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/topology/periodic_sides.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_edges.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/periodic_pairs.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/refine/choose_levels.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::topology {
namespace {

const std::vector<PeriodicSide> kThree{{.from = "x0", .to = "x1", .translation = {1.0, 0.0, 0.0}},
                                       {.from = "y0", .to = "y1"},
                                       {.from = "z0", .to = "z1"}};

// The side x = 0 is wavy, and so is its image. Nobody asks where the points of that image are.
class WavyModel final : public testing::FlatModel {
 public:
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters&) const override
  {
    if (surface == 1) throw GeometryError("an image is projected");
    if (surface != 0) return {point, {}};
    const double wave =
        std::sin(std::numbers::pi * point[1]) * std::sin(std::numbers::pi * point[2]);
    return {{0.01 * wave, point[1], point[2]}, {}};
  }
};

std::string words_of(mesh::CoarseMesh mesh, const std::vector<PeriodicSide>& sides)
{
  return testing::message_of<Error>([&] { join_periodic_sides(mesh, sides); });
}

mesh::CoarseMesh joined_cube(int n, const std::vector<PeriodicSide>& sides)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(n);
  join_periodic_sides(cube, sides);
  return cube;
}

std::array<LocalIndex, 3> sorted_corners(const mesh::CoarseMesh& mesh, LocalIndex face)
{
  const LocalIndex* v = &mesh.face_vertices[3 * at(face)];
  return mesh::sorted_triangle(v[0], v[1], v[2]);
}

TEST(PeriodicSides, AreFoundByTheirTranslation)
{
  const mesh::CoarseMesh cube = joined_cube(3, kThree);
  EXPECT_NEAR(testing::volume_of(cube), 1.0, 1e-12);
  const mesh::SideImages& images = cube.images;
  ASSERT_EQ(images.transforms.size(), 4U);
  for (std::size_t d = 0; d < 3; ++d) {
    Vec3 shift{};
    shift[d] = 1.0;
    EXPECT_NEAR(norm(images.transforms[d + 1].shift - shift), 0.0, 1e-14);
    EXPECT_EQ(images.patch_origin[2 * d + 1], static_cast<LocalIndex>(2 * d));
    EXPECT_EQ(images.patch_origin[2 * d], kNoIndex);
  }
}

// Whoever sorts the corners of a face and of its image gets them in the same order.
TEST(PeriodicSides, HaveTheSameOrderOfVertices)
{
  const mesh::CoarseMesh cube = joined_cube(3, kThree);
  int num_images = 0;
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    const LocalIndex origin = cube.images.face_origin[at(f)];
    if (origin == kNoIndex) continue;
    ++num_images;
    const Affine& there =
        cube.images.transforms[at(cube.images.patch_transform[at(cube.face_patch[at(f)])])];
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 image = there(cube.position(sorted_corners(cube, origin)[c]));
      EXPECT_NEAR(norm(cube.position(sorted_corners(cube, f)[c]) - image), 0.0, 1e-15);
    }
  }
  EXPECT_EQ(num_images, 3 * 2 * 9);
}

TEST(PeriodicSides, MakeOrbitsOfCornersEdgesAndTriangles)
{
  const mesh::CoarseMesh cube = joined_cube(3, kThree);
  const mesh::Skeleton skeleton =
      mesh::build_skeleton(cube, testing::one_subdomain_a_material(cube));
  std::map<LocalIndex, int> members;
  for (const LocalIndex base : skeleton.orbits.vertex_columns.base) ++members[base];
  std::map<int, int> orbits_of_size;
  for (const auto& [base, size] : members) ++orbits_of_size[size];
  // The corners; points within edges by four; points within faces by two; all lie outside.
  EXPECT_EQ(orbits_of_size, (std::map<int, int>{{8, 1}, {4, 3 * 2}, {2, 3 * 4}}));
}

TEST(PeriodicSides, GetThePointsOfTheirPartners)
{
  const mesh::CoarseMesh cube = joined_cube(3, kThree);
  const mesh::Skeleton skeleton =
      mesh::build_skeleton(cube, testing::one_subdomain_a_material(cube));
  const WavyModel model;
  const mesh::ProjectionLimiter limiter;
  const refine::RefineContext context{.coarse = cube,
                                      .skeleton = skeleton,
                                      .model = model,
                                      .limiter = limiter,
                                      .levels = mesh::EdgeLevels(2)};
  const mesh::Complex skin = mesh::skin_complex(skeleton, 0);
  const mesh::RefinedLattice points = refine::refine_lattice(skin, context);
  double highest = 0.0;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    const LocalIndex triangle = skin.triangle_skeleton[at(t)];
    const LocalIndex base = skeleton.orbits.triangles.base_of(triangle);
    if (base == triangle) continue;
    const auto of_base = std::ranges::find(skin.triangle_skeleton, base);
    const auto origin = static_cast<LocalIndex>(of_base - skin.triangle_skeleton.begin());
    const LocalIndex image = skeleton.orbits.triangles.image_of(triangle);
    for (LocalIndex j = 0; j <= 4; ++j) {
      for (LocalIndex i = 0; i + j <= 4; ++i) {
        const Vec3 there = skeleton.orbits.image(image, points.triangle_point(origin, {i, j}));
        EXPECT_NEAR(norm(points.triangle_point(t, {i, j}) - there), 0.0, 1e-15);
        if (skeleton.triangle_patch[at(triangle)] == 1) highest = std::max(highest, there[0] - 1.0);
      }
    }
  }
  EXPECT_GT(highest, 0.005);
}

TEST(PeriodicSides, HaveLevelsInCommon)
{
  const mesh::CoarseMesh cube = joined_cube(4, kThree);
  std::vector<LocalIndex> edges = mesh::coarse_edges(cube);
  std::vector<double> wanted;
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    const bool is_in_corner =
        norm(cube.position(edges[e])) < 0.3 && norm(cube.position(edges[e + 1])) < 0.3;
    wanted.push_back(is_in_corner ? 8.0 : 1.0);
  }
  const mesh::EdgeLevels levels = refine::choose_levels(cube, edges, wanted, 5);
  ASSERT_FALSE(levels.is_uniform());
  int num_fine = 0;
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    if (cube.images.face_origin[at(f)] == kNoIndex) continue;
    const auto from = sorted_corners(cube, cube.images.face_origin[at(f)]);
    const auto to = sorted_corners(cube, f);
    for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(0U, 2U), std::pair(1U, 2U)}) {
      EXPECT_EQ(levels.of(from[a], from[b]), levels.of(to[a], to[b]));
      if (levels.of(to[a], to[b]) == levels.largest()) ++num_fine;
    }
  }
  EXPECT_GT(num_fine, 0);
}

TEST(PeriodicSides, LimitPointsOfAllTheirImages)
{
  const mesh::CoarseMesh cube = joined_cube(3, kThree);
  const mesh::Skeleton skeleton =
      mesh::build_skeleton(cube, testing::one_subdomain_a_material(cube));
  std::map<std::size_t, int> edges_with;
  for (LocalIndex e = 0; e < skeleton.num_edges(); ++e) {
    const auto key = mesh::LatticePointKey::on_edge(e, 2, 1);
    const auto limits = mesh::on_whole_orbits({{key, 0.5}}, skeleton.orbits);
    ++edges_with[limits.size()];
    EXPECT_TRUE(std::ranges::any_of(
        limits, [&](const mesh::PointLimit& limit) { return limit.key == key; }));
  }
  EXPECT_EQ(edges_with[4], 12 * 3);
  EXPECT_EQ(edges_with[1], 0);
}

TEST(PeriodicSides, TurnAboutAnAxis)
{
  const std::vector<PeriodicSide> quarter{{.from = "y0",
                                           .to = "x0",
                                           .axis_point = {0.0, 0.0, 7.0},
                                           .axis = {0.0, 0.0, 2.0},
                                           .angle_deg = 90.0}};
  // The diagonals of a Kuhn cube are the same seen from both sides of y = x.
  const mesh::CoarseMesh cube = joined_cube(3, quarter);
  EXPECT_EQ(cube.images.transforms[1]({1.0, 0.0, 0.5}), (Vec3{0.0, 1.0, 0.5}));
  EXPECT_EQ(cube.images.patch_origin[0], 2);
}

TEST(PeriodicSides, AreTextsInFiles)
{
  const auto pairs = mesh::periodic_pairs(joined_cube(2, {kThree[0]}));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].from, "x0");
  EXPECT_EQ(mesh::periodic_pairs(mesh::to_texts(pairs)), pairs);
  EXPECT_THROW(static_cast<void>(mesh::periodic_pairs(std::vector<std::string>{"a", "b"})),
               InputError);
  EXPECT_THROW(static_cast<void>(mesh::periodic_pairs(std::vector<std::string>{"a", "b", "1 2"})),
               InputError);
}

TEST(PeriodicSides, SayWhatIsWrong)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(3);
  EXPECT_EQ(words_of(cube, {{.from = "x0", .to = "x1", .translation = {0.9, 0.0, 0.0}}}),
            "[[periodic]] from \"x0\" to \"x1\": the sides do not match: the image of the "
            "point (0, 0, 0) is (0.9, 0, 0), and the nearest point of the other side is 0.1 away, "
            "more than 1.73e-06; correct the translation or rotation, or the model");
  EXPECT_TRUE(words_of(cube, {{.from = "left", .to = "x1"}})
                  .starts_with("[[periodic]] from \"left\" to \"x1\": "));
  EXPECT_EQ(words_of(cube, {kThree[0], {.from = "x1", .to = "y0"}}),
            "[[periodic]] from \"x1\" to \"y0\": patch \"x1\" is one of [[periodic]] "
            "from \"x0\" to \"x1\" as well; it can have one partner");
  const mesh::CoarseMesh two = testing::two_material_cube(2);
  EXPECT_TRUE(words_of(two, {{.from = "x0", .to = two.patch_names[6]}})
                  .ends_with("lies inside of the model; a side is outside"));
}

// Its faces have corners that are images of each other.
TEST(PeriodicSides, MayBeOneEdgeApart)
{
  const mesh::CoarseMesh cube = joined_cube(1, kThree);
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    const LocalIndex origin = cube.images.face_origin[at(f)];
    if (origin == kNoIndex) continue;
    const Affine& there =
        cube.images.transforms[at(cube.images.patch_transform[at(cube.face_patch[at(f)])])];
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(cube.position(sorted_corners(cube, f)[c]),
                there(cube.position(sorted_corners(cube, origin)[c])));
    }
  }
}

TEST(PeriodicSide, MustBeWhole)
{
  EXPECT_EQ(defect_of({.from = "a", .to = "b"}), "");
  EXPECT_EQ(defect_of({.translation = {1.0, 0.0, 0.0}, .axis = {1.0, 0.0, 0.0}, .angle_deg = 9.0}),
            "must not have both a translation and a rotation");
  EXPECT_EQ(defect_of({.axis = {1.0, 0.0, 0.0}}), "has rotation.axis without rotation.angle");
  EXPECT_EQ(defect_of({.angle_deg = 9.0}), "has rotation.angle without rotation.axis");
  EXPECT_EQ(defect_of({.axis_point = {1.0, 0.0, 0.0}, .angle_deg = 9.0}),
            "has rotation.point without rotation.axis");
  EXPECT_NE(defect_of({.translation = Vec3{}}), "");
  EXPECT_NE(defect_of({.axis = Vec3{}, .angle_deg = 9.0}), "");
  EXPECT_NE(defect_of({.axis = {1.0, 0.0, 0.0}, .angle_deg = 0.0}), "");
}

}  // namespace
}  // namespace tessera::topology

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/skin.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice_numbering.hpp"

#include "support/bodies.hpp"
#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/surfaces.hpp"

namespace tessera::refine {
namespace {

using testing::Body;

double volume_of(const mesh::Skin& skin)
{
  return testing::volume_inside(skin.vertex_xyz, skin.triangle_vertices);
}

void expect_closed_sphere(const mesh::Skin& skin)
{
  const auto topology = testing::topology_of(skin.triangle_vertices);
  EXPECT_EQ(topology.num_unmatched_edges, 0);
  EXPECT_EQ(topology.euler, 2);
  EXPECT_EQ(topology.num_used_vertices, skin.num_vertices());
  EXPECT_GT(volume_of(skin), 0.0);
}

class SkinOfLevel : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static int n() { return 1 << GetParam(); }
};

TEST_P(SkinOfLevel, IsAClosedOutwardSphereOfEveryHalf)
{
  const testing::SphereModel spheres({1.0, 0.5});
  const testing::CylinderModel round;
  const testing::FlatModel flat;
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const std::vector<std::pair<Body, const model::Model*>> bodies{
      {{testing::ball(2), testing::halves(testing::ball(2))}, &spheres},
      {{testing::shell(), testing::halves(testing::shell())}, &spheres},
      {{testing::cylinder(2), testing::halves(testing::cylinder(2))}, &round},
      {{cube, testing::slabs(cube, 2)}, &flat}};
  for (const auto& [body, model] : bodies) {
    for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
      const mesh::Skin skin = testing::skin_of(body, *model, GetParam(), s);
      expect_closed_sphere(skin);
      EXPECT_EQ(skin.num_triangles(),
                n() * n() * static_cast<LocalIndex>(body.skeleton.triangles_of(s).size()));
    }
  }
}

TEST_P(SkinOfLevel, HasTwoSpheresAroundACavity)
{
  const testing::SphereModel spheres({1.0, 0.5});
  const Body body(testing::shell(), testing::one_subdomain_a_material(testing::shell()));
  const mesh::Skin skin = testing::skin_of(body, spheres, GetParam(), 0);
  const auto topology = testing::topology_of(skin.triangle_vertices);
  EXPECT_EQ(topology.num_unmatched_edges, 0);
  EXPECT_EQ(topology.euler, 4);
}

TEST_P(SkinOfLevel, KeepsTheVolumeOnAFlatModel)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const Body body(cube, testing::slabs(cube, 2));
  for (LocalIndex s = 0; s < 4; ++s) {
    EXPECT_NEAR(volume_of(testing::skin_of(body, testing::FlatModel(), GetParam(), s)), 0.25,
                1e-14);
  }
}

TEST_P(SkinOfLevel, NamesEveryVertexByItsHost)
{
  const Body body(testing::cylinder(2), testing::halves(testing::cylinder(2)));
  const mesh::HostLayout hosts(body.skeleton);
  for (LocalIndex s = 0; s < 2; ++s) {
    const mesh::Skin skin = testing::skin_of(body, testing::CylinderModel(), GetParam(), s);
    std::set<std::pair<mesh::HostEntity, LocalIndex>> names;
    for (LocalIndex v = 0; v < skin.num_vertices(); ++v) {
      const mesh::HostEntity host = skin.vertex_host[at(v)];
      EXPECT_LT(host, hosts.num_on_skeleton());
      EXPECT_LT(skin.vertex_index[at(v)], mesh::num_points_of_host(hosts.kind_of(host), n()));
      EXPECT_TRUE(names.insert({host, skin.vertex_index[at(v)]}).second);
    }
  }
}

TEST_P(SkinOfLevel, ParentsAreTheTrianglesOfTheSubdomain)
{
  const Body body(testing::ball(2), testing::halves(testing::ball(2)));
  const mesh::Skin skin = testing::skin_of(body, testing::SphereModel({1.0}), GetParam(), 1);
  std::vector<LocalIndex> children(at(body.skeleton.num_triangles()), 0);
  for (const LocalIndex parent : skin.triangle_parent) ++children[at(parent)];
  for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
    const LocalIndex* sides = &body.skeleton.triangle_subdomains[2 * at(t)];
    EXPECT_EQ(children[at(t)], sides[0] == 1 || sides[1] == 1 ? n() * n() : 0);
  }
}

TEST_P(SkinOfLevel, NumberingCountsEveryLatticePointOnce)
{
  const Body body(testing::ball(2), testing::halves(testing::ball(2)));
  const auto refined = testing::refine_skin(body, testing::SphereModel({1.0}), GetParam(), 0);
  const auto& [complex, lattice] = refined;
  const mesh::Skin skin = extract_skin(complex, lattice, body.skeleton, 0);
  const mesh::LatticeNumbering numbering(complex, lattice.levels());
  EXPECT_EQ(numbering.num_points(), skin.num_vertices());

  std::set<LocalIndex> numbers;
  const auto expect_at = [&](LocalIndex number, const Vec3& point) {
    numbers.insert(number);
    ASSERT_EQ(testing::bits(point_at(std::span<const double>(skin.vertex_xyz), number)),
              testing::bits(point));
  };
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    for (LocalIndex k = 0; k <= n(); ++k) {
      expect_at(numbering.edge_point(e, k), lattice.edge_point(e, k));
    }
  }
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    for (LocalIndex j = 0; j <= n(); ++j) {
      for (LocalIndex i = 0; i + j <= n(); ++i) {
        expect_at(numbering.triangle_point(t, n(), {i, j}), lattice.triangle_point(t, {i, j}));
      }
    }
  }
  EXPECT_EQ(static_cast<LocalIndex>(numbers.size()), numbering.num_points());
  EXPECT_EQ(*numbers.begin(), 0);
  EXPECT_EQ(*numbers.rbegin(), numbering.num_points() - 1);
}

INSTANTIATE_TEST_SUITE_P(Levels, SkinOfLevel, ::testing::Range(0, 5));

// Four times as close with every halving of h: what projection at every level is for.
TEST(Skin, VolumesConvergeToTheFormulaWithOrderTwo)
{
  const Body ball(testing::ball(2), testing::one_subdomain_a_material(testing::ball(2)));
  const Body cylinder(testing::cylinder(2),
                      testing::one_subdomain_a_material(testing::cylinder(2)));
  const auto error = [](const Body& body, const model::Model& model, int levels, double exact) {
    return exact - volume_of(testing::skin_of(body, model, levels, 0));
  };
  for (int levels = 1; levels < 5; ++levels) {
    const testing::SphereModel sphere({1.0});
    const double of_ball = 4.0 / 3.0 * std::numbers::pi;
    EXPECT_GT(error(ball, sphere, levels, of_ball), 0.0);
    EXPECT_GT(
        std::log2(error(ball, sphere, levels - 1, of_ball) / error(ball, sphere, levels, of_ball)),
        1.7);
    const testing::CylinderModel round;
    EXPECT_GT(std::log2(error(cylinder, round, levels - 1, std::numbers::pi)
                        / error(cylinder, round, levels, std::numbers::pi)),
              1.9);
  }
}

TEST(Skin, OfOneTetIsThatTet)
{
  mesh::CoarseMesh coarse;
  coarse.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  coarse.tet_vertices = {0, 1, 2, 3};
  coarse.tet_material = {1};
  coarse.material_names = {"m"};
  coarse.face_vertices = {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3};
  coarse.face_patch = {0, 0, 0, 0};
  coarse.patch_names = {"p"};
  coarse.patch_surface = {0};
  const Body body(coarse, testing::one_subdomain_a_material(coarse));
  for (int levels = 0; levels < 4; ++levels) {
    const mesh::Skin skin = testing::skin_of(body, testing::FlatModel(), levels, 0);
    expect_closed_sphere(skin);
    EXPECT_EQ(skin.num_triangles(), 4 << (2 * levels));
    EXPECT_NEAR(volume_of(skin), 1.0 / 6.0, 1e-15);
  }
}

}  // namespace
}  // namespace tessera::refine

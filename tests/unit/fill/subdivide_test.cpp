// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/subdivide.hpp"

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/fill/check.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/refine/skin.hpp"

#include "support/bodies.hpp"
#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::fill {
namespace {

using testing::Body;

// One subdomain, refined and subdivided.
struct Subdivided {
  mesh::TetComplex complex;
  mesh::Skin skin;
  FillOutput tets;

  Subdivided(const Body& body, const model::Model& model, int levels, LocalIndex subdomain)
  {
    const IndexLists tets_of = mesh::subdomain_tets(body.decomposition);
    complex = mesh::tet_complex(body.coarse, body.skeleton, tets_of[subdomain]);
    const mesh::ProjectionLimiter none;
    const auto lattice =
        refine::refine_lattice(complex.faces, {body.coarse, body.skeleton, model, none, levels});
    skin = refine::extract_skin(complex.faces, lattice, body.skeleton, subdomain);
    tets = subdivide(complex, lattice);
  }

  [[nodiscard]] FillFacts facts() const
  {
    return check_fill({.vertex_xyz = skin.vertex_xyz, .triangle_vertices = skin.triangle_vertices},
                      tets);
  }
};

TEST(Subdivide, FillsEverySkinOfACubeWithChildrenOfItsVolume)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const Body body(cube, testing::slabs(cube, 2));
  for (int levels = 0; levels <= 4; ++levels) {
    for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
      const Subdivided filled(body, testing::FlatModel(), levels, s);
      EXPECT_NEAR(filled.facts().volume, 0.5, 1e-12);
      EXPECT_EQ(filled.tets.tet_vertices.size(), 4U * 24U << (3 * levels));
    }
  }
}

TEST(Subdivide, FillsTheSkinOfABall)
{
  const mesh::CoarseMesh ball = testing::ball(4);
  const Body body(ball, testing::halves(ball));
  const testing::SphereModel sphere({1.0});
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    EXPECT_NO_THROW(static_cast<void>(Subdivided(body, sphere, 3, s).facts()));
  }
}

// The skin that other kernels get is made from the skin's complex alone.
TEST(Subdivide, HasBitForBitTheSkinThatOtherKernelsGet)
{
  const mesh::CoarseMesh ball = testing::ball(4);
  const Body body(ball, testing::halves(ball));
  const testing::SphereModel sphere({1.0});
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    const Subdivided filled(body, sphere, 2, s);
    const mesh::Skin other = testing::skin_of(body, sphere, 2, s);
    EXPECT_EQ(filled.skin.vertex_host, other.vertex_host);
    EXPECT_EQ(filled.skin.vertex_index, other.vertex_index);
    EXPECT_EQ(filled.skin.triangle_vertices, other.triangle_vertices);
    EXPECT_EQ(filled.skin.triangle_parent, other.triangle_parent);
    ASSERT_EQ(filled.skin.vertex_xyz.size(), other.vertex_xyz.size());
    for (std::size_t v = 0; v < other.vertex_host.size(); ++v) {
      EXPECT_EQ(testing::bits(point_at(std::span<const double>(filled.skin.vertex_xyz), v)),
                testing::bits(point_at(std::span<const double>(other.vertex_xyz), v)));
    }
  }
}

TEST(Subdivide, NumbersAreKnownBeforehand)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(3);
  const Body body(cube, testing::slabs(cube, 3));
  for (int levels = 0; levels <= 4; ++levels) {
    for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
      const Subdivided filled(body, testing::FlatModel(), levels, s);
      const auto counts = count_subdivision(filled.complex, cube, levels);
      EXPECT_EQ(counts.tets, static_cast<GlobalIndex>(filled.tets.tet_vertices.size() / 4));
      EXPECT_EQ(
          counts.interior_vertices,
          static_cast<GlobalIndex>(filled.tets.vertex_xyz.size() / 3) - filled.skin.num_vertices());
    }
  }
}

// Bey: one choice of diagonal for all levels leaves at most three similarity classes a coarse tet;
// edge lengths over the smallest one tell them apart.
TEST(Subdivide, ChildrenOfACoarseTetHaveAtMostThreeShapes)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(1);
  for (std::size_t v = 0; v < cube.vertex_xyz.size(); v += 3) {  // A shape without symmetry.
    cube.vertex_xyz[v] += 0.31 * cube.vertex_xyz[v + 1];
    cube.vertex_xyz[v + 2] *= 1.23;
  }
  const Body body(cube, testing::one_subdomain_a_material(cube));
  const Subdivided filled(body, testing::FlatModel(), 3, 0);
  const std::span<const double> xyz(filled.tets.vertex_xyz);
  const std::size_t children = 512;
  for (std::size_t parent = 0; parent < 6; ++parent) {
    std::set<std::vector<long>> shapes;
    for (std::size_t t = parent * children; t < (parent + 1) * children; ++t) {
      std::vector<long> lengths;
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) {
          const Vec3 edge = point_at(xyz, filled.tets.tet_vertices[4 * t + b])
                            - point_at(xyz, filled.tets.tet_vertices[4 * t + a]);
          lengths.push_back(std::lround(1e9 * norm(edge)));
        }
      }
      std::sort(lengths.begin(), lengths.end());
      shapes.insert(lengths);
    }
    EXPECT_LE(shapes.size(), 3U);
  }
}

TEST(Subdivide, PieceBeyond32BitsIsRefused)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(1);
  const Body body(cube, testing::one_subdomain_a_material(cube));
  const auto tets_of = mesh::subdomain_tets(body.decomposition);
  const mesh::TetComplex complex = mesh::tet_complex(body.coarse, body.skeleton, tets_of[0]);
  const mesh::RefinedLattice lattice(mesh::lattice_levels(complex.faces, 9));
  EXPECT_THROW(static_cast<void>(subdivide(complex, lattice)), MeshError);
  EXPECT_EQ(count_subdivision(complex, cube, 9).tets, GlobalIndex{6} << 27);
}

}  // namespace
}  // namespace tessera::fill

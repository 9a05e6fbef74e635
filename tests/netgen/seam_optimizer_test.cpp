// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/seam_optimizer.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

namespace tessera {
namespace {

using testing::Body;

// Filled from their skins alone: these have the worst seams.
std::vector<mesh::Piece> filled_pieces(const Body& body, int levels)
{
  const testing::FlatModel model;
  const mesh::ProjectionLimiter limiter;
  const refine::RefineContext refine{body.coarse, body.skeleton, model, limiter, levels};
  const subdomain::PartitionedMesh cut(body.coarse, body.decomposition, levels);
  const auto kernel = netgen::make_fill_kernel();
  const fill::FillTry how{.start = fill::FillStart::skin, .settings = {.optimize_steps = 2}};
  std::vector<mesh::Piece> pieces;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    pieces.push_back(subdomain::fill_subdomain(cut, refine, s, how, *kernel).piece);
  }
  return pieces;
}

// Triangles on the geometry by the bits of their corners, with patch and subdomain.
using GeometryTriangles =
    std::map<std::set<std::array<std::uint64_t, 3>>, std::pair<LocalIndex, LocalIndex>>;

GeometryTriangles triangles_on_geometry(const std::vector<mesh::Piece>& pieces)
{
  GeometryTriangles triangles;
  for (const mesh::Piece& piece : pieces) {
    for (LocalIndex i = 0; i < piece.num_boundary(); ++i) {
      std::set<std::array<std::uint64_t, 3>> corners;
      for (std::size_t c = 0; c < 3; ++c) {
        const LocalIndex v = piece.boundary_vertices[3 * at(i) + c];
        corners.insert(testing::bits(point_at(std::span(piece.vertex_xyz), v)));
      }
      triangles[corners] = {piece.boundary_patch[at(i)], piece.subdomain};
    }
  }
  return triangles;
}

improve::ShapeSummary shapes_at_seams(const std::vector<mesh::Piece>& pieces)
{
  const auto on_seam = testing::vertices_on_seams(pieces);
  improve::TetMesh tets;
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    for (LocalIndex t = 0; t < pieces[s].num_tets(); ++t) {
      const LocalIndex* v = &pieces[s].tet_vertices[4 * at(t)];
      if (std::none_of(v, v + 4, [&](LocalIndex i) { return on_seam[s][at(i)] != 0; })) continue;
      for (const Vec3& p : pieces[s].corners(t)) {
        tets.tet_vertices.push_back(static_cast<LocalIndex>(tets.vertex_xyz.size() / 3));
        tets.vertex_xyz.insert(tets.vertex_xyz.end(), p.begin(), p.end());
      }
    }
  }
  return testing::measure_shapes(tets);
}

std::vector<mesh::Piece> improve_all(const Body& body, std::vector<mesh::Piece> pieces)
{
  const improve::SeamRegions regions(body.skeleton, body.decomposition);
  const auto optimizer = subdomain::make_seam_optimizer(false);
  const testing::ImproveSetup setup{*optimizer};
  const double volume = testing::volume_of(pieces);
  for (int phase = 0; phase < improve::kNumPhases; ++phase) {
    static_cast<void>(testing::improve_phase(regions, phase, setup, pieces));
    EXPECT_EQ(testing::first_flaw(pieces), "") << "phase " << phase;
    EXPECT_NEAR(testing::volume_of(pieces), volume, 1e-9 * volume);
  }
  return pieces;
}

// What must hold for any body: one mesh, the geometry as it was, better tets at the seams.
void expect_improved(const Body& body, int levels)
{
  const std::vector<mesh::Piece> filled = filled_pieces(body, levels);
  ASSERT_EQ(testing::first_flaw(filled), "");
  const std::vector<mesh::Piece> improved = improve_all(body, filled);
  EXPECT_EQ(triangles_on_geometry(improved), triangles_on_geometry(filled));
  const improve::ShapeSummary before = shapes_at_seams(filled);
  const improve::ShapeSummary after = shapes_at_seams(improved);
  EXPECT_GT(after.mean_mean_ratio, before.mean_mean_ratio + 0.01);
  EXPECT_GE(after.min_dihedral_deg, std::min(before.min_dihedral_deg, 12.0));
  EXPECT_GE(after.min_mean_ratio, std::min(before.min_mean_ratio, 0.35));
}

TEST(SeamOptimizer, MakesSeamsOfOctantsBetter)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(4);
  expect_improved({cube, testing::octants(cube)}, 1);
}

TEST(SeamOptimizer, KeepsTheInterfaceOfTwoMaterials)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(4);
  expect_improved({cube, testing::octants(cube)}, 1);
}

TEST(SeamOptimizer, WorksWherePiecesAreThinnerThanTheLayers)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(6);
  expect_improved({cube, testing::slabs(cube, 6)}, 1);
}

TEST(SeamOptimizer, GivesTheSameBitsAgain)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const Body body(cube, testing::octants(cube));
  const std::vector<mesh::Piece> filled = filled_pieces(body, 2);
  const std::vector<mesh::Piece> once = improve_all(body, filled);
  const std::vector<mesh::Piece> again = improve_all(body, filled);
  ASSERT_EQ(once.size(), 8U);
  ASSERT_EQ(again.size(), 8U);
  for (std::size_t s = 0; s < once.size(); ++s) {
    EXPECT_EQ(to_bytes(once[s]), to_bytes(again[s]));
  }
}

}  // namespace
}  // namespace tessera

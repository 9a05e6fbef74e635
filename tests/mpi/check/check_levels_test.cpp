// SPDX-License-Identifier: BSD-3-Clause
// What the checker says of meshes whose coarse edges are split on levels of their own: every
// combination of finer edges that two tets can have, and many that more tets can have.
#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_edges.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/refine/choose_levels.hpp"
#include "tessera/subdomain/count_pieces.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

#include "support/bodies.hpp"
#include "support/flat_model.hpp"
#include "support/graded_meshes.hpp"
#include "support/meshes.hpp"

#include "check_everywhere.hpp"

namespace tessera::testing {
namespace {

constexpr double kApart = 4.0;  // Of the copies, along x.

// Copies of some tets of a cube, numbered anyhow.
mesh::CoarseMesh copies_of(const mesh::CoarseMesh& cube, const std::vector<LocalIndex>& tets,
                           int num_copies)
{
  mesh::CoarseMesh coarse{
      .patch_names = {"outside"}, .patch_surface = {0}, .material_names = {"material"}};
  for (int copy = 0; copy < num_copies; ++copy) {
    std::map<LocalIndex, LocalIndex> number;
    for (const LocalIndex t : tets) {
      for (const LocalIndex v : cube.tet(t)) {
        const auto [entry, is_new] = number.emplace(v, coarse.num_vertices());
        coarse.tet_vertices.push_back(entry->second);
        if (!is_new) continue;
        const Vec3 p = cube.position(v);
        coarse.vertex_xyz.insert(coarse.vertex_xyz.end(), {p[0] + kApart * copy, p[1], p[2]});
      }
      coarse.tet_material.push_back(1);
    }
  }
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(coarse.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    coarse.face_vertices.insert(coarse.face_vertices.end(), triangle.vertices.begin(),
                                triangle.vertices.end());
    coarse.face_patch.push_back(0);
  }
  return shuffled(coarse, 1);
}

LocalIndex copy_of(const mesh::CoarseMesh& coarse, LocalIndex v)
{
  return static_cast<LocalIndex>(coarse.position(v)[0] / kApart);
}

// The tets of each copy are dealt out to the subdomains.
mesh::Decomposition deal_out(const mesh::CoarseMesh& coarse, LocalIndex num_subdomains)
{
  mesh::Decomposition cut{.subdomain_material = std::vector<LocalIndex>(at(num_subdomains), 1)};
  std::map<LocalIndex, LocalIndex> next;
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    cut.tet_subdomain.push_back(next[copy_of(coarse, coarse.tet(t)[0])]++ % num_subdomains);
  }
  return cut;
}

// The edges of copy c that are one level finer are the bits of finer[c].
mesh::EdgeLevels levels_of(const mesh::CoarseMesh& coarse, const std::vector<std::uint64_t>& finer,
                           int level)
{
  std::vector<LocalIndex> edges = mesh::coarse_edges(coarse);
  std::map<LocalIndex, int> next;
  std::vector<std::int8_t> levels;
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    const LocalIndex copy = copy_of(coarse, edges[e]);
    const bool is_finer = (finer[at(copy)] >> next[copy]++ & 1U) != 0;
    levels.push_back(static_cast<std::int8_t>(level + (is_finer ? 1 : 0)));
  }
  return {std::move(edges), std::move(levels)};
}

class NoKernel final : public fill::Kernel {
 public:
  [[nodiscard]] fill::FillOutput fill(const fill::FillInput& /*input*/,
                                      const fill::KernelSettings& /*settings*/) const override
  {
    throw MeshError("not asked for");
  }
};

// As the program writes it.
MeshFiles subdivided(const Body& body, const mesh::EdgeLevels& levels)
{
  const subdomain::PartitionedMesh cut(body.coarse, body.decomposition, levels);
  const FlatModel model;
  const mesh::ProjectionLimiter none;
  const auto ids = number::IdLayout::by_host(mesh::HostLayout(body.skeleton),
                                             mesh::lattice_levels(body.skeleton, levels),
                                             subdomain::count_subdivided_pieces(cut, levels));
  const std::string length_unit = "mm";
  MeshFiles files;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    const subdomain::FilledPiece filled =
        fill_subdomain(cut, {body.coarse, body.skeleton, model, none, levels}, s,
                       {.kernel = fill::KernelKind::subdivide}, NoKernel());
    subdomain::PieceArrays arrays = subdomain::piece_arrays(
        filled.piece, {body.coarse, body.skeleton, ids, length_unit}, false);
    files.tets.push_back(std::move(arrays.tets));
    files.boundary.push_back(std::move(arrays.boundary));
  }
  EXPECT_EQ(files.tets.size(), at(body.num_subdomains()));
  return files;
}

void expect_conforms(const Body& body, const mesh::EdgeLevels& levels, int num_copies)
{
  const check::CheckReport report = check_everywhere(subdivided(body, levels));
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_open_seam_triangles, 0);
  EXPECT_EQ(report.num_nonmanifold_edges, 0);
  EXPECT_EQ(report.euler_characteristic, num_copies);
  EXPECT_EQ(report.num_components, num_copies);
  double volume = 0.0;
  for (LocalIndex t = 0; t < body.coarse.num_tets(); ++t) {
    const auto v = body.coarse.tet(t);
    volume += tet_volume(body.coarse.position(v[0]), body.coarse.position(v[1]),
                         body.coarse.position(v[2]), body.coarse.position(v[3]));
  }
  EXPECT_NEAR(report.volume, volume, 1e-9 * volume);
}

TEST(CheckLevels, TwoTetsConformWhicheverOfTheirNineEdgesAreFiner)
{
  constexpr int kNumSubsets = 1 << 9;
  const mesh::CoarseMesh coarse = copies_of(kuhn_cube(1), {0, 3}, kNumSubsets);
  const Body body(coarse, deal_out(coarse, 2));
  ASSERT_EQ(mesh::coarse_edges(coarse).size(), 2U * 9U * kNumSubsets);
  std::vector<std::uint64_t> finer(kNumSubsets);
  for (std::size_t copy = 0; copy < finer.size(); ++copy) finer[copy] = copy;
  for (const int level : {0, 1}) {
    expect_conforms(body, levels_of(coarse, finer, level), kNumSubsets);
  }
}

TEST(CheckLevels, MoreTetsConformWhicheverEdgesAreFiner)
{
  constexpr int kNumCopies = 60;
  std::mt19937_64 random(5);
  for (const LocalIndex num_tets : {6, 12, 18, 24}) {  // Whole cells.
    std::vector<LocalIndex> tets(at(num_tets));
    for (LocalIndex t = 0; t < num_tets; ++t) tets[at(t)] = t;
    const mesh::CoarseMesh coarse = copies_of(kuhn_cube(2), tets, kNumCopies);
    const Body body(coarse, deal_out(coarse, 3));
    std::vector<std::uint64_t> finer(kNumCopies);
    for (std::uint64_t& bits : finer) bits = random();
    expect_conforms(body, levels_of(coarse, finer, num_tets == 6 ? 1 : 0), kNumCopies);
  }
}

}  // namespace
}  // namespace tessera::testing

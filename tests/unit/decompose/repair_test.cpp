// SPDX-License-Identifier: BSD-3-Clause
// Whatever the partitioner deals out, decompose() ends with every promise kept.
#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/decompose/decompose.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"

#include "support/meshes.hpp"

#include "partitioners.hpp"

namespace tessera::decompose {
namespace {

DecomposeResult decompose_checked(const mesh::CoarseMesh& mesh, LocalIndex subdomains,
                                  const GraphPartitioner& partitioner)
{
  const DecomposeOptions options{.subdomains = subdomains};
  auto result = decompose(mesh, options, predicted_fine_tets(mesh, 1), partitioner);
  EXPECT_NO_THROW(validate(mesh, result.decomposition));
  EXPECT_GE(result.decomposition.num_subdomains(), result.report.num_wanted);
  EXPECT_EQ(result.decomposition.num_subdomains(), result.report.num_subdomains);
  return result;
}

Vec3 centroid(const mesh::CoarseMesh& mesh, LocalIndex t)
{
  Vec3 sum{};
  for (const LocalIndex v : mesh.tet(t)) sum = sum + mesh.position(v);
  return 0.25 * sum;
}

// Cell of the cube of n^3 cells that a tet lies in.
std::array<int, 3> cell_of(LocalIndex t, int n)
{
  const int cell = t / 6;
  return {cell % n, cell / n % n, cell / (n * n)};
}

TEST(Repair, EndsForRandomParts)
{
  const auto mesh = testing::kuhn_cube(4);
  for (unsigned seed = 0; seed < 40; ++seed) {
    for (const LocalIndex k : {2, 5, 17, 120, 380}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", " << k << " parts");
      decompose_checked(mesh, k, testing::random_partitioner(seed));
    }
  }
}

TEST(Repair, EndsForRandomPartsOfTwoMaterials)
{
  const auto mesh = testing::two_material_cube(4);
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    decompose_checked(mesh, 9, testing::random_partitioner(seed));
  }
}

TEST(Repair, EndsForRandomPartsOfALargerMesh)
{
  const auto mesh = testing::kuhn_cube(10);
  decompose_checked(mesh, 2, testing::random_partitioner(3));
  decompose_checked(mesh, 200, testing::random_partitioner(3));
}

TEST(Repair, EndsForACheckerboard)
{
  const int n = 4;
  const auto mesh = testing::kuhn_cube(n);
  const testing::FakePartitioner cells([](LocalIndex t, LocalIndex) {
    const auto [i, j, k] = cell_of(t, n);
    return (i + j + k) % 2;
  });
  const testing::FakePartitioner tets([](LocalIndex t, LocalIndex) { return t % 2; });
  decompose_checked(mesh, 2, cells);
  decompose_checked(mesh, 2, tets);
}

TEST(Repair, OpensAPartThatEnclosesAnother)
{
  const int n = 6;
  const auto mesh = testing::kuhn_cube(n);
  const testing::FakePartitioner core([](LocalIndex t, LocalIndex) {
    const auto cell = cell_of(t, n);
    const bool is_inside =
        std::all_of(cell.begin(), cell.end(), [](int c) { return c >= 2 && c < 4; });
    return is_inside ? 1 : 0;
  });
  const auto result = decompose_checked(mesh, 2, core);
  EXPECT_GT(result.report.num_splits, 0);
}

TEST(Repair, OpensAMaterialThatEnclosesAnother)
{
  const int n = 6;
  auto mesh = testing::kuhn_cube(n);
  mesh.material_names.emplace_back("core");
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const Vec3 c = centroid(mesh, t);
    const bool is_inside =
        std::all_of(c.begin(), c.end(), [](double x) { return x > 1.0 / 3 && x < 2.0 / 3; });
    if (is_inside) mesh.tet_material[static_cast<std::size_t>(t)] = 2;
  }
  const auto result = decompose_checked(mesh, 2, *make_metis_partitioner());
  EXPECT_EQ(result.report.num_wanted, 2);
  EXPECT_EQ(result.decomposition.num_subdomains(), 3);
}

// Keeps the tets for which `keep` holds: a cube with holes.
template <class Keep>
mesh::CoarseMesh carve(const mesh::CoarseMesh& cube, const Keep& keep)
{
  mesh::CoarseMesh carved;
  carved.vertex_xyz = cube.vertex_xyz;
  carved.material_names = cube.material_names;
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    if (!keep(t)) continue;
    const auto tet = cube.tet(t);
    carved.tet_vertices.insert(carved.tet_vertices.end(), tet.begin(), tet.end());
    carved.tet_material.push_back(1);
  }
  return carved;
}

TEST(Repair, OpensAVoidOfTheModel)
{
  const int n = 5;
  const auto mesh = carve(testing::kuhn_cube(n), [](LocalIndex t) {
    return cell_of(t, n) != std::array<int, 3>{2, 2, 2};
  });
  const auto result = decompose_checked(mesh, 1, *make_metis_partitioner());
  EXPECT_EQ(result.decomposition.num_subdomains(), 2);
}

TEST(Repair, PartsAModelThatTouchesItselfAtAnEdgeOrAVertex)
{
  const int n = 4;
  const auto cube = testing::kuhn_cube(n);
  // A ring of cells whose ends meet at an edge only, and one whose ends meet at a vertex only.
  const std::set<std::array<int, 3>> edge_ring{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                               {2, 2, 0}, {1, 2, 0}, {1, 1, 0}};
  const std::set<std::array<int, 3>> vertex_ring{{0, 0, 0}, {0, 1, 0}, {0, 2, 0},
                                                 {0, 2, 1}, {1, 2, 1}, {1, 1, 1}};
  for (const auto& ring : {edge_ring, vertex_ring}) {
    const auto mesh = carve(cube, [&](LocalIndex t) { return ring.count(cell_of(t, n)) > 0; });
    decompose_checked(mesh, 1, *make_metis_partitioner());
  }
}

TEST(Repair, PartsBlocksThatTouchAtAnEdgeOrAVertex)
{
  const int n = 4;
  const auto mesh = testing::kuhn_cube(n);
  const testing::FakePartitioner at_edge([](LocalIndex t, LocalIndex) {
    const auto [i, j, k] = cell_of(t, n);
    return (i < 2) == (j < 2) ? 0 : 1;
  });
  const testing::FakePartitioner at_vertex([](LocalIndex t, LocalIndex) {
    const auto [i, j, k] = cell_of(t, n);
    const bool low = i < 2 && j < 2 && k < 2;
    const bool high = i >= 2 && j >= 2 && k >= 2;
    return low || high ? 0 : 1;
  });
  decompose_checked(mesh, 2, at_edge);
  decompose_checked(mesh, 2, at_vertex);
}

TEST(Repair, GivesSliversToANeighbour)
{
  const auto mesh = testing::kuhn_cube(6);
  // Two halves, and single tets of each lost in the other.
  const testing::FakePartitioner halves([&mesh](LocalIndex t, LocalIndex) {
    const int half = t < mesh.num_tets() / 2 ? 0 : 1;
    return t % 97 == 5 ? 1 - half : half;
  });
  const auto result = decompose_checked(mesh, 2, halves);
  EXPECT_EQ(result.decomposition.num_subdomains(), 2);
}

TEST(Repair, FillsUpEmptyParts)
{
  const auto mesh = testing::kuhn_cube(3);
  const testing::FakePartitioner all_in_one([](LocalIndex, LocalIndex) { return 0; });
  const auto result = decompose_checked(mesh, 10, all_in_one);
  EXPECT_EQ(result.report.num_wanted, 10);
}

}  // namespace
}  // namespace tessera::decompose

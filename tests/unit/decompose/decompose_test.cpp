// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/decompose/decompose.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"

#include "support/meshes.hpp"

#include "decompose/partition/initial_partition.hpp"
#include "partitioners.hpp"

namespace tessera::decompose {
namespace {

DecomposeResult decompose_by(const mesh::CoarseMesh& mesh, LocalIndex subdomains,
                             const GraphPartitioner& partitioner)
{
  const DecomposeOptions options{.subdomains = subdomains};
  return decompose(mesh, options, predicted_fine_tets(mesh, 1), partitioner);
}

DecomposeResult decompose_by_metis(const mesh::CoarseMesh& mesh, LocalIndex subdomains)
{
  return decompose_by(mesh, subdomains, *make_metis_partitioner());
}

// The number of connected parts that a range of subdomains falls into.
int num_parts_of_range(const mesh::Decomposition& d, LocalIndex begin, LocalIndex end)
{
  std::set<LocalIndex> left;
  for (LocalIndex s = begin; s < end; ++s) left.insert(s);
  int parts = 0;
  while (!left.empty()) {
    std::vector<LocalIndex> stack{*left.begin()};
    left.erase(left.begin());
    ++parts;
    while (!stack.empty()) {
      const auto s = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      for (LocalIndex i = d.neighbour_offsets[s]; i < d.neighbour_offsets[s + 1]; ++i) {
        const LocalIndex neighbour = d.neighbours[static_cast<std::size_t>(i)];
        if (left.erase(neighbour) > 0) stack.push_back(neighbour);
      }
    }
  }
  return parts;
}

TEST(Decompose, KeepsItsPromisesForEveryNumberOfSubdomains)
{
  const auto mesh = testing::kuhn_cube(2);
  for (LocalIndex k = 1; k <= mesh.num_tets(); ++k) {
    const auto result = decompose_by_metis(mesh, k);
    EXPECT_NO_THROW(validate(mesh, result.decomposition)) << k << " subdomains";
    EXPECT_GE(result.decomposition.num_subdomains(), k);
  }
}

TEST(Decompose, KeepsItsPromisesWithOtherPartitioners)
{
  const auto mesh = testing::kuhn_cube(4);
  for (const auto make_partitioner : {&make_block_partitioner, &make_octree_partitioner}) {
    for (const LocalIndex k : {1, 2, 3, 5, 8, 13, 100, 383, 384}) {
      const auto result = decompose_by(mesh, k, *make_partitioner());
      EXPECT_NO_THROW(validate(mesh, result.decomposition)) << k << " subdomains";
      EXPECT_GE(result.decomposition.num_subdomains(), k);
    }
  }
}

TEST(Decompose, BalancesTheWeights)
{
  const auto mesh = testing::kuhn_cube(8);
  const auto result = decompose_by_metis(mesh, 16);
  EXPECT_LT(result.report.max_weight, 1.15 * result.report.mean_weight);
  const auto& weight = result.decomposition.subdomain_weight;
  EXPECT_GT(*std::min_element(weight.begin(), weight.end()), 0.75 * result.report.mean_weight);
}

TEST(Decompose, GivesEachPieceOfAMaterialItsShare)
{
  const auto mesh = testing::two_material_cube(4);
  auto weight = predicted_fine_tets(mesh, 1);
  for (std::size_t t = 0; t < weight.size(); ++t) {
    if (mesh.tet_material[t] == 2) weight[t] *= 3.0;
  }
  const auto result = decompose(mesh, {.subdomains = 12}, weight, *make_metis_partitioner());
  validate(mesh, result.decomposition);
  const auto& material = result.decomposition.subdomain_material;
  EXPECT_GE(std::count(material.begin(), material.end(), 1), 3);
  EXPECT_GE(std::count(material.begin(), material.end(), 2), 9);
}

// Slabs of a cube, across the first axis.
std::vector<LocalIndex> slabs_of(const mesh::CoarseMesh& mesh, LocalIndex num_slabs)
{
  std::vector<LocalIndex> tet_part;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    double sum = 0.0;
    for (const LocalIndex v : mesh.tet(t)) sum += mesh.position(v)[0];
    tet_part.push_back(static_cast<LocalIndex>(0.25 * sum * num_slabs));
  }
  return tet_part;
}

TEST(Decompose, CutsNoSubdomainOutOfTwoParts)
{
  const auto mesh = testing::kuhn_cube(8);
  const std::vector<LocalIndex> tet_part = slabs_of(mesh, 4);
  const auto weight = predicted_fine_tets(mesh, 1);
  for (const LocalIndex k : {1, 4, 11}) {
    const auto result =
        decompose(mesh, {.subdomains = k}, weight, *make_metis_partitioner(), tet_part);
    validate(mesh, result.decomposition);
    EXPECT_GE(result.decomposition.num_subdomains(), std::max(k, 4));
    std::vector<std::set<LocalIndex>> parts(at(result.decomposition.num_subdomains()));
    for (std::size_t t = 0; t < tet_part.size(); ++t) {
      parts[at(result.decomposition.tet_subdomain[t])].insert(tet_part[t]);
    }
    for (const auto& of_subdomain : parts) EXPECT_EQ(of_subdomain.size(), 1U);
  }
}

TEST(Decompose, RefusesPartsOfAnotherMesh)
{
  const auto mesh = testing::kuhn_cube(2);
  const auto weight = predicted_fine_tets(mesh, 1);
  const std::vector<LocalIndex> tet_part(3, 0);
  EXPECT_THROW((void)decompose(mesh, {}, weight, *make_metis_partitioner(), tet_part), MeshError);
}

TEST(AllotParts, FollowsTheWeightsBetweenOneAndAllTetsOfAPiece)
{
  const auto mesh = testing::two_material_cube(2);
  std::vector<double> weight(static_cast<std::size_t>(mesh.num_tets()), 1.0);
  for (std::size_t t = 0; t < weight.size(); ++t) {
    if (mesh.tet_material[t] == 2) weight[t] = 3.0;
  }
  const TetGraph graph = make_tet_graph(mesh, weight);
  const auto pieces = connected_pieces(graph);
  EXPECT_EQ(allot_parts(graph, pieces, 2), (std::vector<LocalIndex>{1, 1}));
  EXPECT_EQ(allot_parts(graph, pieces, 12), (std::vector<LocalIndex>{3, 9}));
  EXPECT_EQ(allot_parts(graph, pieces, 40), (std::vector<LocalIndex>{16, 24}));
}

TEST(Decompose, RaisesTheRequestToOneSubdomainAPiece)
{
  const auto mesh = testing::two_material_cube(2);
  const auto result = decompose_by_metis(mesh, 1);
  validate(mesh, result.decomposition);
  EXPECT_EQ(result.report.num_wanted, 2);
  EXPECT_EQ(result.report.num_subdomains, 2);
}

TEST(Decompose, GivesAtMostOneSubdomainATet)
{
  for (const int n : {1, 3}) {
    const auto mesh = testing::kuhn_cube(n);
    const DecomposeResult result = decompose_by_metis(mesh, mesh.num_tets() + 1);
    EXPECT_EQ(result.report.num_wanted, mesh.num_tets());
    EXPECT_EQ(result.report.num_subdomains, mesh.num_tets());
    EXPECT_NO_THROW(validate(mesh, result.decomposition));
  }
}

TEST(Decompose, RefusesANegativeRequestAndWrongWeights)
{
  const auto mesh = testing::kuhn_cube(1);
  EXPECT_THROW((void)decompose_by_metis(mesh, -1), ConfigError);
  const std::vector<double> too_few(5, 1.0);
  EXPECT_THROW((void)decompose(mesh, {.subdomains = 2}, too_few, *make_block_partitioner()),
               MeshError);
}

TEST(Decompose, RefusesAPartitionerThatLies)
{
  const auto mesh = testing::kuhn_cube(2);
  const testing::FakePartitioner beyond([](LocalIndex, LocalIndex num_parts) { return num_parts; });
  EXPECT_THROW((void)decompose_by(mesh, 3, beyond), MeshError);
}

TEST(Decompose, ChoosesTheNumberFromTheMeshAlone)
{
  const auto mesh = testing::kuhn_cube(6);
  const std::vector<double> heavy(static_cast<std::size_t>(mesh.num_tets()), 1000.0);
  const std::vector<double> light(heavy.size(), 8.0);
  const auto partitioner = make_metis_partitioner();
  const auto wanted = [&](const DecomposeOptions& options, const std::vector<double>& weight) {
    return decompose(mesh, options, weight, *partitioner).report.num_wanted;
  };
  EXPECT_EQ(wanted({.tets_a_subdomain = 1e5}, heavy), 13);  // 1296 tets of 1000.
  EXPECT_EQ(wanted({}, heavy), 26);
  EXPECT_EQ(wanted({}, light), kLeastAutoSubdomains);
  EXPECT_EQ(wanted({.least = 20}, light), 20);
  EXPECT_EQ(wanted({.parts = 2}, light), 2 * kAutoSubdomainsAPart);
  EXPECT_EQ(wanted({.tets_a_subdomain = 1.0}, heavy), mesh.num_tets());
  EXPECT_EQ(decompose_by_metis(testing::kuhn_cube(1), 0).report.num_wanted, 6);  // All its tets.
}

TEST(Decompose, GivesTheSameBitsEachTime)
{
  const auto mesh = testing::two_material_cube(6);
  const auto once = to_bytes(decompose_by_metis(mesh, 20).decomposition);
  const auto again = to_bytes(decompose_by_metis(mesh, 20).decomposition);
  EXPECT_EQ(once, again);
}

TEST(Decompose, NumbersNeighboursTogether)
{
  const auto mesh = testing::kuhn_cube(8);
  const auto result = decompose_by_metis(mesh, 32);
  const mesh::Decomposition& d = result.decomposition;
  double along_order = 0.0;
  for (LocalIndex begin = 0; begin + 8 <= d.num_subdomains(); ++begin) {
    const int parts = num_parts_of_range(d, begin, begin + 8);
    EXPECT_LE(parts, 3) << "subdomains " << begin << " to " << begin + 7;
    along_order += parts;
  }
  EXPECT_LT(along_order / (d.num_subdomains() - 7), 1.5);
}

TEST(Decompose, ReportsTheSeamsOfTheResult)
{
  const auto mesh = testing::two_material_cube(4);
  const auto one_each = decompose_by_metis(mesh, 2).report;
  EXPECT_EQ(one_each.seam_area, 0.0);  // an interface of materials is no seam
  EXPECT_EQ(one_each.min_seam_dihedral_deg, 180.0);
  const auto many = decompose_by_metis(mesh, 8).report;
  EXPECT_GT(many.seam_area, 0.0);
  EXPECT_GE(many.min_seam_dihedral_deg, 45.0 - 1e-9);  // of a Kuhn tet
  EXPECT_LE(many.min_seam_dihedral_deg, 90.0 + 1e-9);
}

TEST(PredictedFineTets, GrowEightfoldALevel)
{
  const auto mesh = testing::kuhn_cube(2);
  const auto num_tets = static_cast<std::size_t>(mesh.num_tets());
  EXPECT_EQ(predicted_fine_tets(mesh, 0), std::vector<double>(num_tets, 1.0));
  EXPECT_EQ(predicted_fine_tets(mesh, 3), std::vector<double>(num_tets, 512.0));
}

}  // namespace
}  // namespace tessera::decompose

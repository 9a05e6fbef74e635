// SPDX-License-Identifier: BSD-3-Clause
// Every promise that validate() checks, broken by hand.
#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/decompose/decompose.hpp"

#include "support/meshes.hpp"

#include "decompose/numbering.hpp"

namespace tessera::decompose {
namespace {

constexpr int kCells = 4;

// The decomposition of a kuhn_cube(kCells) by its cells; kept free of validate() itself.
mesh::Decomposition by_cell(const mesh::CoarseMesh& mesh,
                            const std::function<LocalIndex(int, int, int)>& subdomain)
{
  std::vector<LocalIndex> tet_subdomain;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const int cell = t / 6;
    tet_subdomain.push_back(
        subdomain(cell % kCells, cell / kCells % kCells, cell / (kCells * kCells)));
  }
  const std::vector<double> weight(tet_subdomain.size(), 1.0);
  return make_decomposition(make_tet_graph(mesh, weight), std::move(tet_subdomain));
}

void expect_rejected(const mesh::CoarseMesh& mesh, const mesh::Decomposition& decomposition,
                     const std::string& because)
{
  try {
    validate(mesh, decomposition);
    FAIL() << "accepted; must be rejected because: " << because;
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find(because), std::string::npos) << error.what();
  }
}

class Validate : public ::testing::Test {
 protected:
  mesh::CoarseMesh cube_ = testing::kuhn_cube(kCells);
  mesh::Decomposition slabs_ = by_cell(cube_, [](int i, int, int) { return i / 2; });
};

TEST_F(Validate, AcceptsSlabs) { EXPECT_NO_THROW(validate(cube_, slabs_)); }

TEST_F(Validate, RejectsAnEmptySubdomain)
{
  slabs_.subdomain_material.push_back(1);
  slabs_.subdomain_weight.push_back(0.0);
  slabs_.neighbour_offsets.push_back(slabs_.neighbour_offsets.back());
  expect_rejected(cube_, slabs_, "subdomain 2 is empty");
}

TEST_F(Validate, RejectsASubdomainInTwoParts)
{
  expect_rejected(cube_, by_cell(cube_, [](int i, int, int) { return i == 0 || i == 3 ? 0 : 1; }),
                  "not face-connected");
}

TEST_F(Validate, RejectsTwoMaterials)
{
  const auto mesh = testing::two_material_cube(kCells);
  expect_rejected(mesh, by_cell(mesh, [](int, int j, int) { return j / 2; }),
                  "of another material");
}

TEST_F(Validate, RejectsAnEdgeWithFourTriangles)
{
  // Connected at k = 0, two bars that touch at an edge above.
  const auto d = by_cell(cube_, [](int i, int j, int k) {
    return k == 0 || (i < 2) == (j < 2) ? 0 : (i < 2 ? 1 : 2);
  });
  expect_rejected(cube_, d, "subdomain 0 at vertex");
}

TEST_F(Validate, RejectsFansThatTouchAtAVertex)
{
  // A chain of cells whose first and last share nothing but the vertex between them.
  const std::set<std::array<int, 3>> chain{{1, 1, 1}, {0, 1, 1}, {0, 2, 1}, {0, 3, 1},
                                           {0, 3, 2}, {1, 3, 2}, {2, 3, 2}, {2, 2, 2}};
  const auto d = by_cell(cube_, [&](int i, int j, int k) {
    return chain.contains({i, j, k}) ? 0 : 1;
  });
  expect_rejected(cube_, d, "here are not face-connected");
}

TEST_F(Validate, RejectsAnEnclosedSubdomain)
{
  const auto d =
      by_cell(cube_, [](int i, int j, int k) { return i == 1 && j == 1 && k == 1 ? 1 : 0; });
  expect_rejected(cube_, d, "more than one surface");
}

TEST_F(Validate, RejectsAWrongGraph)
{
  auto wrong_count = slabs_;
  ++wrong_count.neighbour_triangles.front();
  expect_rejected(cube_, wrong_count, "the graph counts");
  auto wrong_area = slabs_;
  wrong_area.neighbour_area.front() *= 2.0;
  expect_rejected(cube_, wrong_area, "not symmetric");
  auto no_edges = slabs_;
  no_edges.neighbour_offsets.assign(no_edges.neighbour_offsets.size(), 0);
  no_edges.neighbours.clear();
  no_edges.neighbour_triangles.clear();
  no_edges.neighbour_area.clear();
  expect_rejected(cube_, no_edges, "not in the graph");
}

TEST_F(Validate, RejectsArraysOfWrongLength)
{
  slabs_.tet_subdomain.pop_back();
  expect_rejected(cube_, slabs_, "wrong length");
}

}  // namespace
}  // namespace tessera::decompose

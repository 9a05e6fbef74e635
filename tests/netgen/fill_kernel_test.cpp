// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "skins.hpp"

namespace tessera {
namespace {

using fill::FillInput;
using fill::FillOutput;
using fill::KernelSettings;
using testing::cube_skin;
using testing::sphere_skin;

FillOutput fill_skin(const FillInput& skin, const KernelSettings& settings = {})
{
  return netgen::make_fill_kernel()->fill(skin, settings);
}

// Corners turned until the lowest vertex comes first: the same for equal oriented triangles.
using Triangle = std::array<LocalIndex, 3>;
Triangle oriented(Triangle t)
{
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::vector<Triangle> triangles_of(const FillInput& skin)
{
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < skin.triangle_vertices.size(); t += 3) {
    triangles.push_back(oriented(
        {skin.triangle_vertices[t], skin.triangle_vertices[t + 1], skin.triangle_vertices[t + 2]}));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<Triangle> boundary_of(const FillOutput& piece)
{
  std::vector<Triangle> triangles;
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(piece.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    const auto first = 4 * static_cast<std::size_t>(triangle.tets[0]);
    const auto& corners = mesh::kTetFaceCorners[static_cast<std::size_t>(triangle.corners[0])];
    triangles.push_back(
        oriented({piece.tet_vertices[first + corners[0]], piece.tet_vertices[first + corners[1]],
                  piece.tet_vertices[first + corners[2]]}));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<double> tet_volumes(const FillOutput& piece)
{
  const std::span<const double> xyz(piece.vertex_xyz);
  std::vector<double> volumes;
  for (std::size_t t = 0; t < piece.tet_vertices.size(); t += 4) {
    const auto p = [&](std::size_t c) { return point_at(xyz, piece.tet_vertices[t + c]); };
    volumes.push_back(tet_volume(p(0), p(1), p(2), p(3)));
  }
  return volumes;
}

void expect_fills(const FillInput& skin, const FillOutput& piece)
{
  ASSERT_GE(piece.vertex_xyz.size(), skin.vertex_xyz.size());
  EXPECT_TRUE(std::equal(skin.vertex_xyz.begin(), skin.vertex_xyz.end(), piece.vertex_xyz.begin()))
      << "a vertex of the skin moved or changed its place";
  EXPECT_EQ(boundary_of(piece), triangles_of(skin));
  double sum = 0.0;
  for (const double volume : tet_volumes(piece)) {
    EXPECT_GT(volume, 0.0);
    sum += volume;
  }
  const double inside = testing::enclosed_volume(skin);
  EXPECT_NEAR(sum, inside, 1e-9 * inside);
  const std::set<LocalIndex> used(piece.tet_vertices.begin(), piece.tet_vertices.end());
  EXPECT_EQ(3 * used.size(), piece.vertex_xyz.size()) << "a vertex belongs to no tet";
}

std::vector<double> edge_lengths(const FillOutput& piece)
{
  std::set<std::pair<LocalIndex, LocalIndex>> edges;
  for (std::size_t t = 0; t < piece.tet_vertices.size(); t += 4) {
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      edges.insert(std::minmax(piece.tet_vertices[t + a], piece.tet_vertices[t + b]));
    }
  }
  const std::span<const double> xyz(piece.vertex_xyz);
  std::vector<double> lengths;
  for (const auto& [a, b] : edges) lengths.push_back(norm(point_at(xyz, a) - point_at(xyz, b)));
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

TEST(FillKernel, PieceHasExactlyTheSkinAsBoundary)
{
  const FillInput cube = cube_skin(4);
  expect_fills(cube, fill_skin(cube));
  const FillInput sphere = sphere_skin(2);
  expect_fills(sphere, fill_skin(sphere));
}

TEST(FillKernel, FillsOneTet)
{
  FillInput skin;
  skin.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const auto& face : mesh::kTetFaceCorners) {
    for (const std::size_t c : face) skin.triangle_vertices.push_back(static_cast<LocalIndex>(c));
  }
  expect_fills(skin, fill_skin(skin));
}

TEST(FillKernel, KeepsTheSkinWithoutSizeSamples)
{
  FillInput skin = cube_skin(4);
  skin.size_xyz.clear();
  skin.size_h.clear();
  expect_fills(skin, fill_skin(skin));
}

TEST(FillKernel, KeepsTheSkinForEveryFallback)
{
  const FillInput skin = cube_skin(4);
  for (const unsigned seed : {1U, 2U, 77U}) {
    expect_fills(skin, fill_skin(skin, {.grading = 0.3, .point_order_seed = seed}));
  }
  for (const int steps : {0, 1, 6}) expect_fills(skin, fill_skin(skin, {.optimize_steps = steps}));
  for (const double grading : {0.1, 1.0}) expect_fills(skin, fill_skin(skin, {.grading = grading}));
}

// The sum of eta^-3, which grows without bound as a tet becomes flat. Swaps are for the worst tets:
// they may lower the mean.
double energy(const FillOutput& tets)
{
  const std::span<const double> xyz(tets.vertex_xyz);
  double sum = 0.0;
  for (std::size_t t = 0; t < tets.tet_vertices.size(); t += 4) {
    const LocalIndex* v = &tets.tet_vertices[t];
    sum += std::pow(quality::mean_ratio({point_at(xyz, v[0]), point_at(xyz, v[1]),
                                         point_at(xyz, v[2]), point_at(xyz, v[3])}),
                    -3.0);
  }
  return sum;
}

TEST(FillKernel, SwapsEdgesAndFacesOfGivenTets)
{
  FillInput skin = cube_skin(5);
  const FillOutput rough = fill_skin(skin, {.optimize_steps = 0});
  skin.start = rough;
  const FillOutput better = fill_skin(skin);
  expect_fills(skin, better);
  EXPECT_NE(better.tet_vertices, rough.tet_vertices);
  EXPECT_EQ(better.vertex_xyz, rough.vertex_xyz);
  EXPECT_LT(energy(better), energy(rough));
  EXPECT_EQ(fill_skin(skin, {.optimize_steps = 0}).tet_vertices, rough.tet_vertices);
}

TEST(FillKernel, ReadsOfTheSettingsTheStepsAloneIfThereAreTets)
{
  FillInput skin = cube_skin(4);
  skin.start = fill_skin(skin, {.optimize_steps = 0});
  const FillOutput better = fill_skin(skin);
  FillInput without_sizes = skin;
  without_sizes.size_xyz.clear();
  without_sizes.size_h.clear();
  for (const FillOutput& other :
       {fill_skin(skin, {.grading = 0.9, .point_order_seed = 5}), fill_skin(without_sizes)}) {
    EXPECT_EQ(other.vertex_xyz, better.vertex_xyz);
    EXPECT_EQ(other.tet_vertices, better.tet_vertices);
  }
  EXPECT_NE(fill_skin(skin, {.optimize_steps = 0}).tet_vertices, better.tet_vertices);
}

TEST(FillKernel, SeedGivesAnotherMesh)
{
  const FillInput skin = cube_skin(4);
  EXPECT_NE(fill_skin(skin).tet_vertices, fill_skin(skin, {.point_order_seed = 1}).tet_vertices);
}

TEST(FillKernel, IsAPureFunctionWhateverWasFilledBefore)
{
  const FillInput cube = cube_skin(5);
  const FillInput sphere = sphere_skin(2);
  const FillOutput first = fill_skin(cube);
  (void)fill_skin(sphere, {.grading = 0.7, .optimize_steps = 1, .point_order_seed = 5});
  (void)fill_skin(cube_skin(3));
  const FillOutput again = fill_skin(cube);
  EXPECT_EQ(first.vertex_xyz, again.vertex_xyz);
  EXPECT_EQ(first.tet_vertices, again.tet_vertices);
}

TEST(FillKernel, FailureIsANetgenErrorAndLeavesNoTrace)
{
  const FillInput whole = cube_skin(3);
  const FillOutput before = fill_skin(whole);
  FillInput open = whole;
  open.triangle_vertices.resize(open.triangle_vertices.size() - 3);
  EXPECT_THROW((void)fill_skin(open), NetgenError);
  EXPECT_EQ(fill_skin(whole).vertex_xyz, before.vertex_xyz);
}

TEST(FillKernel, MeetsTheWantedSize)
{
  for (const FillInput& skin : {cube_skin(10), sphere_skin(3)}) {
    const double h = testing::mean_edge(skin);
    const std::vector<double> lengths = edge_lengths(fill_skin(skin, {.optimize_steps = 2}));
    EXPECT_NEAR(lengths[lengths.size() / 2], h, 0.1 * h);
    const auto long_edges =
        lengths.end() - std::lower_bound(lengths.begin(), lengths.end(), 1.6 * h);
    EXPECT_LE(static_cast<double>(long_edges), 0.02 * static_cast<double>(lengths.size()));
  }
}

TEST(FillKernel, NumberOfTetsDoesNotDependOnUnitOrPlace)
{
  const FillInput skin = cube_skin(6);
  FillInput moved = skin;
  for (std::vector<double>* xyz : {&moved.vertex_xyz, &moved.size_xyz}) {
    for (double& x : *xyz) x = 1000.0 * x - 300.0;
  }
  for (double& h : moved.size_h) h *= 1000.0;
  const auto count = static_cast<double>(fill_skin(skin).tet_vertices.size());
  EXPECT_NEAR(static_cast<double>(fill_skin(moved).tet_vertices.size()), count, 0.1 * count);
}

}  // namespace
}  // namespace tessera

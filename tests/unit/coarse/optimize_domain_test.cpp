// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/optimize_domain.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

using surface::DomainTets;

// A cube of 6 n^3 tets, pressed to this height; vertices inside are moved at random.
DomainTets pressed_cube(int n, double height)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(n);
  DomainTets tets{{cube.vertex_xyz.begin(), cube.vertex_xyz.end()},
                  {cube.tet_vertices.begin(), cube.tet_vertices.end()}};
  std::minstd_rand random(5);
  std::uniform_real_distribution<double> step(-0.25 / n, 0.25 / n);
  for (std::size_t v = 0; v < tets.vertex_xyz.size(); v += 3) {
    double* const p = &tets.vertex_xyz[v];
    const bool is_inside = std::all_of(p, p + 3, [](double x) { return x > 0.0 && x < 1.0; });
    for (std::size_t d = 0; d < 3; ++d) p[d] += is_inside ? step(random) : 0.0;
    p[2] *= height;
  }
  return tets;
}

struct Domain {
  surface::DomainSkin skin{};  // Of one patch.
  DomainTets tets{};
};

// The same tets, with the vertices of their skin first.
Domain domain_of(const DomainTets& tets)
{
  Domain domain;
  std::vector<LocalIndex> row(tets.vertex_xyz.size() / 3, kNoIndex);
  const auto row_of = [&](LocalIndex v) {
    if (row[at(v)] == kNoIndex) {
      row[at(v)] = static_cast<LocalIndex>(domain.tets.vertex_xyz.size() / 3);
      const Vec3 place = point_at(std::span<const double>(tets.vertex_xyz), v);
      domain.tets.vertex_xyz.insert(domain.tets.vertex_xyz.end(), place.begin(), place.end());
    }
    return row[at(v)];
  };
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tets.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    for (const LocalIndex v : triangle.vertices) {
      domain.skin.triangle_vertices.push_back(row_of(v));
    }
    domain.skin.triangle_patch.push_back(1);
  }
  domain.skin.vertex_xyz = domain.tets.vertex_xyz;
  domain.skin.vertex.resize(domain.skin.vertex_xyz.size() / 3);
  for (const LocalIndex v : tets.tet_vertices) domain.tets.tet_vertices.push_back(row_of(v));
  return domain;
}

std::array<Vec3, 4> corners_of(const DomainTets& tets, std::size_t t)
{
  const std::span<const double> xyz(tets.vertex_xyz);
  const LocalIndex* const v = &tets.tet_vertices[4 * t];
  return {point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]), point_at(xyz, v[3])};
}

struct Figures {
  double volume = 0.0;
  double worst = 1.0;  // Mean ratio.
  double mean = 0.0;
};

Figures figures_of(const DomainTets& tets)
{
  Figures figures;
  const std::size_t count = tets.tet_vertices.size() / 4;
  for (std::size_t t = 0; t < count; ++t) {
    const auto p = corners_of(tets, t);
    figures.volume += tet_volume(p[0], p[1], p[2], p[3]);
    figures.worst = std::min(figures.worst, quality::mean_ratio(p));
    figures.mean += quality::mean_ratio(p) / static_cast<double>(count);
  }
  return figures;
}

// Triangles of one tet, by their places.
std::multiset<std::set<Vec3>> skin_of(const DomainTets& tets)
{
  std::multiset<std::set<Vec3>> skin;
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tets.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    std::set<Vec3> places;
    for (const LocalIndex v : triangle.vertices) {
      places.insert(point_at(std::span<const double>(tets.vertex_xyz), v));
    }
    skin.insert(places);
  }
  return skin;
}

LocalIndex num_with_two_outer_faces(const DomainTets& tets)
{
  std::vector<int> num_outer(tets.tet_vertices.size() / 4, 0);
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tets.tet_vertices)) {
    if (triangle.tets[1] == kNoIndex) ++num_outer[at(triangle.tets[0])];
  }
  return static_cast<LocalIndex>(
      std::ranges::count_if(num_outer, [](int count) { return count > 1; }));
}

void expect_sound(const DomainTets& before, const DomainTets& after)
{
  EXPECT_EQ(skin_of(after), skin_of(before));
  EXPECT_NEAR(figures_of(after).volume, figures_of(before).volume, 1e-12);
  EXPECT_GE(figures_of(after).worst, figures_of(before).worst - 1e-12);
}

TEST(OptimizeDomain, MakesTetsBetterAndFewer)
{
  const auto& [skin, before] = domain_of(pressed_cube(5, 1.0));
  const DomainTets after = optimize_domain(skin, before);
  expect_sound(before, after);
  EXPECT_GT(figures_of(after).worst, figures_of(before).worst);
  EXPECT_GT(figures_of(after).mean, figures_of(before).mean);
  EXPECT_LT(after.tet_vertices.size(), before.tet_vertices.size());
  EXPECT_LT(after.vertex_xyz.size(), before.vertex_xyz.size());
}

// A thin plate: moves of the few vertices inside of it do not help.
TEST(OptimizeDomain, PutsVerticesIntoTheWorstTets)
{
  const Domain before = domain_of(pressed_cube(3, 0.15));
  const DomainTets after = optimize_domain(before.skin, before.tets);
  expect_sound(before.tets, after);
  EXPECT_GT(after.vertex_xyz.size(), before.tets.vertex_xyz.size());
  EXPECT_GT(figures_of(after).worst, figures_of(before.tets).worst);
}

// As if all sides were one smooth patch.
TEST(OptimizeDomain, LeavesNoTetWithTwoFacesOnOnePatch)
{
  Domain before = domain_of(pressed_cube(4, 1.0));
  ASSERT_GT(num_with_two_outer_faces(before.tets), 0);
  const DomainTets after = optimize_domain(before.skin, before.tets);
  expect_sound(before.tets, after);
  EXPECT_EQ(num_with_two_outer_faces(after), 0);
  std::iota(before.skin.triangle_patch.begin(), before.skin.triangle_patch.end(), 0);
  EXPECT_GT(num_with_two_outer_faces(optimize_domain(before.skin, before.tets)), 0);
}

TEST(OptimizeDomain, RefusesTetsThatAreInverted)
{
  Domain domain = domain_of(pressed_cube(2, 1.0));
  std::swap(domain.tets.tet_vertices[0], domain.tets.tet_vertices[1]);
  EXPECT_THROW((void)optimize_domain(domain.skin, domain.tets), MeshError);
}

}  // namespace
}  // namespace tessera::coarse

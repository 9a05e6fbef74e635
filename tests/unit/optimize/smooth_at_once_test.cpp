// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"
#include "tessera/optimize/smooth.hpp"

#include "sample_meshes.hpp"
#include "smoothed_meshes.hpp"

namespace tessera::optimize {
namespace {

using testing::bits_of;
using testing::figures_of;
using testing::Flags;
using testing::inner_flags;
using testing::jittered_cube;
using testing::MeshFigures;
using testing::num_moved;
using testing::positive_meshes;
using testing::squeezed;
using testing::subdivided_cube;
using testing::tangled_cube;

// What a vertex makes less: the sum of eta^-3 of its tets.
double energy_around(LocalIndex v, const std::vector<double>& xyz, const TetMesh& mesh)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.tet_vertices.size(); t += 4) {
    const std::vector<LocalIndex> tet(&mesh.tet_vertices[t], &mesh.tet_vertices[t] + 4);
    if (std::ranges::find(tet, v) == tet.end()) continue;
    sum += std::pow(figures_of(xyz, tet).least_mean_ratio, -3.0);
  }
  return sum;
}

// The tets around a vertex in their order, with vertices in another order.
struct Star {
  TetMesh mesh{};
  Flags flags{};  // 1: the vertex.
  LocalIndex vertex = kNoIndex;
};

Star star_of(LocalIndex v, const TetMesh& mesh)
{
  Star star;
  std::set<LocalIndex, std::greater<>> vertices;
  for (std::size_t t = 0; t < mesh.tet_vertices.size(); t += 4) {
    const std::span tet(&mesh.tet_vertices[t], 4);
    if (std::ranges::find(tet, v) == tet.end()) continue;
    star.mesh.tet_vertices.insert(star.mesh.tet_vertices.end(), tet.begin(), tet.end());
    vertices.insert(tet.begin(), tet.end());
  }
  const std::vector<LocalIndex> origin(vertices.begin(), vertices.end());
  const auto row = [&](LocalIndex vertex) {
    return static_cast<LocalIndex>(std::ranges::find(origin, vertex) - origin.begin());
  };
  for (LocalIndex& vertex : star.mesh.tet_vertices) vertex = row(vertex);
  for (const LocalIndex vertex : origin) {
    const Vec3 p = point_at(std::span(mesh.vertex_xyz), vertex);
    star.mesh.vertex_xyz.insert(star.mesh.vertex_xyz.end(), p.begin(), p.end());
  }
  star.vertex = row(v);
  star.flags.assign(origin.size(), 0);
  star.flags[at(star.vertex)] = 1;
  return star;
}

// A vertex of no tet, which changes the range of the coordinates alone.
void add_vertex(Star& star, const Vec3& position)
{
  star.mesh.vertex_xyz.insert(star.mesh.vertex_xyz.end(), position.begin(), position.end());
  star.flags.push_back(0);
}

// A tet over the xy plane. A needle at each of its corners pulls it across the others: the three in
// the plane by `length` along z, the apex the other way.
struct PulledTet {
  TetMesh mesh{};
  Flags corners{};  // 1: of the tet in the middle, which comes first.

  PulledTet(double height, double length)
  {
    constexpr double kRadius = 0.3;
    const double side = kRadius * std::sqrt(0.75);
    mesh.vertex_xyz = {kRadius, 0.0, 0.0, -0.5 * kRadius, side, 0.0, -0.5 * kRadius, -side,
                       0.0,     0.0, 0.0, height};
    mesh.tet_vertices = {0, 1, 2, 3};
    for (LocalIndex v = 0; v < 4; ++v) add_needle(v, v == 3 ? -length : length);
    corners.assign(mesh.vertex_xyz.size() / 3, 0);
    std::fill_n(corners.begin(), 4, 1);
  }

  [[nodiscard]] double volume(const std::vector<double>& xyz) const
  {
    return figures_of(xyz, {0, 1, 2, 3}).volume;
  }

 private:
  void add_needle(LocalIndex v, double length)
  {
    constexpr double kThin = 0.03;
    const Vec3 p = point_at(std::span(mesh.vertex_xyz), v);
    const auto first = static_cast<LocalIndex>(mesh.vertex_xyz.size() / 3);
    for (const Vec3& far : {Vec3{0, 0, length}, {kThin, 0, length}, {0, kThin, length}}) {
      const Vec3 at_far_end = p + far;
      mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), at_far_end.begin(), at_far_end.end());
    }
    const std::array tips{first, first + 1, first + 2};
    mesh.tet_vertices.push_back(v);
    mesh.tet_vertices.push_back(tips[0]);
    mesh.tet_vertices.push_back(tips[length > 0.0 ? 1 : 2]);
    mesh.tet_vertices.push_back(tips[length > 0.0 ? 2 : 1]);
  }
};

TEST(SmoothAtOnce, KeepsTetsPositiveWhenAllInnerVerticesMove)
{
  std::vector<TetMesh> meshes = positive_meshes();
  for (unsigned seed = 100; seed < 130; ++seed) meshes.push_back(jittered_cube(4, 1.0, seed));
  for (const TetMesh& mesh : meshes) {
    const Flags flags = inner_flags(mesh);
    const std::vector<double> moved = smooth_at_once(mesh, flags);
    EXPECT_GT(num_moved(mesh, flags, moved), 0);
    EXPECT_GT(figures_of(moved, mesh.tet_vertices).least_volume, 0.0);
  }
}

// Repeated steps bring tets near to being flat, if anything does.
TEST(SmoothAtOnce, KeepsTetsPositiveStepAfterStep)
{
  TetMesh mesh = squeezed(jittered_cube(5, 1.0, 31), 0.05);
  const Flags flags = inner_flags(mesh);
  for (int i = 0; i < 30; ++i) {
    mesh.vertex_xyz = smooth_at_once(mesh, flags);
    ASSERT_GT(figures_of(mesh.vertex_xyz, mesh.tet_vertices).least_volume, 0.0) << "step " << i;
  }
}

TEST(SmoothAtOnce, OnlyFlaggedVerticesMove)
{
  const TetMesh mesh = jittered_cube(5, 0.8, 32);
  Flags flags = inner_flags(mesh);
  for (std::size_t v = 0; v < flags.size(); v += 2) flags[v] = 0;
  const std::vector<double> moved = smooth_at_once(mesh, flags);
  EXPECT_GT(num_moved(mesh, flags, moved), 20);
  EXPECT_EQ(smooth_at_once(mesh, Flags(flags.size(), 0)), mesh.vertex_xyz);
  EXPECT_TRUE(smooth_at_once({}, {}).empty());
}

TEST(SmoothAtOnce, AVertexThatMovesAloneMakesItsTetsBetter)
{
  const TetMesh mesh = jittered_cube(4, 0.8, 33);
  const Flags inner = inner_flags(mesh);
  for (LocalIndex v = 0; v < static_cast<LocalIndex>(inner.size()); ++v) {
    if (inner[at(v)] == 0) continue;
    Flags flags(inner.size(), 0);
    flags[at(v)] = 1;
    const std::vector<double> moved = smooth_at_once(mesh, flags);
    EXPECT_EQ(num_moved(mesh, flags, moved), 1);
    EXPECT_LT(energy_around(v, moved, mesh), energy_around(v, mesh.vertex_xyz, mesh));
  }
}

TEST(SmoothAtOnce, MakesTheMeshBetter)
{
  const TetMesh mesh = subdivided_cube(3);
  const MeshFigures before = figures_of(mesh.vertex_xyz, mesh.tet_vertices);
  const std::vector<double> moved = smooth_at_once(mesh, inner_flags(mesh));
  EXPECT_GT(figures_of(moved, mesh.tet_vertices).mean_mean_ratio, before.mean_mean_ratio);
}

TEST(SmoothAtOnce, StepsDependOnTheTetsAroundTheVertexAlone)
{
  for (const TetMesh& mesh :
       {jittered_cube(4, 0.9, 34), subdivided_cube(2), tangled_cube(4, 0.5, 35),
        squeezed(jittered_cube(4, 0.9, 36), 1e-5)}) {
    const Flags flags = inner_flags(mesh);
    const std::vector<double> moved = smooth_at_once(mesh, flags);
    ASSERT_GT(num_moved(mesh, flags, moved), 0);
    for (LocalIndex v = 0; v < static_cast<LocalIndex>(flags.size()); ++v) {
      if (flags[at(v)] == 0) continue;
      Star star = star_of(v, mesh);
      EXPECT_EQ(bits_of(smooth_at_once(star.mesh, star.flags), star.vertex), bits_of(moved, v));
      add_vertex(star, {3e9, -7e17, 1.0});
      EXPECT_EQ(bits_of(smooth_at_once(star.mesh, star.flags), star.vertex), bits_of(moved, v))
          << "with other coordinates far away";
    }
  }
}

TEST(SmoothAtOnce, VerticesThatAreDrawnThroughEachOtherStopBefore)
{
  const PulledTet pulled(0.02, 0.8);
  ASSERT_GT(figures_of(pulled.mesh.vertex_xyz, pulled.mesh.tet_vertices).least_volume, 0.0);
  const std::vector<double> moved = smooth_at_once(pulled.mesh, pulled.corners);
  EXPECT_EQ(num_moved(pulled.mesh, pulled.corners, moved), 4);
  EXPECT_GT(figures_of(moved, pulled.mesh.tet_vertices).least_volume, 0.0);
  EXPECT_LT(pulled.volume(moved), 0.3 * pulled.volume(pulled.mesh.vertex_xyz))
      << "nothing has drawn them: nothing is tested";
}

// Each of them could make it positive.
TEST(SmoothAtOnce, VerticesOfAnInvertedTetStay)
{
  const PulledTet pulled(-0.02, -0.8);
  ASSERT_LT(pulled.volume(pulled.mesh.vertex_xyz), 0.0);
  EXPECT_EQ(smooth_at_once(pulled.mesh, pulled.corners), pulled.mesh.vertex_xyz);

  TetMesh needles = pulled.mesh;
  needles.tet_vertices.erase(needles.tet_vertices.begin(), needles.tet_vertices.begin() + 4);
  EXPECT_EQ(num_moved(needles, pulled.corners, smooth_at_once(needles, pulled.corners)), 4);
}

TEST(SmoothAtOnce, VerticesOffInvertedTetsMove)
{
  const TetMesh mesh = tangled_cube(5, 0.6, 37);
  Flags may_move = inner_flags(mesh);
  LocalIndex num_inverted = 0;
  for (std::size_t t = 0; t < mesh.tet_vertices.size(); t += 4) {
    const std::vector<LocalIndex> tet(&mesh.tet_vertices[t], &mesh.tet_vertices[t] + 4);
    if (figures_of(mesh.vertex_xyz, tet).least_volume > 0.0) continue;
    ++num_inverted;
    for (const LocalIndex v : tet) may_move[at(v)] = 0;
  }
  ASSERT_GT(num_inverted, 0);
  const std::vector<double> moved = smooth_at_once(mesh, inner_flags(mesh));
  EXPECT_GT(num_moved(mesh, may_move, moved), 0);
}

}  // namespace
}  // namespace tessera::optimize

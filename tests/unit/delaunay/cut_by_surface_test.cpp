// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/delaunay/cut_by_surface.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

#include "support/random_points.hpp"
#include "support/surfaces.hpp"

#include "delaunay/crossing.hpp"

namespace tessera::delaunay {
namespace {

constexpr LocalIndex kNoneInside = std::numeric_limits<LocalIndex>::max();

struct Sample {
  std::vector<double> xyz{};
  std::vector<LocalIndex> triangles{};

  void add_point(const Vec3& p) { xyz.insert(xyz.end(), p.begin(), p.end()); }
  [[nodiscard]] Vec3 place(LocalIndex v) const { return point_at(std::span(xyz), v); }
};

struct Cut {
  Sample sample{};
  Tetrahedralization tets{};
  SurfaceCut surface{};

  explicit Cut(Sample given)
      : sample(std::move(given)),
        tets(tetrahedralize(sample.xyz)),
        surface(cut_by_surface(sample.xyz, tets, sample.triangles, kNoneInside))
  {
  }

  [[nodiscard]] std::array<Vec3, 4> corners_of(LocalIndex t) const
  {
    const LocalIndex* v = &tets.tet_vertices[4 * at(t)];
    return {sample.place(v[0]), sample.place(v[1]), sample.place(v[2]), sample.place(v[3])};
  }
  [[nodiscard]] double volume_of(Side side) const
  {
    double sum = 0.0;
    for (LocalIndex t = 0; t < tets.num_tets(); ++t) {
      const auto [a, b, c, d] = corners_of(t);
      if (surface.tet_side[at(t)] == side) sum += tet_volume(a, b, c, d);
    }
    return sum;
  }
};

// The cube of n^3 cells with lattice points inside. Each square of its surface is divided along
// either diagonal, and its vertices are moved by at most `most` along each axis.
class CubeMaker {
 public:
  CubeMaker(int n, double most, unsigned seed) : n_(n), most_(most), random_(seed) {}

  Sample make()
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool is_high : {false, true}) add_side(axis, is_high);
    }
    for (int i = 1; i < 2 * n_; ++i) {
      for (int j = 1; j < 2 * n_; ++j) {
        for (int k = 1; k < 2 * n_; ++k) {
          if (i % 2 == j % 2 && j % 2 == k % 2) sample_.add_point({0.5 * i, 0.5 * j, 0.5 * k});
        }
      }
    }
    return sample_;
  }

 private:
  LocalIndex vertex_at(const std::array<int, 3>& place)
  {
    const auto next = static_cast<LocalIndex>(row_.size());
    const auto [entry, is_new] = row_.try_emplace(place, next);
    if (is_new) {
      Vec3 p{};
      for (std::size_t c = 0; c < 3; ++c) {
        const double share = static_cast<double>(random_()) / static_cast<double>(random_.max());
        p[c] = place[c] + most_ * (2.0 * share - 1.0);
      }
      sample_.add_point(p);
    }
    return entry->second;
  }

  void add_side(std::size_t axis, bool is_high)
  {
    for (int i = 0; i < n_; ++i) {
      for (int j = 0; j < n_; ++j) {
        const auto corner = [&](int u, int v) {
          std::array<int, 3> place{};
          place[axis] = is_high ? n_ : 0;
          place[(axis + 1) % 3] = u;
          place[(axis + 2) % 3] = v;
          return vertex_at(place);
        };
        const LocalIndex a = corner(i, j);
        LocalIndex b = corner(i + 1, j);
        const LocalIndex c = corner(i + 1, j + 1);
        LocalIndex d = corner(i, j + 1);
        if (!is_high) std::swap(b, d);
        const std::array<LocalIndex, 6> one{a, b, c, a, c, d};
        const std::array<LocalIndex, 6> other{a, b, d, b, c, d};
        const auto& taken = random_() % 2 == 0 ? one : other;
        sample_.triangles.insert(sample_.triangles.end(), taken.begin(), taken.end());
      }
    }
  }

  int n_;
  double most_;
  std::minstd_rand random_;
  std::map<std::array<int, 3>, LocalIndex> row_{};
  Sample sample_{};
};

// Corner c of tet t, and its opposite face seen from outside is the triangle.
void expect_triangle_at(const Cut& cut, std::size_t triangle, LocalIndex corner)
{
  const auto tet = at(corner) / 4;
  const auto c = at(corner) % 4;
  std::vector<LocalIndex> face;
  for (std::size_t other = 0; other < 4; ++other) {
    if (other != c) face.push_back(cut.tets.tet_vertices[4 * tet + other]);
  }
  const LocalIndex* given = &cut.sample.triangles[3 * triangle];
  EXPECT_TRUE(std::is_permutation(face.begin(), face.end(), given));
  EXPECT_GT(
      tet_volume(cut.sample.place(given[0]), cut.sample.place(given[2]), cut.sample.place(given[1]),
                 cut.sample.place(cut.tets.tet_vertices[4 * tet + c])),
      0.0);
}

void expect_triangles_are_found(const Cut& cut)
{
  const std::size_t num_triangles = cut.sample.triangles.size() / 3;
  ASSERT_EQ(cut.surface.triangle_corner.size(), num_triangles);
  for (std::size_t i = 0; i < num_triangles; ++i) {
    const LocalIndex corner = cut.surface.triangle_corner[i];
    if (corner != kNoIndex) expect_triangle_at(cut, i, corner);
  }
}

void expect_volume_between(const Cut& cut)
{
  constexpr double kRounding = 1e-9;
  const double volume = testing::volume_inside(cut.sample.xyz, cut.sample.triangles);
  const double inside = cut.volume_of(Side::inside);
  const double crossed = cut.volume_of(Side::crossed);
  ASSERT_EQ(cut.surface.tet_side.size(), cut.tets.tet_vertices.size() / 4);
  EXPECT_LE(inside, volume + kRounding);
  EXPECT_GE(inside + crossed, volume - kRounding);
  if (cut.surface.num_missing == 0) {
    EXPECT_NEAR(inside, volume, kRounding);
  }
}

TEST(CutBySurface, CubesDividedAnyhowHaveTheirVolume)
{
  LocalIndex num_missing = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const int n = 1 + static_cast<int>(seed % 4);
    const Cut cut(CubeMaker(n, seed % 2 == 0 ? 0.0 : 0.15, seed + 1).make());
    expect_volume_between(cut);
    expect_triangles_are_found(cut);
    num_missing += cut.surface.num_missing;
  }
  EXPECT_GT(num_missing, 100);  // Or else nothing was tried.
}

// The hull is the surface: all tets are inside.
TEST(CutBySurface, OneTetIsInside)
{
  Sample one;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    one.add_point(p);
  }
  one.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const Cut cut(one);
  EXPECT_EQ(cut.surface.tet_side, std::vector{Side::inside});
  EXPECT_EQ(cut.surface.num_missing, 0);
  expect_triangles_are_found(cut);
}

// Half an octahedron whose shortest diagonal is its axis: Delaunay tets lie around that one, and
// have no face in the square in the middle.
TEST(CutBySurface, AMissingFaceIsTold)
{
  Sample half;
  for (const Vec3& p : {Vec3{2, 0, 0}, Vec3{0, 2, 0}, Vec3{-2, 0, 0}, Vec3{0, -2, 0}, Vec3{0, 0, 1},
                        Vec3{0, 0, -1}}) {
    half.add_point(p);
  }
  half.triangles = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
  const Cut cut(half);
  EXPECT_EQ(cut.surface.num_missing, 2);
  EXPECT_EQ(std::ranges::count(cut.surface.triangle_corner, kNoIndex), 2);
  EXPECT_EQ(std::ranges::count(cut.surface.tet_side, Side::crossed), cut.tets.num_tets());
  expect_volume_between(cut);
}

// The same rows, another order: sides follow the tets, corners the triangles.
TEST(CutBySurface, OrderOfTrianglesDoesNotMatter)
{
  Sample sample = CubeMaker(3, 0.1, 5).make();
  const Cut cut(sample);
  std::vector<LocalIndex> turned;
  for (std::size_t i = sample.triangles.size(); i > 0; i -= 3) {
    const LocalIndex* v = &sample.triangles[i - 3];
    turned.insert(turned.end(), {v[1], v[2], v[0]});
  }
  sample.triangles = turned;
  const Cut other(sample);
  EXPECT_EQ(other.surface.tet_side, cut.surface.tet_side);
  std::vector<LocalIndex> corners = other.surface.triangle_corner;
  std::ranges::reverse(corners);
  EXPECT_EQ(corners, cut.surface.triangle_corner);
}

// The face opposite to corner i, of all tets; its normal points out of the tet.
std::array<LocalIndex, 3> face_at(const Tetrahedralization& tets, std::size_t i)
{
  constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const LocalIndex* v = &tets.tet_vertices[i / 4 * 4];
  const auto& [a, b, c] = kFaces[i % 4];
  return {v[a], v[b], v[c]};
}

void add_triangle(Sample& sample, const std::array<LocalIndex, 3>& triangle)
{
  sample.triangles.insert(sample.triangles.end(), triangle.begin(), triangle.end());
}

// Points at random, in their convex hull: no triangle is missing.
Sample hull_of_points()
{
  Sample sample{testing::points_in_cube(60), {}};
  const Tetrahedralization tets = tetrahedralize(sample.xyz);
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    if (tets.tet_neighbours[i] == kNoIndex) add_triangle(sample, face_at(tets, i));
  }
  return sample;
}

// A tet that has all neighbours.
LocalIndex inner_tet(const Cut& hull)
{
  const auto& all = hull.tets.tet_neighbours;
  for (LocalIndex t = 0; t < hull.tets.num_tets(); ++t) {
    if (std::count(&all[4 * at(t)], &all[4 * at(t)] + 4, kNoIndex) == 0) return t;
  }
  ADD_FAILURE() << "all tets are at the hull";
  return 0;
}

TEST(CutBySurface, AllIsInsideOfTheHull)
{
  const Cut cut(hull_of_points());
  EXPECT_EQ(cut.surface.num_missing, 0);
  EXPECT_EQ(std::ranges::count(cut.surface.tet_side, Side::inside), cut.tets.num_tets());
  expect_volume_between(cut);
  expect_triangles_are_found(cut);
}

void expect_one_outside(const Cut& cut, LocalIndex tet)
{
  EXPECT_EQ(std::ranges::count(cut.surface.tet_side, Side::outside), 1);
  EXPECT_EQ(cut.surface.tet_side[at(tet)], Side::outside);
  expect_volume_between(cut);
  expect_triangles_are_found(cut);
}

// The hull of all tets but one, which has a face on the hull: that tet is outside.
TEST(CutBySurface, ADentIsOutside)
{
  Sample sample = hull_of_points();
  const Cut hull(sample);
  const LocalIndex dent = hull.surface.triangle_corner[0] / 4;
  const LocalIndex corner = hull.surface.triangle_corner[0] % 4;
  const LocalIndex apex = hull.tets.tet_vertices[at(4 * dent + corner)];
  const std::array<LocalIndex, 3> v{sample.triangles[0], sample.triangles[1], sample.triangles[2]};
  sample.triangles.erase(sample.triangles.begin(), sample.triangles.begin() + 3);
  for (std::size_t c = 0; c < 3; ++c) add_triangle(sample, {v[c], v[(c + 1) % 3], apex});
  const Cut cut(sample);
  EXPECT_EQ(cut.surface.num_missing, 0);
  expect_one_outside(cut, dent);
}

// A large triangle from corner to corner of many tets.
TEST(CutBySurface, AllTetsThatAMissingTriangleGoesThroughAreFound)
{
  Sample sample = hull_of_points();
  for (const Vec3& p : {Vec3{-9, 0, 0}, Vec3{9, -9, 0}, Vec3{9, 9, 0}}) sample.add_point(p);
  const auto num_points = static_cast<LocalIndex>(sample.xyz.size() / 3);
  sample.triangles = {num_points - 3, num_points - 2, num_points - 1};
  const Cut cut(sample);
  ASSERT_EQ(cut.surface.num_missing, 1);
  const std::array<Vec3, 3> triangle{sample.place(num_points - 3), sample.place(num_points - 2),
                                     sample.place(num_points - 1)};
  for (LocalIndex t = 0; t < cut.tets.num_tets(); ++t) {
    EXPECT_EQ(cut.surface.tet_side[at(t)] == Side::crossed,
              is_crossed(cut.corners_of(t), triangle));
  }
}

// A tet inside whose faces look inwards, too.
TEST(CutBySurface, AHollowIsOutside)
{
  Sample sample = hull_of_points();
  const Cut hull(sample);
  const LocalIndex hollow = inner_tet(hull);
  for (std::size_t c = 0; c < 4; ++c) {
    const auto [u, v, w] = face_at(hull.tets, 4 * at(hollow) + c);
    add_triangle(sample, {u, w, v});
  }
  const Cut cut(sample);
  expect_one_outside(cut, hollow);
}

// The same whose faces look outwards.
TEST(CutBySurface, ASurfaceTwiceAroundAPlaceIsRefused)
{
  Sample sample = hull_of_points();
  const Cut hull(sample);
  const LocalIndex twice = inner_tet(hull);
  for (std::size_t c = 0; c < 4; ++c) {
    add_triangle(sample, face_at(hull.tets, 4 * at(twice) + c));
  }
  EXPECT_THROW((void)Cut(sample), MeshError);
}

// Tets hang together around a single triangle, so that they lie on both of its sides.
TEST(CutBySurface, ASurfaceThatIsOpenIsRefused)
{
  Sample sample = hull_of_points();
  const Cut hull(sample);
  add_triangle(sample, face_at(hull.tets, 4 * at(inner_tet(hull))));
  EXPECT_THROW((void)Cut(sample), MeshError);
}

TEST(CutBySurface, AHullWithoutATriangleIsRefused)
{
  Sample sample = hull_of_points();
  sample.triangles.resize(sample.triangles.size() - 3);
  EXPECT_THROW((void)Cut(sample), MeshError);
}

TEST(CutBySurface, ATriangleThatLooksTheWrongWayIsRefused)
{
  Sample sample = hull_of_points();
  std::swap(sample.triangles[0], sample.triangles[1]);
  EXPECT_THROW((void)Cut(sample), MeshError);
}

}  // namespace
}  // namespace tessera::delaunay

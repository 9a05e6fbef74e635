// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/lattice.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_lattice.hpp"

namespace tessera::mesh::lattice {
namespace {

TEST(TriangleLattice, IndicesAreDenseRowByRow)
{
  for (const LocalIndex n : {1, 2, 4, 8}) {
    LocalIndex all = 0;
    LocalIndex inner = 0;
    for (LocalIndex j = 0; j <= n; ++j) {
      for (LocalIndex i = 0; i + j <= n; ++i) {
        EXPECT_EQ(triangle_index(n, i, j), all++);
        if (i > 0 && j > 0 && i + j < n) {
          const auto [same_i, same_j] = inner_triangle_point(n, inner);
          EXPECT_EQ(std::pair(same_i, same_j), std::pair(i, j));
          EXPECT_EQ(inner_triangle_index(n, i, j), inner++);
        }
      }
    }
    EXPECT_EQ(all, num_triangle_points(n));
    EXPECT_EQ(inner, num_inner_triangle_points(n));
  }
}

TEST(TriangleLattice, SmallTrianglesCoverTheLargeOneWithItsOrientation)
{
  for (const LocalIndex n : {1, 2, 8}) {
    for (LocalIndex step = 1; step <= n; step *= 2) {
      LocalIndex count = 0;
      for_each_small_triangle(
          n, step, [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
            const auto area = (b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i);
            EXPECT_EQ(area, step * step);
            ++count;
          });
      EXPECT_EQ(count, (n / step) * (n / step));
    }
  }
}

// The same midpoint must be found from every side: the parents are symmetric and older.
TEST(TriangleLattice, ANewPointIsTheMiddleOfTwoOlderPoints)
{
  const LocalIndex n = 16;
  for (LocalIndex step = n / 2; step >= 1; step /= 2) {
    for (LocalIndex j = 0; j <= n; j += step) {
      for (LocalIndex i = 0; i + j <= n; i += step) {
        if ((i / step) % 2 == 0 && (j / step) % 2 == 0) continue;
        const auto [a, b] = parents({i, j}, step);
        EXPECT_EQ(a.i + b.i, 2 * i);
        EXPECT_EQ(a.j + b.j, 2 * j);
        for (const TrianglePoint& p : {a, b}) {
          EXPECT_EQ(p.i % (2 * step), 0);
          EXPECT_EQ(p.j % (2 * step), 0);
          EXPECT_TRUE(p.i >= 0 && p.j >= 0 && p.i + p.j <= n);
        }
      }
    }
  }
}

TEST(TetLattice, IndicesAreDenseLayerByLayer)
{
  for (const LocalIndex n : {1, 2, 4, 8}) {
    LocalIndex all = 0;
    for (LocalIndex k = 0; k <= n; ++k)
      for (LocalIndex j = 0; j + k <= n; ++j)
        for (LocalIndex i = 0; i + j + k <= n; ++i) EXPECT_EQ(tet_index(n, {i, j, k}), all++);
    EXPECT_EQ(all, num_tet_points(n));
  }
}

Vec3 position(const TetPoint& p)
{
  return {static_cast<double>(p.i), static_cast<double>(p.j), static_cast<double>(p.k)};
}

TEST(TetLattice, ChildrenArePositiveAndOfEqualVolumeForEveryDiagonal)
{
  for (std::size_t diagonal = 0; diagonal < 3; ++diagonal) {
    for (const LocalIndex n : {1, 2, 4, 8}) {
      LocalIndex count = 0;
      for_each_child(
          n, 1, diagonal,
          [&](const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d) {
            EXPECT_EQ(6.0 * tet_volume(position(a), position(b), position(c), position(d)), 1.0);
            ++count;
          });
      EXPECT_EQ(count, n * n * n);
    }
  }
}

// Property 3 of the design: the skin of the 8-way subdivision is the 4-way refined skin.
TEST(TetLattice, TheSkinOfTheChildrenIsTheRefinedSkin)
{
  const LocalIndex n = 4;
  for (std::size_t diagonal = 0; diagonal < 3; ++diagonal) {
    std::set<std::array<LocalIndex, 3>> open;
    const auto toggle = [&](const TetPoint& a, const TetPoint& b, const TetPoint& c) {
      std::array<LocalIndex, 3> key{tet_index(n, a), tet_index(n, b), tet_index(n, c)};
      std::sort(key.begin(), key.end());
      if (!open.insert(key).second) open.erase(key);
    };
    for_each_child(n, 1, diagonal,
                   [&](const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d) {
                     toggle(b, c, d);
                     toggle(a, c, d);
                     toggle(a, b, d);
                     toggle(a, b, c);
                   });
    std::set<std::array<LocalIndex, 3>> skin;
    for_each_small_triangle(
        n, 1, [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
          const auto add = [&](auto to_tet) {
            std::array<LocalIndex, 3> key{tet_index(n, to_tet(a)), tet_index(n, to_tet(b)),
                                          tet_index(n, to_tet(c))};
            std::sort(key.begin(), key.end());
            skin.insert(key);
          };
          add([](const TrianglePoint& p) { return TetPoint{p.i, p.j, 0}; });
          add([](const TrianglePoint& p) { return TetPoint{p.i, 0, p.j}; });
          add([](const TrianglePoint& p) { return TetPoint{0, p.i, p.j}; });
          add([&](const TrianglePoint& p) { return TetPoint{n - p.i - p.j, p.i, p.j}; });
        });
    EXPECT_EQ(open, skin) << "diagonal " << diagonal;
  }
}

TEST(TetLattice, IndexedChildrenAreTheSameInTheSameOrder)
{
  using Child = std::array<LocalIndex, 4>;
  for (const LocalIndex n : {1, 2, 4, 8}) {
    for (std::size_t diagonal = 0; diagonal < 3; ++diagonal) {
      std::vector<Child> by_points;
      for_each_child(
          n, 1, diagonal,
          [&](const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d) {
            by_points.push_back(
                {tet_index(n, a), tet_index(n, b), tet_index(n, c), tet_index(n, d)});
          });
      std::vector<Child> by_index;
      for_each_child_index(n, diagonal,
                           [&](LocalIndex a, LocalIndex b, LocalIndex c, LocalIndex d) {
                             by_index.push_back({a, b, c, d});
                           });
      EXPECT_EQ(by_index, by_points) << n << ' ' << diagonal;
      EXPECT_EQ(by_index.size(), at(n) * at(n) * at(n));
    }
  }
}

}  // namespace
}  // namespace tessera::mesh::lattice

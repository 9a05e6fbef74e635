// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/surface_simplices.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::number {
namespace {

using mesh::HostPoint;
using Edge = std::array<HostPoint, 2>;
using Triangle = std::array<HostPoint, 3>;

constexpr HostPoint kA{0, 0};
constexpr HostPoint kB{0, 1};
constexpr HostPoint kC{7, 0};
constexpr HostPoint kD{7, 5};

// The simplices of some triangles.
SurfaceSimplices simplices_of(std::vector<Triangle> triangles)
{
  SurfaceSimplices simplices;
  std::set<HostPoint> vertices;
  std::set<Edge> edges;
  for (Triangle& triangle : triangles) {
    std::ranges::sort(triangle);
    const auto& [a, b, c] = triangle;
    vertices.insert({a, b, c});
    edges.insert({Edge{a, b}, Edge{a, c}, Edge{b, c}});
  }
  std::ranges::sort(triangles);
  return {{vertices.begin(), vertices.end()}, {edges.begin(), edges.end()}, std::move(triangles)};
}

// Pieces that share vertices, edges and triangles at random; two of three are of material 1.
std::vector<SurfaceList> random_lists(unsigned seed)
{
  constexpr LocalIndex kNumPieces = 6;
  constexpr unsigned kNumNames = 7;  // Few, so that much is shared.
  std::mt19937 random(seed);
  std::vector<SurfaceList> lists;
  for (LocalIndex s = 0; s < kNumPieces; ++s) {
    std::set<Triangle> triangles;
    for (int i = 0; i < 9; ++i) {
      std::set<HostPoint> corners;
      while (corners.size() < 3) {
        corners.insert({static_cast<LocalIndex>(random() % kNumNames), 3});
      }
      Triangle triangle;
      std::ranges::copy(corners, triangle.begin());
      triangles.insert(triangle);
    }
    lists.push_back({.subdomain = 10 + 3 * s,
                     .material = s % 3 == 2 ? 2 : 1,
                     .simplices = simplices_of({triangles.begin(), triangles.end()})});
  }
  return lists;
}

std::vector<SharedSurface> compare_all(const std::vector<SurfaceList>& lists)
{
  std::vector<SharedSurface> shared;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    std::vector<SurfaceList> others = lists;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    shared.push_back(compare_surfaces(lists[i], others));
  }
  return shared;
}

// The lowest piece that has each simplex, and of how many pieces of each material it is.
template <class Key>
struct Holders {
  std::map<Key, LocalIndex> lowest{};
  std::map<Key, std::map<LocalIndex, int>> of_material{};

  Holders(const std::vector<SurfaceList>& lists, std::vector<Key> SurfaceSimplices::*kind)
  {
    for (const SurfaceList& list : lists) {
      for (const Key& key : list.simplices.*kind) {
        lowest.try_emplace(key, list.subdomain);  // Lists ascend by subdomain.
        ++of_material[key][list.material];
      }
    }
  }

  [[nodiscard]] bool is_on_seam(const Key& key) const
  {
    return std::ranges::any_of(of_material.at(key), [](const auto& one) { return one.second > 1; });
  }
};

template <class Key>
void expect_compared(const std::vector<SurfaceList>& lists,
                     std::vector<Key> SurfaceSimplices::*kind,
                     std::vector<char> SharedSurface::*on_seam)
{
  const Holders<Key> holders(lists, kind);
  const std::vector<SharedSurface> shared = compare_all(lists);
  std::size_t num_owned = 0;
  int num_on_seam = 0;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    std::vector<Key> owned;
    const std::vector<Key>& keys = lists[i].simplices.*kind;
    ASSERT_EQ((shared[i].*on_seam).size(), keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (holders.lowest.at(keys[k]) == lists[i].subdomain) owned.push_back(keys[k]);
      EXPECT_EQ((shared[i].*on_seam)[k] != 0, holders.is_on_seam(keys[k]));
      num_on_seam += (shared[i].*on_seam)[k];
    }
    EXPECT_EQ(shared[i].owned.*kind, owned);
    num_owned += owned.size();
  }
  EXPECT_EQ(num_owned, holders.lowest.size()) << "every simplex has one owner";
  EXPECT_GT(num_on_seam, 0);
}

TEST(CompareSurfaces, TheLowestPieceOwnsAndSeamsAreOfOneMaterial)
{
  for (const unsigned seed : {1U, 2U, 3U}) {
    const std::vector<SurfaceList> lists = random_lists(seed);
    expect_compared(lists, &SurfaceSimplices::vertices, &SharedSurface::vertex_on_seam);
    expect_compared(lists, &SurfaceSimplices::edges, &SharedSurface::edge_on_seam);
    expect_compared(lists, &SurfaceSimplices::triangles, &SharedSurface::triangle_on_seam);
  }
}

// The vertices of an edge may be shared by pieces that do not share the edge.
TEST(CompareSurfaces, AnEdgeIsNotItsVertices)
{
  const SurfaceList own{.subdomain = 4, .material = 1, .simplices = simplices_of({{kA, kB, kC}})};
  const SurfaceList other{
      .subdomain = 2,
      .material = 1,
      .simplices = {.vertices = {kA, kB, kC, kD}, .edges = {{kA, kC}}, .triangles = {}}};
  const SharedSurface shared = compare_surfaces(own, {{other}});
  EXPECT_TRUE(shared.owned.vertices.empty());
  EXPECT_EQ(shared.owned.edges, (std::vector<Edge>{{kA, kB}, {kB, kC}}));
  EXPECT_EQ(shared.owned.triangles, (std::vector<Triangle>{{kA, kB, kC}}));
  EXPECT_EQ(shared.vertex_on_seam, (std::vector<char>{1, 1, 1}));
  EXPECT_EQ(shared.edge_on_seam, (std::vector<char>{0, 1, 0}));
  EXPECT_EQ(shared.triangle_on_seam, (std::vector<char>{0}));
}

TEST(CompareSurfaces, APieceWithoutNeighboursOwnsAll)
{
  const SurfaceList own{
      .subdomain = 4, .material = 1, .simplices = simplices_of({{kA, kB, kC}, {kA, kB, kD}})};
  const SharedSurface shared = compare_surfaces(own, {});
  EXPECT_EQ(shared.owned.vertices, own.simplices.vertices);
  EXPECT_EQ(shared.owned.edges, own.simplices.edges);
  EXPECT_EQ(shared.owned.triangles, own.simplices.triangles);
  EXPECT_EQ(shared.edge_on_seam, std::vector<char>(5, 0));
}

// Euler's formula for a closed surface: the points of n intervals an edge are 2 + n^2 F / 2.
TEST(SurfaceSimplices, NumPointsIsAClosedForm)
{
  const SurfaceSimplices tet =
      simplices_of({{kA, kB, kC}, {kA, kB, kD}, {kA, kC, kD}, {kB, kC, kD}});
  for (const LocalIndex n : {1, 2, 3, 4, 8, 256}) {
    EXPECT_EQ(tet.num_points(n), 2 + GlobalIndex{n} * n * 4 / 2) << n;
  }
  EXPECT_EQ(SurfaceSimplices{}.num_points(4), 0);
}

TEST(SurfaceSimplices, NumPointsMayBeBeyond32Bits)
{
  SurfaceSimplices many;
  many.triangles.resize(1 << 13);
  EXPECT_EQ(many.num_points(1024), GlobalIndex{1 << 13} * 1023 * 1022 / 2);
}

// Notes the points of every simplex of all pieces: who has the same simplex must say the same, and
// no two simplices may have a point in common.
struct PlacedPoints {
  std::map<std::vector<HostPoint>, SimplexPlace> places{};
  std::map<LocalIndex, std::vector<LocalIndex>> points_of_owner{};

  template <class Key>
  void add(const std::vector<Key>& keys, const std::vector<SimplexPlace>& of_keys,
           LocalIndex points)
  {
    ASSERT_EQ(keys.size(), of_keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k) add_one(name_of(keys[k]), of_keys[k], points);
  }

  static std::vector<HostPoint> name_of(const HostPoint& vertex) { return {vertex}; }
  template <std::size_t N>
  static std::vector<HostPoint> name_of(const std::array<HostPoint, N>& names)
  {
    return {names.begin(), names.end()};
  }

 private:
  void add_one(std::vector<HostPoint> name, const SimplexPlace& place, LocalIndex num_points)
  {
    const auto [known, is_new] = places.try_emplace(std::move(name), place);
    EXPECT_EQ(known->second, place);
    if (!is_new) return;
    for (LocalIndex i = 0; i < num_points; ++i) {
      points_of_owner[place.owner].push_back(place.first + i);
    }
  }
};

std::vector<OwnedSurface> owners_up_to(std::size_t piece, const std::vector<SurfaceList>& lists,
                                       const std::vector<SharedSurface>& shared)
{
  std::vector<OwnedSurface> owners{{lists[piece].subdomain, shared[piece].owned}};
  for (std::size_t i = 0; i < piece; ++i) owners.push_back({lists[i].subdomain, shared[i].owned});
  return owners;
}

TEST(PlaceSurface, PlacesAreDenseAndTheSameForAllWhoShareThem)
{
  for (const LocalIndex n : {1, 2, 4}) {
    const std::vector<SurfaceList> lists = random_lists(4);
    const std::vector<SharedSurface> shared = compare_all(lists);
    PlacedPoints placed;
    for (std::size_t i = 0; i < lists.size(); ++i) {
      const SurfaceSimplices& own = lists[i].simplices;
      const SurfacePlaces places = place_surface(own, owners_up_to(i, lists, shared), n);
      placed.add(own.vertices, places.vertices, 1);
      placed.add(own.edges, places.edges, n - 1);
      placed.add(own.triangles, places.triangles, (n - 1) * (n - 2) / 2);
    }
    ASSERT_FALSE(placed.points_of_owner.empty());
    for (std::size_t i = 0; i < lists.size(); ++i) {
      std::vector<LocalIndex>& points = placed.points_of_owner[lists[i].subdomain];
      std::ranges::sort(points);
      std::vector<LocalIndex> dense(static_cast<std::size_t>(shared[i].owned.num_points(n)));
      for (std::size_t k = 0; k < dense.size(); ++k) dense[k] = static_cast<LocalIndex>(k);
      EXPECT_EQ(points, dense) << "piece " << lists[i].subdomain << ", n = " << n;
    }
  }
}

TEST(PlaceSurface, OwnersAreTheLowestPieces)
{
  const std::vector<SurfaceList> lists = random_lists(5);
  const std::vector<SharedSurface> shared = compare_all(lists);
  const Holders<Edge> holders(lists, &SurfaceSimplices::edges);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const SurfaceSimplices& own = lists[i].simplices;
    const SurfacePlaces places = place_surface(own, owners_up_to(i, lists, shared), 2);
    for (std::size_t k = 0; k < own.edges.size(); ++k) {
      EXPECT_EQ(places.edges[k].owner, holders.lowest.at(own.edges[k]));
    }
  }
}

TEST(PlaceSurface, NamesWhatNobodyOwns)
{
  const SurfaceSimplices own = simplices_of({{kA, kB, kC}});
  const auto refusal_of = [&](auto&& lose) {
    OwnedSurface owner{.subdomain = 1, .simplices = own};
    lose(owner.simplices);
    try {
      static_cast<void>(place_surface(own, {{owner}}, 4));
    } catch (const MeshError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal_of([](SurfaceSimplices&) {}), "");
  EXPECT_EQ(refusal_of([](SurfaceSimplices& owned) { owned.vertices.pop_back(); }),
            "nobody owns vertex 2 of a piece's surface");
  EXPECT_EQ(refusal_of([](SurfaceSimplices& owned) { owned.edges.erase(owned.edges.begin() + 1); }),
            "nobody owns edge 1 of a piece's surface");
  EXPECT_EQ(refusal_of([](SurfaceSimplices& owned) { owned.triangles.clear(); }),
            "nobody owns triangle 0 of a piece's surface");
}

}  // namespace
}  // namespace tessera::number

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/layers/find_wakes.hpp"
#include "tessera/layers/grow_layers.hpp"
#include "tessera/mesh/face_tets.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/subdomain/count_pieces.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/piece_arrays.hpp"
#include "tessera/topology/periodic_sides.hpp"
#include "tessera/topology/split_patches.hpp"

#include "support/decompositions.hpp"
#include "support/filled_cube.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/wedge_cube.hpp"

namespace tessera::subdomain {
namespace {

constexpr std::size_t kBetween = 6;  // The patch between the materials.

struct Wall {
  std::size_t patch = 0;
  int count = 3;
  std::string side{};
};

using Triangle = std::array<GlobalIndex, 3>;

Triangle key_of(const mesh::MeshArrays& cells, const std::array<LocalIndex, 3>& points)
{
  Triangle key{};
  for (std::size_t c = 0; c < 3; ++c) key[c] = cells.point_ids[at(points[c])];
  std::ranges::sort(key);
  return key;
}

// All pieces as one mesh, by ids.
struct WholeMesh {
  std::map<Triangle, int> sides{};  // How many tets have each triangle.
  std::map<Triangle, int> boundary{};
  std::map<GlobalIndex, Vec3> places{};
  std::map<GlobalIndex, int> cells{};

  void add(const PieceArrays& piece)
  {
    const mesh::MeshArrays& tets = piece.tets;
    for (std::size_t p = 0; p < tets.point_ids.size(); ++p) {
      const Vec3 place = point_at(std::span(tets.point_xyz), p);
      EXPECT_EQ(places.emplace(tets.point_ids[p], place).first->second, place);
    }
    for (std::size_t t = 0; t < tets.cell_ids.size(); ++t) {
      ++cells[tets.cell_ids[t]];
      const LocalIndex* v = &tets.cell_points[4 * t];
      for (const auto& [a, b, c] : mesh::kTetFaceCorners) ++sides[key_of(tets, {v[a], v[b], v[c]})];
    }
    for (std::size_t t = 0; t < piece.boundary.cell_ids.size(); ++t) {
      const LocalIndex* v = &piece.boundary.cell_points[3 * t];
      ++boundary[key_of(piece.boundary, {v[0], v[1], v[2]})];
    }
  }
};

void add_layers(const std::vector<Wall>& walls, mesh::CoarseMesh& cube)
{
  std::vector<layers::LayerOptions> options;
  topology::SplitOptions openings;
  for (const auto& [patch, count, side] : walls) {
    const std::string& name = cube.patch_names[patch];
    options.push_back({.patch = name, .side = side, .first = 0.02, .count = count});
    if (!side.empty()) openings.joints.push_back({.patch = name, .solid = side});
  }
  if (!openings.are_none()) topology::split_patches(cube, openings);
  (void)layers::grow_layers(cube, options, testing::FlatModel(), true);
  topology::close_joints(cube);
}

// A mesh in several subdomains.
class LayeredBody {
 public:
  explicit LayeredBody(mesh::CoarseMesh coarse)
      : LayeredBody(std::move(coarse),
                    [](const mesh::CoarseMesh& mesh) { return testing::slabs(mesh, 2); })
  {
  }

  template <class Decompose>
  LayeredBody(mesh::CoarseMesh coarse, const Decompose& decompose)
      : coarse_(std::move(coarse)), body_(coarse_, decompose(coarse_))
  {
  }

  [[nodiscard]] const testing::Body& body() const { return body_; }

  [[nodiscard]] FilledPiece filled(int levels, LocalIndex subdomain) const
  {
    return testing::fill_of(body_, levels, subdomain, {.kernel = fill::KernelKind::subdivide});
  }

  [[nodiscard]] WholeMesh whole_mesh(int levels) const
  {
    const auto tables =
        layer_tables(body_.coarse, body_.skeleton, mesh::lattice_levels(body_.skeleton, levels));
    const PartitionedMesh cut(body_.coarse, body_.decomposition, levels);
    const auto ids = number::IdLayout::by_host(mesh::HostLayout(body_.skeleton),
                                               mesh::lattice_levels(body_.skeleton, levels),
                                               count_subdivided_pieces(cut, levels));
    const std::string unit;
    const WriteContext mesh{.coarse = body_.coarse,
                            .skeleton = body_.skeleton,
                            .ids = ids,
                            .length_unit = unit,
                            .layers = &*tables};
    WholeMesh whole;
    for (LocalIndex s = 0; s < body_.num_subdomains(); ++s) {
      whole.add(piece_arrays(filled(levels, s).piece, mesh, false));
    }
    return whole;
  }

 private:
  mesh::CoarseMesh coarse_;
  testing::Body body_;
};

class LayeredCube : public ::testing::TestWithParam<std::vector<Wall>> {
 protected:
  static mesh::CoarseMesh with_layers()
  {
    mesh::CoarseMesh cube = testing::two_material_cube(4);
    add_layers(GetParam(), cube);
    return cube;
  }

  LayeredBody layered_{with_layers()};
};

// Every triangle has two tets, or is one of the boundary; every point has one place; ids are dense.
void expect_one_mesh(const WholeMesh& whole)
{
  EXPECT_EQ(whole.places.rbegin()->first + 1, static_cast<GlobalIndex>(whole.places.size()));
  EXPECT_EQ(whole.cells.rbegin()->first + 1, static_cast<GlobalIndex>(whole.cells.size()));
  for (const auto& [triangle, count] : whole.sides) {
    EXPECT_TRUE(count == 2 || whole.boundary.contains(triangle));
    EXPECT_LE(count, 2);
  }
  for (const auto& [triangle, count] : whole.boundary) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(whole.sides.contains(triangle));
  }
}

void expect_closed_forms(const LayeredBody& layered, int levels, double expected_volume)
{
  const testing::Body& body = layered.body();
  const PartitionedMesh cut(body.coarse, body.decomposition, levels);
  const auto counts = count_subdivided_pieces(cut, levels);
  double volume = 0.0;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    const PieceSummary summary = layered.filled(levels, s).result.summary;
    EXPECT_FALSE(summary.is_folded);
    EXPECT_EQ(counts_of(summary).tets, counts[at(s)].tets);
    EXPECT_EQ(counts_of(summary).boundary_triangles, counts[at(s)].boundary_triangles);
    volume += summary.whole_volume();
  }
  EXPECT_NEAR(volume, expected_volume, 1e-12);
}

TEST_P(LayeredCube, HoldsWhatTheClosedFormsSay)
{
  for (const int levels : {0, 1, 2}) expect_closed_forms(layered_, levels, 1.0);
}

TEST_P(LayeredCube, IsOneMesh) { expect_one_mesh(layered_.whole_mesh(1)); }

// Where all edges have one level, a split makes the lattice of more levels.
TEST_P(LayeredCube, HasAsManyLayersIfItIsSplit)
{
  const testing::Body& body = layered_.body();
  const auto tables_of = [&](int levels, int splits) {
    return LayerTables(body.coarse, body.skeleton, mesh::lattice_levels(body.skeleton, levels),
                       splits);
  };
  const LayerTables fine = tables_of(3, 0);
  for (const int splits : {1, 2, 3}) {
    const LayerTables split = tables_of(3 - splits, splits);
    EXPECT_EQ(split.num_points(), fine.num_points());
    for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
      EXPECT_EQ(split.counts(s), fine.counts(s));
    }
  }
}

// At a joint there are as many triangles between the materials as without layers.
TEST_P(LayeredCube, IsClosedBetweenMaterials)
{
  if (std::ranges::all_of(GetParam(), [](const Wall& wall) { return wall.side.empty(); })) return;
  const WholeMesh whole = layered_.whole_mesh(1);
  const auto is_between = [&](const auto& one) { return whole.sides.at(one.first) == 2; };
  EXPECT_EQ(std::ranges::count_if(whole.boundary, is_between), 4 * (2 * 4 * 4));
}

// One side; two opposite ones, of which one ends at the face between the materials; all but one;
// three that meet, of which each has another number of layers. Then one side between the materials,
// the other one, both, and one beside walls on the outside.
INSTANTIATE_TEST_SUITE_P(
    Patches, LayeredCube,
    ::testing::Values(std::vector<Wall>{{0}}, std::vector<Wall>{{2}, {3}},
                      std::vector<Wall>{{0}, {1}, {2}, {3}, {4}},
                      std::vector<Wall>{{0, 1}, {2, 4}, {4, 2}},
                      std::vector<Wall>{{kBetween, 3, "1"}}, std::vector<Wall>{{kBetween, 2, "2"}},
                      std::vector<Wall>{{kBetween, 3, "1"}, {kBetween, 2, "2"}},
                      std::vector<Wall>{{kBetween, 3, "2"}, {2, 4}, {0, 2}}));

// The sides of each material along y are patches of their own: "low_1" and so on.
mesh::CoarseMesh cube_with_sides()
{
  mesh::CoarseMesh cube = testing::two_material_cube(4);
  const auto faces = mesh::tets_of_faces(cube);
  std::map<std::string, LocalIndex> rows;
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    const LocalIndex* v = &cube.face_vertices[3 * at(f)];
    for (const double y : {0.0, 1.0}) {
      const auto is_there = [&](LocalIndex corner) { return cube.position(corner)[1] == y; };
      if (!std::all_of(v, v + 3, is_there)) continue;
      const std::string of_material = (y == 0.0 ? "low_" : "high_")
                                      + std::to_string(cube.tet_material[at(faces[at(f)].tets[0])]);
      const auto [row, is_new] = rows.emplace(of_material, cube.num_patches());
      if (is_new) {
        cube.patch_names.push_back(of_material);
        cube.patch_surface.push_back(LocalIndex{cube.patch_surface[at(cube.face_patch[at(f)])]});
      }
      cube.face_patch[at(f)] = row->second;
    }
  }
  return cube;
}

// Each material is periodic by an entry of its own, which may lead the other way, or only one is.
TEST(JointsAtPeriodicSides, AreOneMesh)
{
  using Sides = std::vector<topology::PeriodicSide>;
  const topology::PeriodicSide first{.from = "low_1", .to = "high_1"};
  const topology::PeriodicSide second{.from = "low_2", .to = "high_2"};
  const topology::PeriodicSide back{.from = "high_2", .to = "low_2"};
  for (const Sides& sides :
       {Sides{first, second}, Sides{first, back}, Sides{first}, Sides{second}}) {
    for (const std::vector<Wall>& walls :
         {std::vector<Wall>{{kBetween, 3, "1"}}, std::vector<Wall>{{kBetween, 2, "2"}},
          std::vector<Wall>{{kBetween, 3, "1"}, {kBetween, 2, "2"}}}) {
      SCOPED_TRACE(sides.back().from + " of " + std::to_string(sides.size()) + ", "
                   + walls.front().side + " of " + std::to_string(walls.size()));
      mesh::CoarseMesh cube = cube_with_sides();
      topology::join_periodic_sides(cube, sides);
      add_layers(walls, cube);
      expect_one_mesh(LayeredBody(std::move(cube)).whole_mesh(2));
    }
  }
}

constexpr double kThickness = 0.1;

// Layers go around the sharp edge of a wedge and on in front of it.
mesh::CoarseMesh wedge_with_layers(mesh::CoarseMesh cube, const std::vector<Wall>& walls)
{
  std::vector<layers::LayerOptions> options;
  for (const auto& [patch, count, side] : walls) {
    options.push_back({.patch = cube.patch_names[patch], .first = 0.02, .count = count});
  }
  topology::open_wakes(cube, layers::find_wakes(cube, options, false));
  (void)layers::grow_layers(cube, options, testing::FlatModel(), false);
  topology::close_joints(cube);
  return cube;
}

// Subdomains meet along the wake, or across it alone.
class LayeredWedge : public ::testing::TestWithParam<std::vector<Wall>> {
 protected:
  const double volume_ = 1.0 - 0.25 * kThickness;
  const LayeredBody in_slabs_{wedge_with_layers(testing::wedge_cube(kThickness), GetParam())};
  const LayeredBody in_octants_{wedge_with_layers(testing::wedge_cube(kThickness), GetParam()),
                                testing::octants};
};

TEST_P(LayeredWedge, HoldsWhatTheClosedFormsSay)
{
  for (const LayeredBody* layered : {&in_slabs_, &in_octants_}) {
    const mesh::CoarseMesh& coarse = layered->body().coarse;
    EXPECT_TRUE(std::ranges::any_of(coarse.face_patch,
                                    [&](LocalIndex patch) { return coarse.is_wake(patch); }));
    for (const int levels : {0, 1, 2}) expect_closed_forms(*layered, levels, volume_);
  }
}

TEST_P(LayeredWedge, IsOneMesh)
{
  for (const LayeredBody* layered : {&in_slabs_, &in_octants_}) {
    for (const int levels : {0, 1, 2}) {
      const WholeMesh whole = layered->whole_mesh(levels);
      expect_one_mesh(whole);
      for (const auto& [triangle, count] : whole.boundary) EXPECT_EQ(whole.sides.at(triangle), 1);
    }
  }
}

// Both of its sides; with different numbers of layers; with a wall where its edge ends.
INSTANTIATE_TEST_SUITE_P(Walls, LayeredWedge,
                         ::testing::Values(std::vector<Wall>{{6}, {7}},
                                           std::vector<Wall>{{6, 1}, {7, 4}},
                                           std::vector<Wall>{{6}, {7}, {2}}));

TEST(WedgeAtPeriodicSides, IsOneMesh)
{
  for (const bool leads_back : {false, true}) {
    mesh::CoarseMesh cube = testing::wedge_cube(kThickness);
    topology::PeriodicSide sides{.from = "y0", .to = "y1"};
    if (leads_back) std::swap(sides.from, sides.to);
    topology::join_periodic_sides(cube, std::vector{sides});
    cube = wedge_with_layers(std::move(cube), {{6}, {7}});
    std::array<int, 2> num_at_sides{};
    for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
      if (!cube.is_wake(cube.face_patch[at(f)])) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 wall = cube.layers.wall(cube.face_vertices[3 * at(f) + c]);
        num_at_sides[0] += wall[0] == 0.5 && wall[1] == 0.0 ? 1 : 0;
        num_at_sides[1] += wall[0] == 0.5 && wall[1] == 1.0 ? 1 : 0;
      }
    }
    EXPECT_GT(num_at_sides[0], 0);
    EXPECT_GT(num_at_sides[1], 0);
    const LayeredBody in_slabs(cube);
    const LayeredBody in_octants(cube, testing::octants);
    for (const LayeredBody* layered : {&in_slabs, &in_octants}) {
      for (const int levels : {0, 1, 2}) {
        expect_closed_forms(*layered, levels, 1.0 - 0.25 * kThickness);
        expect_one_mesh(layered->whole_mesh(levels));
      }
    }
  }
}

}  // namespace
}  // namespace tessera::subdomain

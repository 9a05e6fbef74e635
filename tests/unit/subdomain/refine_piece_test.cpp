// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/refine_piece.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/piece_surface.hpp"
#include "tessera/verify/seams.hpp"

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"
#include "support/surfaces.hpp"

#include "split_pieces.hpp"

namespace tessera::subdomain {
namespace {

using fill::KernelKind;
using testing::Body;
using testing::SplitPiece;
using testing::SplitTask;

// A body with its model.
struct Sample {
  std::string name{};
  Body body;
  std::unique_ptr<model::Model> model{};
};

Sample sample_of(const std::string& name)
{
  using testing::FlatModel;
  using testing::SphereModel;
  const auto made = [&](const mesh::CoarseMesh& coarse, const mesh::Decomposition& cut,
                        auto model) {
    return Sample{name, Body(coarse, cut), std::make_unique<decltype(model)>(std::move(model))};
  };
  if (name == "TwoMaterials") {
    const mesh::CoarseMesh cube = testing::two_material_cube(2);
    return made(cube, testing::slabs(cube, 2), FlatModel());
  }
  if (name == "Octants") {
    const mesh::CoarseMesh cube = testing::kuhn_cube(2);
    return made(cube, testing::octants(cube), FlatModel());
  }
  if (name == "OctantsOfTwoMaterials") {
    const mesh::CoarseMesh cube = testing::two_material_cube(2);
    return made(cube, testing::octants(cube), FlatModel());
  }
  if (name == "Ball") {
    const mesh::CoarseMesh ball = testing::ball(2);
    return made(ball, testing::halves(ball), SphereModel({1.0}));
  }
  if (name == "Shell") {
    const mesh::CoarseMesh shell = testing::shell();
    return made(shell, testing::halves(shell), SphereModel({1.0, 0.5}));
  }
  const mesh::CoarseMesh cylinder = testing::cylinder(2);
  return made(cylinder, testing::halves(cylinder), testing::CylinderModel());
}

struct Way {
  std::string sample{};
  SplitTask task{};
  bool exchanges_tets = false;
};

std::string name_of(const Way& way)
{
  return way.sample + "From" + std::to_string(way.task.from.largest()) + "To"
         + std::to_string(way.task.to.largest()) + "Kernel"
         + std::to_string(static_cast<int>(way.task.kernel))
         + (way.exchanges_tets ? "Exchanged" : "");
}

void PrintTo(const Way& way, std::ostream* out) { *out << name_of(way); }

// Made once for all tests that look at the same.
struct Case {
  Sample sample;
  std::vector<FilledPiece> filled{};
  std::vector<SplitPiece> split{};
  std::vector<mesh::Piece> pieces{};

  explicit Case(const Way& way) : sample(sample_of(way.sample))
  {
    filled = testing::fill_all(sample.body, *sample.model, way.task.from, way.task.kernel);
    if (way.exchanges_tets) {
      EXPECT_GT(testing::improve_all(sample.body, filled), 0) << "nothing was exchanged";
    }
    split = testing::split_all(sample.body, *sample.model, way.task, filled);
    pieces = testing::pieces_of(split);
  }
};

// A pointer: GCC 14 takes a reference for a part of what is given.
const Case* case_of(const Way& way)
{
  static std::vector<std::pair<std::string, std::unique_ptr<Case>>> made;
  const auto known = std::ranges::find(made, name_of(way), &decltype(made)::value_type::first);
  if (known != made.end()) return known->second.get();
  return made.emplace_back(name_of(way), std::make_unique<Case>(way)).second.get();
}

using Bits = std::array<std::uint64_t, 3>;

// A triangle on the geometry, by its patch and the bits of its positions.
using PatchTriangle = std::tuple<LocalIndex, std::array<Bits, 3>>;

PatchTriangle patch_triangle(LocalIndex patch, const std::vector<double>& xyz, const LocalIndex* v)
{
  std::array<Bits, 3> corners;
  for (std::size_t c = 0; c < 3; ++c) corners[c] = testing::bits(point_at(std::span(xyz), v[c]));
  std::ranges::sort(corners);
  return {patch, corners};
}

// Those of all skins, as if every subdomain were refined at once; each once.
std::set<PatchTriangle> triangles_of_skins(const Sample& sample, const mesh::EdgeLevels& levels)
{
  std::set<PatchTriangle> triangles;
  const Body& body = sample.body;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    const mesh::Skin skin = testing::skin_of(body, *sample.model, levels, s);
    for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
      const LocalIndex patch = body.skeleton.triangle_patch[at(skin.triangle_parent[at(t)])];
      if (patch == kNoIndex) continue;
      triangles.insert(patch_triangle(patch, skin.vertex_xyz, &skin.triangle_vertices[3 * at(t)]));
    }
  }
  return triangles;
}

double volume_of_skins(const Sample& sample, const mesh::EdgeLevels& levels)
{
  double volume = 0.0;
  for (LocalIndex s = 0; s < sample.body.num_subdomains(); ++s) {
    const mesh::Skin skin = testing::skin_of(sample.body, *sample.model, levels, s);
    volume += testing::volume_inside(skin.vertex_xyz, skin.triangle_vertices);
  }
  return volume;
}

double mean_mean_ratio(const std::vector<mesh::Piece>& pieces)
{
  double sum = 0.0;
  double num_tets = 0.0;
  for (const mesh::Piece& piece : pieces) {
    const auto shapes = testing::measure_shapes({piece.vertex_xyz, piece.tet_vertices});
    sum += shapes.mean_mean_ratio * piece.num_tets();
    num_tets += piece.num_tets();
  }
  return sum / num_tets;
}

struct SplitPieces : ::testing::TestWithParam<Way> {
  const Case& one = *case_of(GetParam());
};

TEST_P(SplitPieces, AreOneMesh)
{
  ASSERT_EQ(std::ssize(one.pieces), one.sample.body.num_subdomains());
  for (const SplitPiece& split : one.split) {
    EXPECT_FALSE(split.made.filled.result.summary.is_folded);
    EXPECT_TRUE(split.made.folds.empty());
  }
  EXPECT_EQ(testing::first_flaw(one.pieces), "");
}

TEST_P(SplitPieces, FacesCancelButForTheOutside)
{
  Hash128 open;
  for (const SplitPiece& split : one.split) {
    const PieceSummary& summary = split.made.filled.result.summary;
    EXPECT_EQ(summary.surface, verify::surface_hash(split.made.filled.piece));
    open += summary.surface;
    open -= summary.outside;
  }
  EXPECT_EQ(open, Hash128{});
  EXPECT_NE(one.split.front().made.filled.result.summary.outside, Hash128{});
}

TEST_P(SplitPieces, HoldWhatWasCounted)
{
  const LocalIndex n = GetParam().task.intervals();
  for (std::size_t s = 0; s < one.split.size(); ++s) {
    const number::PieceCounts& counts = one.split[s].counts;
    const PieceSummary& summary = one.split[s].made.filled.result.summary;
    const mesh::Piece& piece = one.pieces[s];
    EXPECT_EQ(counts.tets, GlobalIndex{one.filled[s].piece.num_tets()} * n * n * n);
    EXPECT_EQ(piece.num_tets(), counts.tets);
    EXPECT_EQ(piece.num_interior_vertices(), counts.interior_vertices);
    EXPECT_EQ(piece.num_boundary(), counts.boundary_triangles);
    EXPECT_EQ(summary.num_tets, counts.tets);
    EXPECT_EQ(summary.num_interior_vertices, counts.interior_vertices);
    EXPECT_EQ(summary.num_boundary, counts.boundary_triangles);
    EXPECT_EQ(summary.num_owned_vertices, counts.owned_vertices);
  }
}

TEST_P(SplitPieces, SummariesAreThoseOfThePieces)
{
  for (std::size_t s = 0; s < one.split.size(); ++s) {
    const FillResult& result = one.split[s].made.filled.result;
    const mesh::Piece& piece = one.pieces[s];
    const PieceSummary& before = one.filled[s].result.summary;
    EXPECT_EQ(result.summary.subdomain, piece.subdomain);
    EXPECT_EQ(result.summary.material, piece.material);
    EXPECT_EQ(result.summary.kernel, before.kernel);
    EXPECT_EQ(result.summary.euler_characteristic, before.euler_characteristic);
    EXPECT_EQ(result.summary.tets.num_tets, piece.num_tets());
    EXPECT_EQ(result.histograms.mean_ratio.total(), piece.num_tets());
    EXPECT_NEAR(result.summary.volume, testing::volume_of({piece}), 1e-12);
    EXPECT_EQ(result.summary.num_held_back, 0);
    EXPECT_LT(result.summary.model_distance, 1e-12);
  }
}

TEST_P(SplitPieces, SeamTetsTouchOtherPiecesOfTheirMaterial)
{
  const auto on_seam = testing::vertices_on_seams(one.pieces);
  for (std::size_t s = 0; s < one.pieces.size(); ++s) {
    GlobalIndex touching = 0;
    const std::vector<LocalIndex>& tets = one.pieces[s].tet_vertices;
    for (auto v = tets.begin(); v != tets.end(); v += 4) {
      touching += std::any_of(v, v + 4, [&](LocalIndex i) { return on_seam[s][at(i)] != 0; });
    }
    const PieceSummary& summary = one.split[s].made.filled.result.summary;
    EXPECT_EQ(summary.seam_tets.num_tets, touching);
    EXPECT_GT(touching, 0);
  }
}

// Every id has one owner, and who shares a vertex says the same of it.
TEST_P(SplitPieces, IdsAreDense)
{
  std::vector<number::PieceCounts> counts;
  for (const SplitPiece& split : one.split) counts.push_back(split.counts);
  const auto ids = number::IdLayout::by_owner(counts);
  const mesh::HostLayout hosts(one.sample.body.skeleton);
  std::vector<std::set<Bits>> positions(static_cast<std::size_t>(ids.num_vertices()));
  std::vector<LocalIndex> owners(positions.size(), kNoIndex);
  std::vector<LocalIndex> lowest(positions.size(), kNoIndex);
  for (std::size_t s = 0; s < one.pieces.size(); ++s) {
    const mesh::Piece& piece = one.pieces[s];
    const auto places = places_of_split_piece(piece, hosts, counts[s]);
    ASSERT_EQ(std::ssize(places), piece.num_vertices());
    for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
      const auto [owner, index] = places[at(v)];
      ASSERT_LE(owner, piece.subdomain);
      ASSERT_LT(index, counts[at(owner)].owned_vertices);
      const auto id = static_cast<std::size_t>(ids.owned_vertex_id(owner, index));
      positions[id].insert(testing::bits(point_at(std::span(piece.vertex_xyz), v)));
      owners[id] = owner;
      if (lowest[id] == kNoIndex) lowest[id] = piece.subdomain;  // Pieces ascend.
    }
  }
  EXPECT_EQ(owners, lowest);
  EXPECT_TRUE(std::ranges::all_of(positions, [](const auto& at_id) { return at_id.size() == 1; }));
  std::set<Bits> all;
  for (const std::set<Bits>& at_id : positions) all.insert(at_id.begin(), at_id.end());
  EXPECT_EQ(all.size(), positions.size()) << "two ids for one place";
}

// With the same bits as if the skeleton had been refined on all levels at once; so also between
// materials.
TEST_P(SplitPieces, TrianglesOnTheGeometryAreThoseOfTheSkeletonsLattice)
{
  std::set<PatchTriangle> triangles;
  std::size_t num_triangles = 0;
  for (const mesh::Piece& piece : one.pieces) {
    for (std::size_t t = 0; t < at(piece.num_boundary()); ++t) {
      triangles.insert(patch_triangle(piece.boundary_patch[t], piece.vertex_xyz,
                                      &piece.boundary_vertices[3 * t]));
      ++num_triangles;
    }
  }
  EXPECT_EQ(triangles.size(), num_triangles) << "a triangle belongs to two pieces";
  EXPECT_EQ(triangles, triangles_of_skins(one.sample, GetParam().task.to));
}

TEST_P(SplitPieces, VolumeIsThatInsideTheGeometry)
{
  const double volume = volume_of_skins(one.sample, GetParam().task.to);
  EXPECT_NEAR(testing::volume_of(one.pieces), volume, 1e-12 * volume);
}

TEST_P(SplitPieces, AreTheSameWhenMadeAgain)
{
  const Way& way = GetParam();
  const std::vector<SplitPiece> again =
      testing::split_all(one.sample.body, *one.sample.model, way.task, one.filled);
  for (std::size_t s = 0; s < again.size(); ++s) {
    EXPECT_EQ(to_bytes(again[s].made.filled.piece), to_bytes(one.pieces[s]));
  }
}

std::vector<Way> ways()
{
  std::vector<Way> all;
  for (const char* sample :
       {"TwoMaterials", "Octants", "OctantsOfTwoMaterials", "Ball", "Shell", "Cylinder"}) {
    all.push_back({sample, {1, 2, KernelKind::optimize}});
    all.push_back({sample, {1, 2, KernelKind::subdivide}});
  }
  for (const char* sample : {"TwoMaterials", "Ball", "Cylinder"}) {
    all.push_back({sample, {1, 3, KernelKind::optimize}, true});
  }
  all.push_back({"TwoMaterials", {2, 3, KernelKind::netgen}, true});
  all.push_back({"Octants", {2, 3, KernelKind::netgen}, true});
  all.push_back({"Ball", {1, 3, KernelKind::netgen}});
  all.push_back({"OctantsOfTwoMaterials", {2, 3, KernelKind::netgen}, true});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, SplitPieces, ::testing::ValuesIn(ways()),
                         [](const auto& way) { return name_of(way.param); });

// All vertices of the pieces, and the middles of their tets' edges.
std::set<Bits> vertices_and_midpoints(const std::vector<FilledPiece>& filled)
{
  std::set<Bits> places;
  for (const FilledPiece& one : filled) {
    for (LocalIndex t = 0; t < one.piece.num_tets(); ++t) {
      const auto corners = one.piece.corners(t);
      for (const Vec3& a : corners) {
        for (const Vec3& b : corners) places.insert(testing::bits(a == b ? a : midpoint(a, b)));
      }
    }
  }
  return places;
}

std::set<Bits> places_of(const std::vector<mesh::Piece>& pieces)
{
  std::set<Bits> places;
  for (const mesh::Piece& piece : pieces) {
    for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
      places.insert(testing::bits(point_at(std::span(piece.vertex_xyz), v)));
    }
  }
  return places;
}

TEST(SplitWithoutSmoothing, VerticesAreMidpoints)
{
  for (const char* sample : {"Octants", "TwoMaterials"}) {
    const Case& plain = *case_of({sample, {1, 2, KernelKind::subdivide}});
    EXPECT_EQ(places_of(plain.pieces), vertices_and_midpoints(plain.filled));
    const Case& smoothed = *case_of({sample, {1, 2, KernelKind::optimize}});
    EXPECT_NE(places_of(smoothed.pieces), vertices_and_midpoints(smoothed.filled));
  }
}

TEST(SplitWithoutSmoothing, OnlyPointsOnTheGeometryAreNoMidpoints)
{
  const Case& plain = *case_of({"Ball", {1, 2, KernelKind::subdivide}});
  const std::set<Bits> midpoints = vertices_and_midpoints(plain.filled);
  LocalIndex num_projected = 0;
  for (const mesh::Piece& piece : plain.pieces) {
    for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
      const Vec3 p = point_at(std::span(piece.vertex_xyz), v);
      if (midpoints.contains(testing::bits(p))) continue;
      ++num_projected;
      EXPECT_NEAR(norm(p), 1.0, 1e-12);
    }
  }
  EXPECT_GT(num_projected, 0);
}

// The same pieces, split with and without.
TEST(Smoothing, MakesTheMeshBetter)
{
  for (const char* sample : {"TwoMaterials", "Ball", "Cylinder"}) {
    const Way way{sample, {1, 2, KernelKind::optimize}};
    const Case& smoothed = *case_of(way);
    const auto plain = testing::pieces_of(
        testing::split_all(smoothed.sample.body, *smoothed.sample.model,
                           SplitTask{1, 2, KernelKind::subdivide}, smoothed.filled));
    EXPECT_GT(mean_mean_ratio(smoothed.pieces), mean_mean_ratio(plain) + 0.01);
  }
}

// Vertices of the filled piece on seams move, too, and go to the same place in all pieces.
TEST(Smoothing, MovesVerticesOnSeams)
{
  const Case& smoothed = *case_of({"Octants", {1, 3, KernelKind::optimize}});
  const std::set<Bits> before = vertices_and_midpoints(smoothed.filled);
  const auto on_seam = testing::vertices_on_seams(smoothed.pieces);
  LocalIndex num_moved = 0;
  for (std::size_t s = 0; s < smoothed.pieces.size(); ++s) {
    const mesh::Piece& piece = smoothed.pieces[s];
    for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
      const Vec3 p = point_at(std::span(piece.vertex_xyz), v);
      if (on_seam[s][at(v)] != 0 && !before.contains(testing::bits(p))) ++num_moved;
    }
  }
  EXPECT_GT(num_moved, 100);
}

// A piece that no kernel could fill is subdivided, whatever its neighbours are.
TEST(Smoothing, PiecesOfOneMaterialConformThoughOneWasSubdivided)
{
  for (const char* sample : {"Octants", "Ball"}) {
    const Sample made = sample_of(sample);
    std::vector<FilledPiece> filled =
        testing::fill_all(made.body, *made.model, 1, KernelKind::optimize);
    filled[1] = testing::fill_all(made.body, *made.model, 1, KernelKind::subdivide)[1];
    const auto split = testing::split_all(made.body, *made.model, {1, 2}, filled);
    EXPECT_EQ(testing::first_flaw(testing::pieces_of(split)), "") << sample;
  }
}

}  // namespace
}  // namespace tessera::subdomain

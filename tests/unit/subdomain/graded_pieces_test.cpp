// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/count_pieces.hpp"
#include "tessera/verify/seams.hpp"

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/graded_meshes.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

#include "split_pieces.hpp"

namespace tessera::subdomain {
namespace {

using fill::KernelKind;
using testing::Body;
using Bits = std::array<std::uint64_t, 3>;

// A mesh with any numbers, cut into subdomains, and its model.
struct Sample {
  Body body;
  std::unique_ptr<model::Model> model{};
};

Sample sample_of(const std::string& name, std::uint32_t seed)
{
  const auto made = [&](const mesh::CoarseMesh& plain, const auto& cut, auto model) {
    const mesh::CoarseMesh coarse = testing::shuffled(plain, seed);
    return Sample{Body(coarse, cut(coarse)), std::make_unique<decltype(model)>(std::move(model))};
  };
  const auto slabs = [](const mesh::CoarseMesh& coarse) { return testing::slabs(coarse, 2); };
  if (name == "TwoMaterials") {
    return made(testing::two_material_cube(2), slabs, testing::FlatModel());
  }
  if (name == "Octants") {
    return made(testing::two_material_cube(2), testing::octants, testing::FlatModel());
  }
  if (name == "Ball") return made(testing::ball(2), testing::halves, testing::SphereModel({1.0}));
  if (name == "Shell") {
    return made(testing::shell(), testing::halves, testing::SphereModel({1.0, 0.5}));
  }
  return made(testing::cylinder(2), testing::halves, testing::CylinderModel());
}

struct Way {
  std::string sample{};
  std::uint32_t seed = 0;
  int most = 1;        // Levels of an edge.
  double share = 0.5;  // Of the edges that are to have more than none.
  KernelKind kernel = KernelKind::subdivide;
};

void PrintTo(const Way& way, std::ostream* out)
{
  *out << way.sample << " seed " << way.seed << ", at most " << way.most << ", share " << way.share;
}

struct GradedPieces : ::testing::TestWithParam<Way> {
  const Way& way = GetParam();
  Sample sample = sample_of(way.sample, way.seed);
  const Body& body = sample.body;
  mesh::EdgeLevels levels = testing::random_levels(body.coarse, way.most, way.share, way.seed);
  mesh::ProjectionLimiter limiter = testing::plan_of(body, *sample.model, levels).limiter;
  std::vector<FilledPiece> filled =
      testing::fill_all(body, *sample.model, levels, way.kernel, limiter);
  std::vector<mesh::Piece> pieces{};

  void SetUp() override
  {
    ASSERT_FALSE(levels.is_uniform());
    for (const FilledPiece& one : filled) pieces.push_back(one.piece);
  }

  // As the refine stage does it.
  [[nodiscard]] std::vector<testing::SplitPiece> split_without_folds(
      const testing::SplitTask& task) const
  {
    mesh::ProjectionLimiter held_back = limiter;
    for (;;) {
      auto split = testing::split_all(body, *sample.model, task, filled, held_back);
      std::vector<mesh::PointLimit> folds;
      for (const testing::SplitPiece& one : split) {
        folds.insert(folds.end(), one.made.folds.begin(), one.made.folds.end());
      }
      mesh::ProjectionLimiter next = testing::lower(held_back, std::move(folds));
      if (next == held_back) return split;
      held_back = std::move(next);
    }
  }

  [[nodiscard]] bool is_flat() const
  {
    return way.sample == "TwoMaterials" || way.sample == "Octants";
  }
};

// What a fill does not promise of itself, check_fill() has looked at.
TEST_P(GradedPieces, AreOneMesh)
{
  EXPECT_EQ(testing::first_flaw(pieces), "");
  std::vector<Hash128> sums(at(body.skeleton.num_triangles()));
  for (const FilledPiece& one : filled) {
    EXPECT_FALSE(one.result.summary.is_folded);
    for (const verify::SeamHash& seam : one.result.seams) sums[at(seam.triangle)] += seam.hash;
  }
  EXPECT_EQ(verify::first_open_seam(sums, body.skeleton), std::nullopt);
}

TEST_P(GradedPieces, HaveTheVolumeOfTheBody)
{
  if (!is_flat()) GTEST_SKIP() << "only of flat bodies it is known";
  if (way.kernel != KernelKind::subdivide) {
    EXPECT_NEAR(testing::volume_of(pieces), 1.0, 1e-12);
    return;
  }
  constexpr int kMostHalvings = 1 + 4 + 1;  // Of the cube, of an edge, of a cut child.
  std::int64_t volume = 0;
  for (const mesh::Piece& piece : pieces) {
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      const auto [a, b, c, d] = piece.corners(t);
      volume += std::llround(std::ldexp(6.0 * tet_volume(a, b, c, d), 3 * kMostHalvings));
    }
  }
  EXPECT_EQ(volume, std::int64_t{6} << 3 * kMostHalvings);
}

TEST_P(GradedPieces, AreOnTheGeometry)
{
  LocalIndex num_points = 0;
  for (const FilledPiece& one : filled) {
    EXPECT_LT(one.result.summary.model_distance, 1e-12);
    EXPECT_EQ(one.result.summary.num_held_back > 0, one.result.summary.held_back_distance > 0.0);
    if (one.result.summary.num_held_back > 0) continue;
    const mesh::Piece& piece = one.piece;
    for (std::size_t i = 0; i < piece.boundary_vertices.size(); ++i) {
      const Vec3 p = point_at(std::span(piece.vertex_xyz), piece.boundary_vertices[i]);
      const auto surface = body.coarse.patch_surface[at(piece.boundary_patch[i / 3])];
      const double angle = std::atan2(p[1], p[0]);
      const model::SurfaceParameters guess = surface == 0 ? model::SurfaceParameters{angle, p[2]}
                                                          : model::SurfaceParameters{p[0], p[1]};
      EXPECT_LT(norm(sample.model->project_to_surface(surface, p, guess).xyz - p), 1e-12);
      ++num_points;
    }
  }
  EXPECT_TRUE(num_points > 0 || !limiter.entries().empty());
}

TEST_P(GradedPieces, HoldWhatWasCounted)
{
  if (way.kernel != KernelKind::subdivide) GTEST_SKIP() << "not in closed form";
  const PartitionedMesh cut(body.coarse, body.decomposition, levels);
  const auto counts = count_subdivided_pieces(cut, levels);
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    EXPECT_EQ(counts[s].tets, pieces[s].num_tets());
    EXPECT_EQ(counts[s].interior_vertices, pieces[s].num_interior_vertices());
    EXPECT_EQ(counts[s].boundary_triangles, pieces[s].num_boundary());
    EXPECT_EQ(counts[s], (number::PieceCounts{counts_of(filled[s].result.summary)}));
  }
}

TEST_P(GradedPieces, IdsAreDenseAndShared)
{
  std::vector<number::PieceCounts> counts;
  for (const FilledPiece& one : filled) counts.push_back(counts_of(one.result.summary));
  const mesh::HostLayout hosts(body.skeleton);
  const auto ids =
      number::IdLayout::by_host(hosts, mesh::lattice_levels(body.skeleton, levels), counts);
  std::vector<std::set<Bits>> positions(static_cast<std::size_t>(ids.num_vertices()));
  for (const mesh::Piece& piece : pieces) {
    for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
      const bool is_on_skin = v < piece.num_skin_vertices();
      const GlobalIndex id =
          is_on_skin ? ids.vertex_id(piece.skin_point(v))
                     : ids.interior_vertex_id(piece.subdomain, v - piece.num_skin_vertices());
      positions.at(static_cast<std::size_t>(id))
          .insert(testing::bits(point_at(std::span(piece.vertex_xyz), v)));
    }
  }
  std::set<Bits> all;
  for (const std::set<Bits>& at_id : positions) {
    EXPECT_EQ(at_id.size(), 1U) << "an id of nothing, or of two places";
    all.insert(at_id.begin(), at_id.end());
  }
  EXPECT_EQ(all.size(), positions.size()) << "two ids for one place";
}

// Exchanged tets, or none, and then split further.
TEST_P(GradedPieces, AreOneMeshAfterSeamsWereImprovedAndAfterASplit)
{
  if (way.kernel != KernelKind::subdivide) {
    const LocalIndex num_improved = testing::improve_all(body, filled);
    EXPECT_GT(num_improved, way.sample == "Cylinder" ? -1 : 0) << "nothing was exchanged";
    pieces.clear();
    for (const FilledPiece& one : filled) pieces.push_back(one.piece);
    ASSERT_EQ(testing::first_flaw(pieces), "");
  }
  const testing::SplitTask task{levels, levels.shifted(1), way.kernel};
  const auto split = split_without_folds(task);
  const auto finer = testing::pieces_of(split);
  Hash128 open;
  for (std::size_t s = 0; s < split.size(); ++s) {
    const PieceSummary& summary = split[s].made.filled.result.summary;
    ASSERT_FALSE(summary.is_folded);
    EXPECT_EQ(summary.num_tets, 8 * GlobalIndex{pieces[s].num_tets()});
    EXPECT_EQ(summary.num_boundary, split[s].counts.boundary_triangles);
    EXPECT_EQ(summary.num_interior_vertices, split[s].counts.interior_vertices);
    EXPECT_EQ(summary.num_owned_vertices, split[s].counts.owned_vertices);
    EXPECT_LT(summary.model_distance, 1e-12);
    open += summary.surface;
    open -= summary.outside;
  }
  EXPECT_EQ(testing::first_flaw(finer), "");
  EXPECT_EQ(open, Hash128{});
  if (is_flat()) {
    EXPECT_NEAR(testing::volume_of(finer), 1.0, 1e-11);
  }
}

std::vector<Way> ways()
{
  std::vector<Way> all;
  for (std::uint32_t seed = 1; seed < 7; ++seed) {
    for (const char* sample : {"TwoMaterials", "Octants"}) {
      all.push_back({sample, seed, 1, 0.15 * seed});
      all.push_back({sample, seed, 4, 0.02 + 0.01 * seed});
    }
    for (const char* sample : {"Ball", "Shell", "Cylinder"}) {
      all.push_back({sample, seed, seed % 2 == 0 ? 1 : 2, 0.12 * seed});
    }
  }
  for (const char* sample : {"TwoMaterials", "Octants", "Ball", "Shell", "Cylinder"}) {
    all.push_back({sample, 11, 2, 0.3, KernelKind::optimize});
    all.push_back({sample, 12, 1, 0.5, KernelKind::optimize});
  }
  all.push_back({"TwoMaterials", 13, 2, 0.3, KernelKind::netgen});
  all.push_back({"Ball", 14, 2, 0.3, KernelKind::netgen});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Random, GradedPieces, ::testing::ValuesIn(ways()));

}  // namespace
}  // namespace tessera::subdomain

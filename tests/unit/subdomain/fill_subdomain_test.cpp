// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/fill_subdomain.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/fill/check.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/filled_cube.hpp"
#include "support/meshes.hpp"

namespace tessera::subdomain {
namespace {

using testing::Body;

struct FillSubdomain : testing::FilledCube {};

TEST_F(FillSubdomain, PiecesSumUpToTheCube)
{
  double volume = 0.0;
  double area = 0.0;
  for (const FilledPiece& filled : pieces()) {
    volume += filled.result.summary.volume;
    area += filled.result.summary.boundary_area;
    EXPECT_NEAR(filled.result.summary.volume, 0.25, 1e-12);
    EXPECT_EQ(filled.result.summary.euler_characteristic, 1);
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
  EXPECT_NEAR(area, 6.0, 1e-12);
}

TEST_F(FillSubdomain, SummaryIsThatOfThePiece)
{
  for (const FilledPiece& filled : pieces()) {
    const PieceSummary& summary = filled.result.summary;
    const mesh::Piece& piece = filled.piece;
    EXPECT_EQ(summary.subdomain, piece.subdomain);
    EXPECT_EQ(summary.material, piece.material);
    EXPECT_EQ(summary.num_tets, piece.num_tets());
    EXPECT_EQ(summary.num_interior_vertices, piece.num_interior_vertices());
    EXPECT_EQ(summary.num_boundary, piece.num_boundary());
    EXPECT_EQ(summary.tets.num_tets, piece.num_tets());
    EXPECT_EQ(filled.result.histograms.mean_ratio.total(), piece.num_tets());
    EXPECT_EQ(filled.result.histograms.seam_mean_ratio.total(), summary.seam_tets.num_tets);
    EXPECT_EQ(summary.model_distance, 0.0);
    EXPECT_EQ(summary.num_held_back, 0);
  }
}

TEST_F(FillSubdomain, EdgesAreCountedOnceInAPiece)
{
  for (const FilledPiece& filled : pieces()) {
    std::set<std::pair<LocalIndex, LocalIndex>> edges;
    const auto& tets = filled.piece.tet_vertices;
    for (std::size_t t = 0; t < tets.size(); t += 4) {
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) edges.insert(std::minmax(tets[t + a], tets[t + b]));
      }
    }
    EXPECT_EQ(filled.result.histograms.log2_edge_length.total(),
              static_cast<GlobalIndex>(edges.size()));
  }
}

// Between slabs of one material there is a seam; the interface of two materials is none.
TEST_F(FillSubdomain, SeamTetsTouchTheOtherSlabOfTheirMaterial)
{
  for (const FilledPiece& filled : pieces()) {
    const mesh::Piece& piece = filled.piece;
    GlobalIndex touching = 0;
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      bool touches = false;
      for (const Vec3& p : piece.corners(t)) touches = touches || p[1] == 0.5;
      touching += touches ? 1 : 0;
    }
    EXPECT_EQ(filled.result.summary.seam_tets.num_tets, touching);
    EXPECT_GT(touching, 0);
  }
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const Body by_material(cube, testing::one_subdomain_a_material(cube));
  EXPECT_EQ(testing::fill_of(by_material, 1, 0).result.summary.seam_tets.num_tets, 0);
}

TEST_F(FillSubdomain, SeamsOfAllPiecesCancel)
{
  std::vector<Hash128> sums(at(body().skeleton.num_triangles()));
  for (const FilledPiece& filled : pieces()) {
    for (const verify::SeamHash& seam : filled.result.seams) sums[at(seam.triangle)] += seam.hash;
  }
  EXPECT_EQ(verify::first_open_seam(sums, body().skeleton), std::nullopt);
}

TEST_F(FillSubdomain, GivesTheSameBytesAgainAndAfterOtherJobs)
{
  static_cast<void>(testing::fill_of(body(), 2, 0));
  const FilledPiece again = testing::fill_of(body(), kLevels, 2);
  EXPECT_EQ(to_bytes(again.piece), to_bytes(pieces()[2].piece));
}

TEST_F(FillSubdomain, FillsTheSameSkinFromTheSkinAlone)
{
  const PieceSummary children = pieces()[1].result.summary;
  const FilledPiece anew = testing::fill_of(body(), kLevels, 1, {.start = fill::FillStart::skin});
  EXPECT_EQ(anew.piece.boundary_vertices, pieces()[1].piece.boundary_vertices);
  EXPECT_EQ(anew.result.summary.euler_characteristic, children.euler_characteristic);
  EXPECT_NEAR(anew.result.summary.volume, children.volume, 1e-12);
  EXPECT_NE(anew.piece.tet_vertices, pieces()[1].piece.tet_vertices);
}

// Kernels that go wrong, as NETGEN can.
class BrokenKernel final : public fill::Kernel {
 public:
  enum class Defect : int { gives_up, returns_nothing, loses_a_tet };

  explicit BrokenKernel(Defect defect) : defect_(defect) {}

  [[nodiscard]] fill::FillOutput fill(const fill::FillInput& input,
                                      const fill::KernelSettings& settings) const override
  {
    if (defect_ == Defect::gives_up) throw NetgenError("no tets for this skin");
    if (defect_ == Defect::returns_nothing) return {};
    fill::FillOutput tets = netgen::make_fill_kernel()->fill(input, settings);
    tets.tet_vertices.resize(tets.tet_vertices.size() - 4);
    return tets;
  }

 private:
  Defect defect_;
};

TEST_F(FillSubdomain, NoDefectOfAKernelPasses)
{
  const testing::FlatModel model;
  const mesh::ProjectionLimiter limiter;
  const refine::RefineContext refine{body().coarse, body().skeleton, model, limiter, 1, true};
  const PartitionedMesh cut(body().coarse, body().decomposition, 1);
  const auto fill = [&](BrokenKernel::Defect defect) {
    static_cast<void>(fill_subdomain(cut, refine, 0, {}, BrokenKernel(defect)));
  };
  EXPECT_THROW(fill(BrokenKernel::Defect::gives_up), NetgenError);
  EXPECT_THROW(fill(BrokenKernel::Defect::returns_nothing), MeshError);
  EXPECT_THROW(fill(BrokenKernel::Defect::loses_a_tet), MeshError);
}

// Leaves a vertex near the opposite face of one of its tets.
class FlatteningKernel final : public fill::Kernel {
 public:
  [[nodiscard]] fill::FillOutput fill(const fill::FillInput& input,
                                      const fill::KernelSettings& settings) const override
  {
    const fill::FillOutput good = netgen::make_fill_kernel()->fill(input, settings);
    for (std::size_t c = 0; c < good.tet_vertices.size(); ++c) {
      if (3 * at(good.tet_vertices[c]) < input.vertex_xyz.size()) continue;  // Of the skin.
      fill::FillOutput flat = good;
      for (std::size_t d = 0; d < 3; ++d)
        flat.vertex_xyz[3 * at(good.tet_vertices[c]) + d] = near_opposite_face(good, c, d);
      if (fill::all_positive(flat)) return flat;
    }
    throw NetgenError("no vertex may move");
  }

 private:
  static double near_opposite_face(const fill::FillOutput& tets, std::size_t corner, std::size_t d)
  {
    constexpr double kNear = 0.03;
    double sum = 0.0;
    for (std::size_t c = 4 * (corner / 4); c < 4 * (corner / 4) + 4; ++c) {
      const double part = c == corner ? kNear : (1.0 - kNear) / 3.0;
      sum += part * tets.vertex_xyz[3 * at(tets.tet_vertices[c]) + d];
    }
    return sum;
  }
};

TEST_F(FillSubdomain, MendsTheWorstTetsOfAKernel)
{
  constexpr int kFine = 2;
  const testing::FlatModel model;
  const mesh::ProjectionLimiter limiter;
  const refine::RefineContext refine{body().coarse, body().skeleton, model, limiter, kFine, true};
  const PartitionedMesh cut(body().coarse, body().decomposition, kFine);
  const FilledPiece filled = fill_subdomain(cut, refine, 0, {}, FlatteningKernel());
  EXPECT_GT(filled.result.summary.tets.min_dihedral_deg, 10.0);
}

TEST(FillSubdomainOnACurvedModel, ReportsDistancesAndHeldBackPoints)
{
  const Body body(testing::ball(2), testing::halves(testing::ball(2)));
  const testing::SphereModel sphere({1.0});
  const testing::LazyModel lazy(sphere, 0.99);
  // An edge on the sphere of the first triangle of subdomain 0 there.
  LocalIndex edge = 0;
  while (body.skeleton.edge_patch[at(edge)] == kNoIndex
         || body.skeleton.edge_owner[at(edge)] != 0) {
    ++edge;
  }
  const mesh::ProjectionLimiter limiter({{mesh::LatticePointKey::on_edge(edge, 2, 1), 0.5}});
  const refine::RefineContext refine{body.coarse, body.skeleton, lazy, limiter, 1, true};
  const PartitionedMesh cut(body.coarse, body.decomposition, 1);
  const auto kernel = netgen::make_fill_kernel();
  const PieceSummary summary = fill_subdomain(cut, refine, 0, {}, *kernel).result.summary;
  EXPECT_EQ(summary.num_held_back, 1);
  // The projection leaves a hundredth of the way to go; a second one, which measures the distance,
  // covers all but a hundredth of what is left.
  double farthest = 0.0;
  double way_of_held_back = 0.0;
  const auto [complex, flat] = testing::refine_skin(body, sphere, 0, 0);
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    const LocalIndex parent = complex.edge_skeleton[at(e)];
    if (body.skeleton.edge_patch[at(parent)] == kNoIndex) continue;
    const double way = 1.0 - norm(midpoint(flat.edge_point(e, 0), flat.edge_point(e, 1)));
    if (parent == edge) {
      way_of_held_back = way;
    } else {
      farthest = std::max(farthest, way);
    }
  }
  EXPECT_GT(farthest, 0.01);
  EXPECT_GT(way_of_held_back, 0.01);
  EXPECT_NEAR(summary.model_distance, 0.99 * 0.01 * farthest, 1e-12);
  EXPECT_NEAR(summary.held_back_distance, 0.99 * (1.0 - 0.5 * 0.99) * way_of_held_back, 1e-12);
}

TEST(FillSubdomainWithOurOptimiser, KeepsTheSkinAndBeatsTheChildren)
{
  const Body ball(testing::ball(2), testing::halves(testing::ball(2)));
  for (LocalIndex s = 0; s < ball.num_subdomains(); ++s) {
    const auto children = testing::fill_of(ball, 2, s, {.kernel = fill::KernelKind::subdivide});
    const auto made = testing::fill_of(ball, 2, s, {.kernel = fill::KernelKind::optimize});
    const PieceSummary& before = children.result.summary;
    const PieceSummary& after = made.result.summary;
    EXPECT_EQ(after.kernel, fill::KernelKind::optimize);
    EXPECT_EQ(to_bytes(made.result.seams), to_bytes(children.result.seams));
    EXPECT_EQ(after.outside, before.outside);
    EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
    EXPECT_NEAR(after.volume, before.volume, 1e-12);
    EXPECT_GT(after.tets.mean_mean_ratio(), before.tets.mean_mean_ratio() + 0.02);
    EXPECT_GE(after.tets.min_mean_ratio, before.tets.min_mean_ratio);
    EXPECT_TRUE(
        std::equal(children.piece.vertex_xyz.begin(),
                   children.piece.vertex_xyz.begin() + 3 * children.piece.num_skin_vertices(),
                   made.piece.vertex_xyz.begin()));
  }
}

}  // namespace
}  // namespace tessera::subdomain

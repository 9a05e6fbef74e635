// SPDX-License-Identifier: BSD-3-Clause
#include "split_pieces.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "tessera/improve/seam_regions.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/subdomain/seam_optimizer.hpp"
#include "tessera/untangle/fold_test.hpp"

#include "support/piece_sets.hpp"

namespace tessera::testing {
namespace {

using subdomain::FilledPiece;

// What every piece says of its surface, and what the others say of that.
void compare_all(const Body& body, const std::vector<FilledPiece>& filled, int splits,
                 std::vector<SplitPiece>& split)
{
  const auto neighbours = mesh::neighbours_by_vertex(body.skeleton);
  for (const FilledPiece& one : filled) {
    split.emplace_back().around.surface = subdomain::surface_of(one.piece);
  }
  for (std::size_t s = 0; s < split.size(); ++s) {
    std::vector<number::SurfaceList> others;
    for (const LocalIndex other : neighbours[s]) others.push_back(split[at(other)].around.surface);
    subdomain::PieceSurroundings& around = split[s].around;
    around.shared = number::compare_surfaces(around.surface, others);
    split[s].counts =
        subdomain::count_split_piece(filled[s].piece, around.surface, around.shared, {splits});
  }
}

void add_surroundings(const Body& body, const std::vector<FilledPiece>& filled, int splits,
                      std::vector<SplitPiece>& split)
{
  const auto neighbours = mesh::neighbours_by_vertex(body.skeleton);
  for (std::size_t s = 0; s < split.size(); ++s) {
    subdomain::PieceSurroundings& around = split[s].around;
    const mesh::Piece& piece = filled[s].piece;
    std::vector<number::OwnedSurface> owners{{piece.subdomain, around.shared.owned}};
    for (const LocalIndex other : neighbours[s]) {
      const subdomain::PieceSurroundings& beside = split[at(other)].around;
      owners.push_back({other, beside.shared.owned});
      if (beside.surface.material != piece.material) continue;
      around.halos.push_back(
          subdomain::halo_of(filled[at(other)].piece, beside.surface, beside.shared));
    }
    around.places =
        number::place_surface(around.surface.simplices, owners, mesh::lattice::intervals(splits));
  }
}

}  // namespace

std::vector<FilledPiece> fill_all(const Body& body, const model::Model& model,
                                  const mesh::EdgeLevels& levels, fill::KernelKind kernel,
                                  const mesh::ProjectionLimiter& limiter)
{
  const subdomain::PartitionedMesh cut(body.coarse, body.decomposition, levels);
  const auto netgen = netgen::make_fill_kernel();
  std::vector<FilledPiece> filled;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    filled.push_back(
        subdomain::fill_subdomain(cut, {body.coarse, body.skeleton, model, limiter, levels, true},
                                  s, {.kernel = kernel}, *netgen));
  }
  return filled;
}

mesh::ProjectionLimiter lower(const mesh::ProjectionLimiter& limiter,
                              std::vector<mesh::PointLimit> more)
{
  more.insert(more.end(), limiter.entries().begin(), limiter.entries().end());
  return mesh::ProjectionLimiter(std::move(more));
}

Plan plan_of(const Body& body, const model::Model& model, const mesh::EdgeLevels& levels)
{
  constexpr int kMostRounds = 200;
  const subdomain::PartitionedMesh cut(body.coarse, body.decomposition, levels);
  Plan plan;
  while (plan.num_rounds < kMostRounds) {
    std::vector<mesh::PointLimit> folds;
    for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
      const mesh::TetComplex complex =
          mesh::tet_complex(body.coarse, body.skeleton,
                            untangle::tets_on_geometry(body.coarse, cut.tets[s], cut.on_geometry));
      const auto points = refine::refine_lattice(
          complex.faces, {body.coarse, body.skeleton, model, plan.limiter, levels});
      const auto found = untangle::find_folds(complex, body.skeleton, points, plan.limiter);
      folds.insert(folds.end(), found.begin(), found.end());
    }
    if (folds.empty()) return plan;
    plan.limiter = lower(plan.limiter, std::move(folds));
    ++plan.num_rounds;
  }
  ADD_FAILURE() << "folds after " << kMostRounds << " rounds";
  return plan;
}

LocalIndex improve_all(const Body& body, std::vector<FilledPiece>& filled)
{
  const improve::SeamRegions regions(body.skeleton, body.decomposition);
  const auto optimizer = subdomain::make_seam_optimizer(false);
  std::vector<mesh::Piece> pieces;
  for (const FilledPiece& one : filled) pieces.push_back(one.piece);
  LocalIndex num_accepted = 0;
  for (int phase = 0; phase < improve::kNumPhases; ++phase) {
    num_accepted += improve_phase(regions, phase, {.optimizer = *optimizer}, pieces).num_accepted;
  }
  for (std::size_t s = 0; s < pieces.size(); ++s) filled[s].piece = std::move(pieces[s]);
  return num_accepted;
}

std::vector<SplitPiece> split_all(const Body& body, const model::Model& model,
                                  const SplitTask& task, const std::vector<FilledPiece>& filled,
                                  const mesh::ProjectionLimiter& limiter)
{
  std::vector<SplitPiece> split;
  compare_all(body, filled, task.splits(), split);
  add_surroundings(body, filled, task.splits(), split);
  const subdomain::PartitionedMesh cut(body.coarse, body.decomposition, task.from);
  const subdomain::PieceRefiner refiner(cut, {task.splits()});
  const refine::RefineContext refine{body.coarse, body.skeleton, model, limiter, task.to, true};
  for (std::size_t s = 0; s < split.size(); ++s) {
    split[s].around.is_smoothed = task.kernel != fill::KernelKind::subdivide;
    split[s].made =
        refiner.refine(filled[s].piece, split[s].around, refine, filled[s].result.summary);
  }
  return split;
}

std::vector<mesh::Piece> pieces_of(const std::vector<SplitPiece>& split)
{
  std::vector<mesh::Piece> pieces;
  for (const SplitPiece& one : split) pieces.push_back(one.made.filled.piece);
  return pieces;
}

}  // namespace tessera::testing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/edge_levels.hpp"
#include "tessera/model/model.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/piece_surface.hpp"
#include "tessera/subdomain/refine_piece.hpp"

#include "support/bodies.hpp"

namespace tessera::testing {

/// @brief The pieces of a body, filled; one kernel for all.
[[nodiscard]] std::vector<subdomain::FilledPiece> fill_all(
    const Body& body, const model::Model& model, const mesh::EdgeLevels& levels,
    fill::KernelKind kernel, const mesh::ProjectionLimiter& limiter = {});

/// @brief What is held back of a body's points until no child of its tets is folded.
struct Plan {
  mesh::ProjectionLimiter limiter{};
  int num_rounds = 0;  ///< That found folds.
};

/// @brief The plan stage of the program in one process.
[[nodiscard]] Plan plan_of(const Body& body, const model::Model& model,
                           const mesh::EdgeLevels& levels);

/// @brief The limiter with some limits more.
[[nodiscard]] mesh::ProjectionLimiter lower(const mesh::ProjectionLimiter& limiter,
                                            std::vector<mesh::PointLimit> more);

/// @brief Lets pieces exchange tets across their seams, in all phases.
/// @return Number of regions that are better.
LocalIndex improve_all(const Body& body, std::vector<subdomain::FilledPiece>& filled);

/// @brief A piece that was split further, and what was known of it before.
struct SplitPiece {
  subdomain::PieceSurroundings around{};
  number::PieceCounts counts{};  ///< count_split_piece().
  subdomain::RefinedPiece made{};
};

/// @brief From and to which levels pieces are split.
struct SplitTask {
  mesh::EdgeLevels from = 0;
  mesh::EdgeLevels to = 0;                               ///< Everywhere as many more.
  fill::KernelKind kernel = fill::KernelKind::optimize;  ///< That the body is for; single pieces
                                                         ///< may come from another.

  [[nodiscard]] int splits() const { return to.largest() - from.largest(); }
  [[nodiscard]] LocalIndex intervals() const { return mesh::lattice::intervals(splits()); }
};

/// @brief Splits all pieces further, as the refine stage of the program does it.
[[nodiscard]] std::vector<SplitPiece> split_all(const Body& body, const model::Model& model,
                                                const SplitTask& task,
                                                const std::vector<subdomain::FilledPiece>& filled,
                                                const mesh::ProjectionLimiter& limiter = {});

/// @brief The pieces alone.
[[nodiscard]] std::vector<mesh::Piece> pieces_of(const std::vector<SplitPiece>& split);

}  // namespace tessera::testing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/check/report.hpp"
#include "tessera/comm/communicator.hpp"

#include "check/findings.hpp"
#include "check/piece_mesh.hpp"
#include "check/piece_surface.hpp"
#include "check/quality.hpp"

namespace tessera::check {

/// @brief Figures of one piece; added in the order of pieces, whichever rank has them.
struct PieceRecord {
  LocalIndex piece = 0;
  PieceFigures figures{};
  double boundary_area = 0.0;
  ShapeSums shapes{};
  ShapeSums seam_shapes{};
};

/// @brief Volume and digest of a piece; reports tets without positive volume. Local.
/// The digest is that of the cells whose points are in range, and zero if the piece has no ids.
[[nodiscard]] PieceFigures measure(const PieceMesh& mesh, Findings& findings);

/// @brief Counts of mean ratios of all tets, and of the seam tets.
struct ShapeCounts {
  MeanRatioCounts all{};
  MeanRatioCounts seam{};
};

/// @brief Shapes of the finite tets of a piece. Local.
/// @param[in] is_on_seam Shape (num_points).
void measure_shapes(const PieceMesh& mesh, const std::vector<bool>& is_on_seam, PieceRecord& record,
                    ShapeCounts& counts);

/// @brief The records of all ranks in the order of pieces, on every rank.
/// @note Collective.
[[nodiscard]] std::vector<PieceRecord> all_records(std::span<const PieceRecord> own,
                                                   const comm::Communicator& comm);

}  // namespace tessera::check

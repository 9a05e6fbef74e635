// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/check/report.hpp"
#include "tessera/comm/communicator.hpp"

#include "check/findings.hpp"
#include "check/piece/mesh.hpp"
#include "check/piece/quality.hpp"

namespace tessera::check {

/// @brief Figures of the tets that a piece has of one subdomain; added in the order of subdomains
/// and pieces, whichever rank has them.
struct PieceRecord {
  SubdomainFigures figures{};
  LocalIndex piece = 0;
  double boundary_area = 0.0;
  double min_scaled_jacobian = 1.0;  ///< Bound below that of each tet; 1 if all are straight.
  ShapeSums shapes{};
  ShapeSums seam_shapes{};

  static auto fields(auto& self)
  {
    return std::tie(self.figures, self.piece, self.boundary_area, self.min_scaled_jacobian,
                    self.shapes, self.seam_shapes);
  }
};

/// @brief The records of one piece.
class PieceRecords {
 public:
  explicit PieceRecords(LocalIndex piece) : piece_(piece) {}

  /// @brief Record of a subdomain, made when it is asked for first. Fast for the one asked for
  /// last.
  [[nodiscard]] PieceRecord& of(std::int32_t subdomain);
  [[nodiscard]] LocalIndex piece() const { return piece_; }
  [[nodiscard]] const std::vector<PieceRecord>& all() const { return records_; }

 private:
  LocalIndex piece_;
  std::size_t last_ = 0;  // Asked for last.
  std::vector<PieceRecord> records_{};
  std::map<std::int32_t, std::size_t> row_{};  // Of each subdomain.
};

/// @brief Volumes, digests and shapes of a piece; reports tets without positive volume. Local.
/// A digest is that of the cells whose points are in range, and zero if the piece has no ids.
/// Shapes are those of the finite tets.
/// @param[in,out] counts Gets their mean ratios.
[[nodiscard]] PieceRecords measure(const PieceMesh& mesh, MeanRatioCounts& counts,
                                   Findings& findings);

/// @brief Shapes of the finite tets that have a point on a seam. Local.
/// @param[in] is_on_seam Shape (num_points).
/// @param[in,out] counts Gets their mean ratios.
void measure_seam_tets(const mesh::MeshArrays& arrays, const std::vector<bool>& is_on_seam,
                       PieceRecords& records, MeanRatioCounts& counts);

/// @brief The records of all ranks in the order of subdomains and pieces, on every rank.
/// @note Collective.
[[nodiscard]] std::vector<PieceRecord> all_records(std::span<const PieceRecords> own,
                                                   const comm::Communicator& comm);

}  // namespace tessera::check

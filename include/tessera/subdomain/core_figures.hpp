// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "tessera/improve/phase_bands.hpp"
#include "tessera/improve/piece_part.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

/// @brief What is known of a piece's *core*: the tets that no phase from some one on touches. With
/// the outer part as it has become, improve::outer_part(), that is all that a run keeps of an
/// improved piece.
struct CoreFigures {
  FillResult
      figures{};  ///< Counts, volume, surface, shapes, edges. Without what the outer part has
                  ///< as well and cannot lose: inner vertices, edges with an inner vertex.
  std::vector<mesh::HostPoint> shared_vertices{};         ///< Of the core's tets, ascending.
  std::vector<std::array<LocalIndex, 2>> shared_edges{};  ///< Edges between shared vertices, by
                                                          ///< tags, that the outer part had, too.

  static auto fields(auto& self)
  {
    return std::tie(self.figures, self.shared_vertices, self.shared_edges);
  }
};

/// @brief Measures the core of a piece. Local; linear.
/// @param[in] whole The piece as a phase found it.
/// @param[in] kept Made of it for that phase. @pre It has a rim.
/// @param[in] on_seam Shape (num_skin_vertices): whether tets there are seam tets.
[[nodiscard]] CoreFigures measure_core(const improve::PiecePart& whole,
                                       const improve::PhaseBands& kept,
                                       const std::vector<char>& on_seam);

/// @brief Adds the core to the figures of the outer part. Local.
/// @param[in] outer As all updates have left it.
void add_core(const CoreFigures& core, const improve::PiecePart& outer, FillResult& result);

/// @brief The shared vertices of core and outer part together, ascending. Local.
[[nodiscard]] std::vector<mesh::HostPoint> shared_vertices(const CoreFigures& core,
                                                           const mesh::Piece& outer);

}  // namespace tessera::subdomain

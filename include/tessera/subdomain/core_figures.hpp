// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/improve/phase_bands.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

/// @brief What is known of a piece's core: the tets that no improvement touches. With the outer
/// part as it has become, improve::outer_part(), that is all that a run keeps of an improved piece.
struct CoreFigures {
  FillResult figures{};  ///< Counts, volume, surface, shapes; edges and vertices that the outer
                         ///< part has as well count there.
  std::vector<mesh::HostPoint> shared_vertices{};  ///< Of the core alone, ascending.

  static auto fields(auto& self) { return std::tie(self.figures, self.shared_vertices); }
};

/// @brief Measures the core of a piece as it was filled. Local; linear.
/// @param[in] kept Of the first phase. @pre It has a rim.
[[nodiscard]] CoreFigures measure_core(const FilledPiece& filled, const improve::PhaseBands& kept);

/// @brief Adds the core to the figures of the outer part. Local.
void add_core(const CoreFigures& core, FillResult& outer);

}  // namespace tessera::subdomain

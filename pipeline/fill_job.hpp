// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/fill/kernel.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "pipeline/piece_summary.hpp"

namespace tessera::pipeline {

/// @brief What a fill job works on. Borrowed, not owned.
struct FillContext {
  const refine::RefineContext& refine;
  const mesh::Decomposition& decomposition;
  const std::vector<char>& seam_units;     ///< mesh::units_on_seams().
  const std::vector<double>& vertex_size;  ///< fill::vertex_sizes().
};

/// @brief A piece and what the run keeps of it.
struct FilledPiece {
  mesh::Piece piece{};
  FillResult result{};
};

/// @brief The job of one subdomain: refine its skin, fill it, check the fill, measure it.
/// @note Local; the kernel may crash: call it in a job process.
/// @throws GeometryError, NetgenError, MeshError if the try failed.
[[nodiscard]] FilledPiece fill_subdomain(const FillContext& context, LocalIndex subdomain,
                                         const fill::Kernel& kernel, const fill::FillTry& settings);

}  // namespace tessera::pipeline

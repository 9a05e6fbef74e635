// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/fill/fill_try.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/refine/lattice_refiner.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

/// @brief A piece and what the run keeps of it.
struct FilledPiece {
  mesh::Piece piece{};
  FillResult result{};
};

/// @brief The job of one subdomain: refine it, fill it, check the fill, measure it.
/// @param[in] refine Made from the arrays of `cut`.
/// @param[in] how Which kernel, what it begins with, and its settings; `{}` is the main way. If it
/// fails, fill::fallback_sequence() has the next one.
/// @param[in] netgen The kernel that is used if the try asks for NETGEN.
/// @param[in] layers Of a mesh with layers.
/// @note Local; the kernel may crash: call it in a job process.
/// @throws GeometryError, NetgenError, MeshError if the try failed.
[[nodiscard]] FilledPiece fill_subdomain(const PartitionedMesh& cut,
                                         const refine::RefineContext& refine, LocalIndex subdomain,
                                         const fill::FillTry& how, const fill::Kernel& netgen,
                                         const LayerTables* layers = nullptr);

}  // namespace tessera::subdomain

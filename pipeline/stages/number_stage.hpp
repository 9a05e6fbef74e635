// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/mesh/piece.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief Ids of the whole mesh, made or not. They follow from closed forms unless pieces have
/// exchanged tets. Local.
[[nodiscard]] number::IdLayout number_mesh(const RunResult& run,
                                           const subdomain::PartitionedMesh& cut,
                                           const RunOutline& outline);

/// @brief Who owns which vertex, once pieces have exchanged tets; else empty. Local.
[[nodiscard]] std::function<std::vector<subdomain::VertexPlace>(const mesh::Piece&)>
places_of_vertices(const RunResult& run, const subdomain::PartitionedMesh& cut);

}  // namespace tessera::pipeline

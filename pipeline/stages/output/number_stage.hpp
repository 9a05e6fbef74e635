// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tessera/mesh/piece.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief Ids of the whole mesh, made or not. They follow from closed forms unless pieces have
/// exchanged tets.
struct NumberedMesh {
  number::IdLayout ids;
  /// Who owns which vertex, once pieces have exchanged tets; else empty.
  std::function<std::vector<subdomain::VertexPlace>(const mesh::Piece&)> places_of{};
  std::function<std::vector<subdomain::VertexPlace>(std::span<const mesh::HostPoint>)>
      places_of_names{};
  std::optional<subdomain::LayerTables> layers{};  ///< If there are layers; borrows the mesh.
};

/// @brief Gives ids to the pieces of a run. Local.
[[nodiscard]] NumberedMesh run_number_stage(const RunResult& run,
                                            const subdomain::PartitionedMesh& cut,
                                            const RunOutline& outline);

/// @brief What writers of pieces need; borrows all of it. Local.
[[nodiscard]] subdomain::WriteContext write_context(const NumberedMesh& numbered,
                                                    const subdomain::PartitionedMesh& cut,
                                                    const std::string& length_unit);

}  // namespace tessera::pipeline

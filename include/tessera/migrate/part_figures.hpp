// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"
#include "tessera/migrate/tet_neighbours.hpp"

namespace tessera::migrate {

/// @brief What one part holds.
struct PartFigures {
  GlobalIndex num_tets = 0;
  GlobalIndex num_boundary = 0;       ///< Boundary triangles.
  GlobalIndex num_components = 0;     ///< Sets of its tets joined through triangles.
  GlobalIndex num_cut_triangles = 0;  ///< Between a tet of it and one of another part.
  double volume = 0.0;                ///< Sum over its tets in the order of their ids.
};

/// @brief Measures all parts; on every rank.
/// @note Collective.
/// @pre Each part is on one rank.
[[nodiscard]] std::vector<PartFigures> measure_parts(const comm::Communicator& comm,
                                                     const DistributedMesh& mesh,
                                                     const TetNeighbours& neighbours,
                                                     LocalIndex num_parts);

}  // namespace tessera::migrate

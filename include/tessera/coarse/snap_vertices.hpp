// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::coarse {

/// @brief How far the vertices of a coarse mesh are from the surfaces and curves they belong to.
struct VertexDistance {
  double largest = 0.0;    ///< Over all vertices on the geometry.
  LocalIndex num_off = 0;  ///< Vertices farther off than the entity's own tolerance.

  static auto fields(auto& self) { return std::tie(self.largest, self.num_off); }
};

/// @brief Moves vertices that are off their patch or curve by more than its tolerance onto it, and
/// measures what is left. Local.
///
/// A vertex moves only as far as the tets around it stay sound. A vertex between patches or at the
/// end of curves is measured only: no single projection says where it belongs.
/// @throws GeometryError if a projection fails.
VertexDistance snap_vertices(mesh::CoarseMesh& mesh, const model::Model& model);

}  // namespace tessera::coarse

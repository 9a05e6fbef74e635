// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::coarse {

// What turns the edges of a tet into the tangents at their ends, if added to their vectors. In the
// order of mesh::kTetEdgeCorners; nothing at edges inside.
using Turns = std::array<Vec3, 6>;

// The edges of a mesh that bow as they are on the geometry: each the circle through its ends and
// the point that refinement puts beside its middle.
class Arcs {
 public:
  // What cannot be projected counts as straight.
  Arcs(const mesh::CoarseMesh& mesh, const model::Model& model);

  // Vertices that came later have no arcs, nor has kNoIndex.
  [[nodiscard]] Turns of_tet(std::span<const LocalIndex, 4> tet) const;

 private:
  struct Arc {
    std::array<LocalIndex, 2> edge{};  // Ascending.
    Vec3 turn{};
  };

  std::vector<Arc> arcs_{};      // Ascending.
  std::vector<char> has_arc_{};  // Shape (num_vertices): those of the constructor's mesh.
};

// The least scaled Jacobian at a corner of a tet: that of the ways in which its edges begin there.
// 0.71 for a regular tet with straight edges.
[[nodiscard]] double least_jacobian(const std::array<Vec3, 4>& corners, const Turns& turns);

// The same of the triangle opposite to corner `c`, seen along its normal.
[[nodiscard]] double least_jacobian_of_face(const std::array<Vec3, 4>& corners, const Turns& turns,
                                            std::size_t c);

}  // namespace tessera::coarse

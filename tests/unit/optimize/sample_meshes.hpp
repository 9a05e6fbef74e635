// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/optimize/optimize.hpp"

namespace tessera::testing {

/// @brief The unit cube of 6 n^3 tets whose inner vertices are moved at random by up to `jitter`
/// cells along each axis, and back by halves where a tet would be flat: every tet is positive.
[[nodiscard]] optimize::TetMesh jittered_cube(int n, double jitter, unsigned seed);

/// @brief As above, but vertices stay where they were thrown: with a jitter of 1 many tets are
/// inverted.
[[nodiscard]] optimize::TetMesh tangled_cube(int n, double jitter, unsigned seed);

/// @brief The children (level 2) of the coarse tets of a kuhn_cube(n) whose shape is changed by
/// a smooth map: three similarity classes and flat octahedra, as the program's own pieces have
/// them.
[[nodiscard]] optimize::TetMesh subdivided_cube(int n);

[[nodiscard]] optimize::TetMesh one_tet();

/// @brief optimize::TetMesh::tet_neighbours of a mesh.
[[nodiscard]] std::vector<LocalIndex> neighbours_of(const std::vector<LocalIndex>& tet_vertices);

/// @brief What the tests compare.
struct MeshFigures {
  double volume = 0.0;
  double least_volume = 0.0;
  double least_mean_ratio = 0.0;
  double mean_mean_ratio = 0.0;
};

[[nodiscard]] MeshFigures figures_of(const std::vector<double>& vertex_xyz,
                                     const std::vector<LocalIndex>& tet_vertices);

/// @brief The boundary triangles by position, each turned so that its lowest corner comes first;
/// ascending. Equal boundaries give equal lists, bit by bit.
[[nodiscard]] std::vector<std::array<Vec3, 3>> boundary_of(
    const std::vector<double>& vertex_xyz, const std::vector<LocalIndex>& tet_vertices);

}  // namespace tessera::testing

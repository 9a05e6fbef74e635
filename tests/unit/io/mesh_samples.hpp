// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::testing {

/// @brief Kuhn cube of 6 n^3 tets with every kind of array, ids beyond 32 bits, and positions whose
/// last bits matter.
[[nodiscard]] mesh::MeshArrays sample_tets(int n);

/// @brief The boundary triangles of sample_tets(n), with patch and the tet behind.
[[nodiscard]] mesh::MeshArrays sample_triangles(int n);

/// @brief Fails the running test, saying which array differs, unless all are equal bit for bit.
void expect_same_bits(const mesh::MeshArrays& actual, const mesh::MeshArrays& expected);

}  // namespace tessera::testing

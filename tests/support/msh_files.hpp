// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::testing {

enum class MshForm { text22, binary22, text41, binary41 };
inline constexpr MshForm kMshForms[] = {MshForm::text22, MshForm::binary22, MshForm::text41,
                                        MshForm::binary41};

/// @brief A mesh as Gmsh writes it. Physical groups are the materials and, from 101, the patches,
/// with their names; entities are materials and, from 1, patches. Nodes count from 1, elements
/// too, faces first.
[[nodiscard]] std::string msh_text(const mesh::CoarseMesh& mesh, MshForm form);

/// @brief A mesh as NETGEN writes it; tets with NETGEN's orientation. Boundary conditions are the
/// patches from 1, with their names.
[[nodiscard]] std::string vol_text(const mesh::CoarseMesh& mesh);

}  // namespace tessera::testing

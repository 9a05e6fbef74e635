// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh_1.msh, mesh_2.msh, … in MSH 4.1, binary, a file for each piece: its cells on an
/// entity for each of its patches and materials, with those of the whole model as parents, and the
/// ghosts of the piece on a ghost entity, as Gmsh itself splits meshes.
[[nodiscard]] std::unique_ptr<Writer> make_msh_parts_writer(const WriterTarget& target);

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh.msh in MSH 4.1, binary, one file for all ranks. All nodes are on one volume entity,
/// and right behind the entities, where PETSc looks for them; cells are in one block for each patch
/// and each material.
[[nodiscard]] std::unique_ptr<Writer> make_msh_writer(const WriterTarget& target);

}  // namespace tessera::formats

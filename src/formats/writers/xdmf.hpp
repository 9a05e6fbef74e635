// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh.h5, one file for all ranks, and indices of it: mesh.xdmf has both grids, which
/// DOLFINx wants; tets.xdmf and boundary.xdmf have one each, as meshio takes no more. The names of
/// its arrays are those that PETSc's reader of XDMF's layout looks for; all arrays have two
/// dimensions, as DOLFINx wants.
[[nodiscard]] std::unique_ptr<Writer> make_xdmf_writer(const WriterTarget& target);

}  // namespace tessera::formats

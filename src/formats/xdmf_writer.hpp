// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh.xdmf, boundary.xdmf and mesh.h5, one file for all ranks. The names of its arrays are
/// those that PETSc's reader of XDMF's layout looks for; all arrays have two dimensions, as DOLFINx
/// wants.
[[nodiscard]] std::unique_ptr<Writer> make_xdmf_writer(const WriterTarget& target);

}  // namespace tessera::formats

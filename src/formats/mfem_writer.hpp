// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh.000000, mesh.000001, …: one file a piece, each read by one rank of MFEM's ParMesh.
/// @pre pieces have their shared edges.
[[nodiscard]] std::unique_ptr<Writer> make_mfem_writer(const WriterTarget& target);

}  // namespace tessera::formats

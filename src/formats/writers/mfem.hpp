// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief Where names of materials and patches stand in files of MFEM.
enum class MfemNames {
  comments,  ///< Version 1.2, mesh.000000, ….
  sets,      ///< Version 1.3, mesh_sets.000000, …: a set of attributes for each name.
};

/// @brief One file a piece, each read by one rank of MFEM's ParMesh.
/// @pre pieces have their shared edges.
[[nodiscard]] std::unique_ptr<Writer> make_mfem_writer(const WriterTarget& target, MfemNames names);

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief A case of OpenFOAM for one process, constant/polyMesh, which all ranks write: every piece
/// has the faces that its tets own, and their places are known from the counts alone.
/// @throws ConfigError if the mesh has too many faces for labels of 32 bits.
[[nodiscard]] std::unique_ptr<Writer> make_openfoam_serial_writer(const WriterTarget& target);

}  // namespace tessera::formats

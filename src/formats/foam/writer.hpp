// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief A case of OpenFOAM that is decomposed already: processorN/constant/polyMesh, one a piece.
/// @throws ConfigError if a piece has too many faces for labels of 32 bits.
[[nodiscard]] std::unique_ptr<Writer> make_openfoam_writer(const WriterTarget& target);

}  // namespace tessera::formats

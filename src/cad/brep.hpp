// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "cad/cad_file.hpp"

namespace tessera::cad {

/// @brief Reads a BREP file, text or binary. A text without a root shape is read if its last shape
/// is a solid; that counts as a repair. Local.
/// @throws InputError if it is truncated or no BREP file.
[[nodiscard]] CadFile read_brep(const std::filesystem::path& file);

}  // namespace tessera::cad

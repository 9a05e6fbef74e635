// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tessera/io/options.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::io {

// The two ways of write_vtu(). @pre The arrays of the piece fit together.

/// @brief Writes the arrays as they are. @throws OutputError
void write_plain_vtu(const mesh::MeshArrays& piece, const std::filesystem::path& path);

/// @brief Whether this build has VTK, which compresses.
[[nodiscard]] bool can_compress();

/// @brief Writes them with VTK, compressed. @pre can_compress() @throws OutputError
void write_compressed_vtu(const mesh::MeshArrays& piece, const std::filesystem::path& path,
                          Compression compression);

}  // namespace tessera::io

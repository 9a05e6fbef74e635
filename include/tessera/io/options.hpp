// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::io {

/// @brief How the arrays of mesh files are packed.
enum class Compression : int { none, lz4, zlib };

/// @brief Options of the output; table `[output]` of a case file.
struct OutputOptions {
  std::filesystem::path directory{};  ///< Relative to the working directory.
  std::vector<std::string> formats{"pvtu"};
  Compression compression = Compression::lz4;
  LocalIndex files = 0;       ///< Number of piece files; 0: one for each subdomain.
  LocalIndex parts = 0;       ///< Number of balanced, connected parts, a file each; 0: see `files`.
  bool cell_quality = false;  ///< Also write the mean ratio of every tet.

  friend bool operator==(const OutputOptions&, const OutputOptions&) = default;
};

}  // namespace tessera::io

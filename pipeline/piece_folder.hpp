// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace tessera::pipeline {

/// @brief Where finished pieces wait until they are written; inside the output folder.
[[nodiscard]] inline std::filesystem::path piece_folder(const std::filesystem::path& output)
{
  return output / "pieces";
}

}  // namespace tessera::pipeline

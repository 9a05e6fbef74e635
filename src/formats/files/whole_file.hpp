// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "formats/files/shared_file.hpp"

namespace tessera::formats {

/// @brief Writes a file of one piece, so that it appears under its name when it is complete. What a
/// killed writer has left of it is replaced: its temporary name is always the same. Local.
/// @throws OutputError naming the file.
inline void write_whole_file(const std::filesystem::path& path, std::string_view bytes)
{
  SharedFile file(path);
  file.create();
  file.write(0, bytes);
  file.close();
  file.commit();
}

}  // namespace tessera::formats

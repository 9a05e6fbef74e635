// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace tessera::io {

/// @brief Writes a text file so that it appears under its final name only when complete. Local.
///
/// The text goes to a temporary file in the same folder, which is then renamed; an older file of
/// that name is replaced.
/// @throws OutputError naming the file and the cause; the temporary file is removed.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

/// @brief Makes a folder, with its parents, or takes the one that is there. Local.
/// @throws OutputError naming the folder: it cannot be made, or it is a symbolic link, which may
/// lead out of the output folder.
void make_own_folder(const std::filesystem::path& folder);

}  // namespace tessera::io

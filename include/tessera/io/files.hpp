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

}  // namespace tessera::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tessera/base/bytes.hpp"

namespace tessera::io {

/// @brief All bytes of a file that the run itself has written. Local.
/// @throws OutputError naming the file and the cause.
[[nodiscard]] Bytes read_back(const std::filesystem::path& path);

}  // namespace tessera::io

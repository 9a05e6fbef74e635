// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tessera::pipeline {

/// @brief Where three.js is looked for: what the environment variable TESSERA_THREE_JS names, else
/// what was packed with the program, else the file of Debian's package libjs-three. Local.
[[nodiscard]] std::filesystem::path three_js_file();

/// @brief three.js as text for a page: deflated, in base64. Nothing if the file is not there.
/// Local.
[[nodiscard]] std::optional<std::string> packed_three_js();

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "tessera/model/stl_file.hpp"

namespace tessera::model {

/// @brief Reads the text of an ASCII STL file with any number of solids. Keywords in any case.
/// @param name  What error messages call the file.
/// @throws InputError as read_stl() does.
[[nodiscard]] TriangleSoup parse_ascii_stl(std::string_view text, const std::string& name);

}  // namespace tessera::model

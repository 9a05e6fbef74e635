// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "formats/link/link_pieces.hpp"

namespace tessera::formats {

/// @brief Gives materials and patches tags from 1, with names: materials in the order of their
/// values, patches of one name together. Sets the names, and the tags of the counts. Local.
/// @param[in,out] outline Its counts have the values of files as tags.
[[nodiscard]] Tags name_tags(const FileNames& names, Outline& outline);

}  // namespace tessera::formats

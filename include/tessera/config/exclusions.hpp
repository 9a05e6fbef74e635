// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "tessera/config/case.hpp"

/// What of a case cannot be had together, where not only the case says what there is.
namespace tessera::config {

/// @brief What of the case faces and lines inside of solids exclude, in its own words, as
/// `coarse.mesher = "gmsh"`; empty: nothing. What is excluded would make the surface without them.
/// Local.
[[nodiscard]] std::string_view excluded_by_inner_faces(const Case& given);

/// @brief What lines inside of solids exclude besides: they would have to go on through layers.
/// Local.
[[nodiscard]] std::string_view excluded_by_inner_lines(const Case& given);

}  // namespace tessera::config

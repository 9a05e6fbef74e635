// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/config/exclusions.hpp"

namespace tessera::config {

std::string_view excluded_by_inner_faces(const Case& given)
{
  if (given.coarse.mesher == surface::Mesher::gmsh) return "coarse.mesher = \"gmsh\"";
  if (given.decompose.method == decompose::Method::geometry)
    return "decompose.method = \"geometry\"";
  return {};
}

std::string_view excluded_by_inner_lines(const Case& given)
{
  return given.layers.empty() ? "" : "[[layer]]";
}

}  // namespace tessera::config

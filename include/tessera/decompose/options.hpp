// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"

namespace tessera::decompose {

/// @brief What is cut into subdomains.
enum class Method : int {
  mesh,      ///< The coarse mesh.
  geometry,  ///< The model, by planes, before it is meshed; then the coarse mesh of each part.
};
[[nodiscard]] constexpr Method last_value(Method /*type*/) { return Method::geometry; }

/// @brief Words of the method in case files and reports.
constexpr auto enum_words(Method /*tag*/)
{
  return std::to_array<EnumWord<Method>>({
      {Method::mesh, "mesh"},
      {Method::geometry, "geometry"},
  });
}

/// @brief Options of the decomposition; table `[decompose]` of a case file.
struct DecomposeOptions {
  Method method = Method::mesh;
  /// Wanted number of subdomains, >= 1; 0 stands for "auto". A request: at least one a material, at
  /// most one a coarse tet, and repair may split further.
  LocalIndex subdomains = 0;
  LocalIndex least = 1;  ///< "auto" gives no fewer, if there are as many coarse tets.
  LocalIndex parts = 0;  ///< output.parts: parts that consist of whole subdomains; 0: none.

  friend bool operator==(const DecomposeOptions&, const DecomposeOptions&) = default;
};

}  // namespace tessera::decompose

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"

namespace tessera::decompose {

/// @brief What is cut into subdomains, and how.
enum class Method : int {
  mesh,      ///< The coarse mesh, by METIS.
  geometry,  ///< The model, by planes, before it is meshed; then the coarse mesh of each part.
  octree,    ///< The coarse mesh, in runs of octants along a space curve.
};
[[nodiscard]] constexpr Method last_value(Method /*type*/) { return Method::octree; }

/// @brief Words of the method in case files and reports.
constexpr auto enum_words(Method /*tag*/)
{
  return std::to_array<EnumWord<Method>>({
      {Method::mesh, "mesh"},
      {Method::geometry, "geometry"},
      {Method::octree, "octree"},
  });
}

/// @brief "auto" asks for so many predicted fine tets a subdomain: a job fills them in some tenths
/// of a second. More subdomains have more seams, which cost as much again; fewer leave ranks
/// without work. On screw.step (size 0.5, 233 k tets) 8 subdomains took half of the time of 33, at
/// a mean of the mean ratio of 0.896 and 0.895.
inline constexpr double kAutoTets = 5e4;

/// @brief "auto" asks for at least so many subdomains, if there are as many coarse tets: for as
/// many ranks there is work then.
inline constexpr LocalIndex kLeastAutoSubdomains = 8;

/// @brief Options of the decomposition; table `[decompose]` of a case file.
struct DecomposeOptions {
  Method method = Method::mesh;
  /// Wanted number of subdomains, >= 1; 0 stands for "auto". A request: at least one a material, at
  /// most one a coarse tet, and repair may split further.
  LocalIndex subdomains = 0;
  /// Of "auto": predicted fine tets a subdomain, > 0, and the least number of subdomains.
  double tets_a_subdomain = kAutoTets;
  LocalIndex least = kLeastAutoSubdomains;
  LocalIndex parts = 0;  ///< output.parts: parts that consist of whole subdomains; 0: none.

  friend bool operator==(const DecomposeOptions&, const DecomposeOptions&) = default;
};

}  // namespace tessera::decompose

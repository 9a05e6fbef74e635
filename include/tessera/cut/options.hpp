// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"
#include "tessera/cut/cut_tree.hpp"

namespace tessera::cut {

/// @brief By which rule planes are chosen.
enum class PlaneRule : int {
  clear,  ///< The best of many: balanced, clear of features, at large angles, of little area.
  pca,    ///< Through the centre of mass, across the longest axis of inertia.
};
[[nodiscard]] constexpr PlaneRule last_value(PlaneRule /*type*/) { return PlaneRule::pca; }

/// @brief Words of the rule in case files and reports.
constexpr auto enum_words(PlaneRule /*tag*/)
{
  return std::to_array<EnumWord<PlaneRule>>({
      {PlaneRule::clear, "clear"},
      {PlaneRule::pca, "pca"},
  });
}

/// @brief Into what planes cut a model, and by which rule.
struct CutOptions {
  PlaneRule rule = PlaneRule::clear;
  LocalIndex parts = 1;        ///< Wanted number of parts, >= 1; each solid has at least one.
  double coarse_size = 0.0;    ///< Edge length of the coarse mesh, file length unit, > 0.
  std::vector<Plane> given{};  ///< Cut every part that they cross, in this order, before the rule.

  static auto fields(auto& self)
  {
    return std::tie(self.rule, self.parts, self.coarse_size, self.given);
  }

  friend bool operator==(const CutOptions&, const CutOptions&) = default;
};

/// @brief A plane that the user gives; table `[[decompose.plane]]` of a case file.
struct GivenPlane {
  Vec3 point = kNoPoint;   ///< On the plane, output length unit.
  Vec3 normal = kNoPoint;  ///< Of any length but 0.

  friend bool operator==(const GivenPlane&, const GivenPlane&) = default;
};

/// @brief What a case says of the planes that cut the model; keys of its table `[decompose]`.
struct PlaneSettings {
  PlaneRule rule = PlaneRule::clear;
  std::vector<GivenPlane> given{};

  friend bool operator==(const PlaneSettings&, const PlaneSettings&) = default;
};

/// @brief What is wrong with a plane whose keys have values that are right one by one; empty if
/// nothing is. Local.
[[nodiscard]] inline std::string defect_of(const GivenPlane& plane)
{
  return plane.normal == Vec3{} ? "normal must not be zero" : "";
}

}  // namespace tessera::cut

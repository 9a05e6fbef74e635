// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::model {

// What faces or solids must have to get a name. All that is given must hold; defaults stand for
// "not given". Lengths are in the output length unit.

/// @brief Faces by what `tessera info` lists of them.
struct FaceCriteria {
  std::vector<LocalIndex> faces{};  ///< FaceDescription::number.
  std::string pattern{};            ///< Of the name in the file, see matches_pattern().
  std::string colour{};             ///< "#RRGGBB".
  Vec3 normal = kNoPoint;           ///< Of all triangles, out of the solid; of any length but 0.
  double tolerance_deg = 0.0;       ///< Of the normal, in (0, 90]; 0: kNormalTolerance_deg.
  Vec3 box_min = kNoPoint;          ///< All triangles lie in that box.
  Vec3 box_max = kNoPoint;

  friend bool operator==(const FaceCriteria&, const FaceCriteria&) = default;
};

/// @brief Solids by what `tessera info` lists of them.
struct SolidCriteria {
  std::vector<LocalIndex> solids{};  ///< From 1.
  std::string pattern{};             ///< Of the name in the file, see matches_pattern().
  Vec3 box_min = kNoPoint;           ///< All triangles lie in that box.
  Vec3 box_max = kNoPoint;

  friend bool operator==(const SolidCriteria&, const SolidCriteria&) = default;
};

/// @brief A plane's triangles are off its normal by rounding only, and neighbours of a face that
/// was chosen are most often off by much more.
inline constexpr double kNormalTolerance_deg = 5.0;

/// @brief A name for faces (patches of the mesh) or solids (its materials); table
/// `[[geometry.name]]` of a case file.
struct PartName {
  std::string name{};
  std::variant<FaceCriteria, SolidCriteria> of{};

  friend bool operator==(const PartName&, const PartName&) = default;
};

/// @brief With its dot, in lower case. Local.
[[nodiscard]] std::string lower_case_extension(const std::filesystem::path& file);

/// @brief Whether a file's name is that of a tet mesh, which then is the coarse mesh: .msh, .vol or
/// .vtu, in lower or upper case. The file need not exist. Local.
[[nodiscard]] bool is_mesh_name(const std::filesystem::path& file);

/// @brief What is wrong with criteria whose values are right one by one; empty if nothing is.
/// Local.
[[nodiscard]] std::string defect_of(const PartName& name);

}  // namespace tessera::model

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tessera/surface/patch_surface.hpp"

namespace tessera::surface {

/// @brief One patch of a surface by itself, to be edited beside the others. What it shares with
/// them is its rim, whose vertices are fixed.
struct PatchPart {
  PatchSurface surface{};            ///< Its first vertices are those of the rim.
  std::vector<LocalIndex> rim{};     ///< Their numbers in the whole, ascending.
  std::vector<LocalIndex> inside{};  ///< Those of the other vertices.
};

/// @brief A part for each patch that has triangles, in their order. Local.
///
/// On the rim are vertices of curves and of several patches, and those that are fixed.
[[nodiscard]] std::vector<PatchPart> patch_parts_of(const PatchSurface& whole);

/// @brief Surfaces that took the place of patches, together again.
struct JoinedPatches {
  PatchSurface surface{};
  std::vector<char> is_edited{};  ///< Of each patch: whether it is as it was edited.
};

/// @brief Puts the edited part of each patch in its place. Local.
///
/// Parts know nothing of each other, so two of them may have got the same edge between vertices of
/// their rims, or the same triangle: these stay as they were. So does one that has got an edge
/// which is one of a curve elsewhere, or has not kept its rim.
/// @param[in] parts  patch_parts_of(whole).
/// @param[in] edited  What has become of each; nothing if it was not edited. The vertices of the
/// rim come first and in their order, where they were, and edges of curves are as they were.
[[nodiscard]] JoinedPatches join_patches(const PatchSurface& whole,
                                         const std::vector<PatchPart>& parts,
                                         const std::vector<std::optional<PatchSurface>>& edited);

}  // namespace tessera::surface

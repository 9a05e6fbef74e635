// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tessera/formats/piece.hpp"

#include "formats/foam_faces.hpp"

/// What the processors' meshes and the serial mesh of an OpenFOAM case have in common.
namespace tessera::formats {

/// @brief A patch of faces with one tet.
struct FoamPatch {
  std::string name{};
  std::int32_t tag = 0;  ///< Of outline.patch_names; kNoPatchTag: faces that are in no patch.
};

/// @brief Names of a case, each a word that OpenFOAM can read, none twice among its like.
struct FoamCase {
  std::vector<FoamPatch> patches{};  ///< With a face in some piece; the others would need values.
  std::vector<std::string> zones{};  ///< Of the materials 1, 2, …
};

/// @brief Local.
[[nodiscard]] FoamCase foam_case(const Outline& outline);

/// @brief Outer triangles of a patch in a piece, or its faces without a patch. Local.
[[nodiscard]] GlobalIndex num_patch_faces(const PieceCounts& piece, std::int32_t tag);

/// @brief Faces with both tets in the piece. Local.
[[nodiscard]] GlobalIndex num_inner_faces(const PieceCounts& piece);

/// @brief The most faces of one mesh: its lists have indices of 32 bits into their corners.
inline constexpr GlobalIndex kMaxFoamFaces = INT32_MAX / 3;

/// @brief Writes controlDict, fvSchemes and fvSolution as checkMesh and laplacianFoam need them;
/// keeps those that are there. One process. @throws OutputError
void write_foam_system(const std::filesystem::path& folder);

/// @brief Writes decomposeParDict, without which nothing runs in parallel; keeps one that is there,
/// unless it is ours. One process. @throws OutputError
void write_foam_decomposition(const std::filesystem::path& folder, LocalIndex num_processors);

}  // namespace tessera::formats

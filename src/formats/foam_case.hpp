// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
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

/// @brief Where the share of each piece begins in an array of the whole mesh.
class Places {
 public:
  Places(const Outline& outline, GlobalIndex begin,
         const std::function<GlobalIndex(LocalIndex piece)>& count_of)
      : begins_{begin}
  {
    for (LocalIndex piece = 0; piece < outline.num_pieces(); ++piece)
      begins_.push_back(begins_.back() + count_of(piece));
  }

  [[nodiscard]] GlobalIndex of(LocalIndex piece) const { return begins_[at(piece)]; }
  [[nodiscard]] GlobalIndex begin() const { return begins_.front(); }
  [[nodiscard]] GlobalIndex end() const { return begins_.back(); }
  [[nodiscard]] GlobalIndex size() const { return end() - begin(); }

 private:
  std::vector<GlobalIndex> begins_;
};

/// @brief Where the faces of the pieces stand in the serial mesh.
struct FoamLayout {
  FoamCase names{};
  Places inner;                   ///< Faces between two tets, in the piece of the lower one.
  std::vector<Places> patches{};  ///< Of names.patches.

  [[nodiscard]] GlobalIndex num_faces() const
  {
    return patches.empty() ? inner.end() : patches.back().end();
  }
};

/// @brief Local.
[[nodiscard]] FoamLayout foam_layout(const Outline& outline);

/// @brief The most faces of one mesh: its lists have indices of 32 bits into their corners.
inline constexpr GlobalIndex kMaxFoamFaces = INT32_MAX / 3;

/// @brief Writes controlDict, fvSchemes and fvSolution as checkMesh and laplacianFoam need them;
/// keeps those that are there. One process. @throws OutputError
void write_foam_system(const std::filesystem::path& folder);

/// @brief Writes decomposeParDict, without which nothing runs in parallel; keeps one that is there,
/// unless it is ours. One process. @throws OutputError
void write_foam_decomposition(const std::filesystem::path& folder, LocalIndex num_processors);

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tessera/formats/piece.hpp"

#include "formats/foam/faces.hpp"
#include "formats/foam/text.hpp"

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

/// @brief Faces of a patch in a piece with no second cell, or those without a patch. Local.
[[nodiscard]] FaceCount foam_patch_count(const Outline& outline, LocalIndex piece,
                                         std::int32_t tag);

/// @brief Cells of a material in a piece. Local.
[[nodiscard]] GlobalIndex foam_zone_count(const Outline& outline, LocalIndex piece,
                                          std::int32_t tag);

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
  [[nodiscard]] LocalIndex piece_with(GlobalIndex place) const
  {
    const auto behind = std::ranges::upper_bound(begins_, place);
    return static_cast<LocalIndex>(behind - begins_.begin()) - 1;
  }
  [[nodiscard]] GlobalIndex begin() const { return begins_.front(); }
  [[nodiscard]] GlobalIndex end() const { return begins_.back(); }
  [[nodiscard]] GlobalIndex size() const { return end() - begin(); }

 private:
  std::vector<GlobalIndex> begins_;
};

/// @brief Where the faces of one kind stand, and their corners.
struct FacePlaces {
  Places faces;
  Places corners;
};

/// @brief Where the faces of the pieces stand in the serial mesh.
struct FoamLayout {
  FoamCase names{};
  FacePlaces inner;                   ///< Between two cells, in the piece of the lower one.
  std::vector<FacePlaces> patches{};  ///< Of names.patches.

  [[nodiscard]] const FacePlaces& last() const { return patches.empty() ? inner : patches.back(); }
  [[nodiscard]] GlobalIndex num_faces() const { return last().faces.end(); }
  [[nodiscard]] GlobalIndex num_corners() const { return last().corners.end(); }
};

/// @brief What the file `boundary` says of a patch beside its faces. Local.
/// @param[in] row Of outline's FoamCase::patches.
[[nodiscard]] FoamBoundary foam_patch_entry(const Outline& outline, const FoamCase& names,
                                            std::size_t row);

/// @brief Local.
[[nodiscard]] FoamLayout foam_layout(const Outline& outline);

/// @brief The most corners that the faces of one mesh have: its lists have indices of 32 bits into
/// them.
inline constexpr GlobalIndex kMaxFoamCorners = INT32_MAX;

/// @brief Writes controlDict, fvSchemes and fvSolution as checkMesh and laplacianFoam need them;
/// keeps those that are there. One process. @throws OutputError
void write_foam_system(const std::filesystem::path& folder);

/// @brief Writes decomposeParDict, without which nothing runs in parallel; keeps one that is there,
/// unless it is ours. One process. @throws OutputError
void write_foam_decomposition(const std::filesystem::path& folder, LocalIndex num_processors);

}  // namespace tessera::formats

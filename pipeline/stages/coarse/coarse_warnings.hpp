// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "tessera/coarse/sharp_tets.hpp"

#include "pipeline/stages/coarse/coarse_stage.hpp"

/// What a run says of its coarse mesh, in its log and in its report. All functions are local.
namespace tessera::pipeline {

/// @brief Coarse tets with a smaller angle than this are named.
inline constexpr double kSharpAngle_deg = 5.0;

/// @brief What to say if coarse tets are below kSharpAngle_deg that no sharp angle of the model
/// forces.
[[nodiscard]] std::optional<std::string> sharp_warning(const coarse::SharpTets& sharp);

/// @brief What to say if no finer coarse mesh could be made for the wanted sizes.
[[nodiscard]] std::optional<std::string> size_warning(const CoarseResult& coarse);

/// @brief Whether edges are so much too long for it that the sizes count as missed.
[[nodiscard]] bool misses_sizes(const CoarseResult& coarse);

/// @brief So many of the faces and edges that were merged are named.
inline constexpr std::size_t kMostMergedNamed = 20;

/// @brief The name of a face that was merged; empty if it has none left.
[[nodiscard]] std::string name_of_merged_face(LocalIndex face, const mesh::CoarseMesh& mesh);

/// @brief What to say of what was merged.
[[nodiscard]] std::string defeatured_words(const CoarseResult& coarse);

}  // namespace tessera::pipeline

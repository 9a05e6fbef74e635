// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "pipeline/stages/coarse_stage.hpp"

namespace tessera::pipeline {

/// @brief What to say if no finer coarse mesh could be made for the wanted sizes. Local.
[[nodiscard]] std::optional<std::string> size_warning(const CoarseResult& coarse);

/// @brief Whether edges are so much too long for it that the sizes count as missed. Local.
[[nodiscard]] bool misses_sizes(const CoarseResult& coarse);

}  // namespace tessera::pipeline

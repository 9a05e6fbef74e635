// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/description.hpp"

#include "pipeline/drawing/png.hpp"

namespace tessera::pipeline {

/// @brief Draws a model from two opposite sides, each face in a colour and with its number where
/// there is room. Needs no display and no graphics library. Local.
/// @pre model.require_sound() does not throw.
[[nodiscard]] Picture draw_model(const model::ModelDescription& model);

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/model/description.hpp"
#include "tessera/model/model.hpp"

namespace tessera::pipeline {

/// @brief The page of a model before anything is meshed: to turn it, to point at faces and edges,
/// to see what is short or narrow, and to try sizes. It needs nothing from outside. Local.
/// @pre description.require_sound() does not throw.
[[nodiscard]] std::string model_page(const model::ModelSource& source,
                                     const model::ModelDescription& description);

}  // namespace tessera::pipeline

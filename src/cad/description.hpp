// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/description.hpp"

#include "cad/content.hpp"

namespace tessera::cad {

/// @brief What a shape holds. Faces have the numbers of parts_of(), from 1; areas and volumes are
/// those of the shape itself, not of the triangles. Local.
[[nodiscard]] model::ModelDescription describe_shape(const OccContent& content);

}  // namespace tessera::cad

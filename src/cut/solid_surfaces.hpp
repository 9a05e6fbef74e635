// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/model/description.hpp"

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// The surface of a solid, ready to be cut.
struct SolidSurface {
  PartSurface surface{};
  std::string unfit_because{};  ///< Why it must not be cut; empty if it may.
};

/// @brief The surfaces of a model's solids. Points that faces share become one. Points and
/// triangles are sorted by position, so the result does not depend on their order in the model.
/// @return Shape (number of solids).
[[nodiscard]] std::vector<SolidSurface> solid_surfaces(const model::ModelDescription& model,
                                                       double coarse_size);

}  // namespace tessera::cut

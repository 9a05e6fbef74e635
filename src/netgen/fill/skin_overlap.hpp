// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/fill/kernel.hpp"

namespace tessera::netgen {

/// @brief Whether triangles of a skin that share no edge cut each other. Local.
[[nodiscard]] bool cuts_itself(const fill::FillInput& skin);

}  // namespace tessera::netgen

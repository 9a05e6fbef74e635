// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tessera/model/model.hpp"

namespace tessera::netgen {

/// @brief Of what kind a CAD file is, by its extension. Local. @throws InputError if of none.
[[nodiscard]] model::Format format_of(const std::filesystem::path& file);

/// @brief Refuses a kind of CAD file that this build cannot read. Local. @throws ConfigError
void require_reader(model::Format format);

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/model/assembly.hpp"

#include "netgen/occ_cad_file.hpp"

namespace tessera::netgen {

/// @brief Keeps solids of `cad.shape` apart that share faces and are in contact: each gets faces of
/// its own there, with edges and vertices of its own. An edge or vertex stays one if a third solid
/// has it that is in contact with neither. Names follow, and `cad.repairs` says what was done.
/// @throws ConfigError if one of a contact's names fits no solid.
void keep_apart(const std::vector<model::Contact>& contacts, CadFile& cad);

}  // namespace tessera::netgen

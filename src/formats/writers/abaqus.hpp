// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh.inp, text for CalculiX and Abaqus. A material is an element set, a patch a surface
/// of sides of elements, and a set of nodes. Fields have 20 characters, as CalculiX reads no more.
/// @throws ConfigError if numbers of 32 bits are not enough.
[[nodiscard]] std::unique_ptr<Writer> make_abaqus_writer(const WriterTarget& target);

}  // namespace tessera::formats

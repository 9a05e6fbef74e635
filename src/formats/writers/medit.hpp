// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh.mesh, text as Medit has it. References are tags. Names of tags are comments behind
/// its end: the format has no place for them.
/// @throws ConfigError if numbers of 32 bits are not enough.
[[nodiscard]] std::unique_ptr<Writer> make_medit_writer(const WriterTarget& target);

}  // namespace tessera::formats

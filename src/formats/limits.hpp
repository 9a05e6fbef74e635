// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief For formats whose readers count points and cells with 32 bits. Local.
/// @throws ConfigError saying how many there are, how many the format can have, and which one can.
void require_32_bit_numbers(const Outline& outline, io::Format format);

}  // namespace tessera::formats

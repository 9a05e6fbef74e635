// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh_v2.msh in MSH 2.2, text, one file for all ranks, with numbers in columns of fixed
/// width. Binary files of this version are shorter, but GetFEM and gmshToFoam read none.
/// @throws ConfigError if there are more elements than numbers of 32 bits.
[[nodiscard]] std::unique_ptr<Writer> make_msh2_writer(const WriterTarget& target);

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief Elmer's partitioning.N/part.n.*, n from 1, and mesh.names.
/// @throws ConfigError if the mesh has more than integers of 32 bits can count.
[[nodiscard]] std::unique_ptr<Writer> make_elmer_writer(const WriterTarget& target);

}  // namespace tessera::formats

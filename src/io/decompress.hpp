// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tessera::io {

/// @brief One compressed block and the place for its content, whose size is known.
struct CompressedBlock {
  std::span<const std::byte> from{};
  std::span<std::byte> to{};
};

/// @brief Fills every `to`. @param compressor VTK's name, e.g. "vtkLZ4DataCompressor".
/// @throws InputError if the compressor is not known or a block does not give its size.
void decompress(const std::string& compressor, const std::vector<CompressedBlock>& blocks);

}  // namespace tessera::io

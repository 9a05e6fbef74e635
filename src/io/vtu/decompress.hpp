// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/bytes.hpp"

namespace tessera::io {

/// @brief One compressed block and the size that its content should have.
struct CompressedBlock {
  std::span<const std::byte> from{};
  std::size_t size = 0;
};

/// @brief Contents of the blocks, one behind the other. The memory for a block is taken when those
/// before it have given their sizes. @param compressor VTK's name, e.g. "vtkLZ4DataCompressor".
/// @throws InputError if the compressor is not known or a block does not give its size.
[[nodiscard]] Bytes decompress(const std::string& compressor,
                               const std::vector<CompressedBlock>& blocks);

}  // namespace tessera::io

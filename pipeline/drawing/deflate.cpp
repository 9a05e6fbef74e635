// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/deflate.hpp"

#include <zlib.h>

namespace tessera::pipeline {

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& data)
{
  auto size = compressBound(data.size());
  std::vector<std::uint8_t> packed(size);
  compress2(packed.data(), &size, data.data(), data.size(), Z_DEFAULT_COMPRESSION);
  packed.resize(size);
  return packed;
}

}  // namespace tessera::pipeline

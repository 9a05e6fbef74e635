// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/deflate.hpp"

#include <zlib.h>

namespace tessera::pipeline {

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& data)
{
  auto size = compressBound(data.size());
  std::vector<std::uint8_t> packed(size);
  // The default takes a tenth of a second for the pictures of a run; files are 9 % smaller with it.
  constexpr int kFast = 3;
  compress2(packed.data(), &size, data.data(), data.size(), kFast);
  packed.resize(size);
  return packed;
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/viewer/packed_arrays.hpp"

#include "pipeline/drawing/deflate.hpp"
#include "pipeline/report/html.hpp"

namespace tessera::pipeline {
namespace {

constexpr unsigned kBits = 8;

// Of a difference modulo 2^(8 width): its sign goes to the lowest bit.
std::uint32_t folded(std::uint32_t difference, std::size_t width)
{
  const unsigned shift = 32U - kBits * static_cast<unsigned>(width);
  const std::uint32_t value = difference << shift;  // The sign is the highest bit now.
  const std::uint32_t sign = (value >> 31U) != 0U ? ~0U : 0U;
  return ((value << 1U) ^ sign) >> shift;
}

}  // namespace

void PackedArrays::add(const std::string& name, std::size_t width,
                       std::span<const std::uint32_t> values)
{
  layout_.push_back({{"name", name}, {"width", width}, {"size", values.size()}});
  const std::size_t begin = bytes_.size();
  bytes_.resize(begin + width * values.size());
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t code = folded(values[i] - last, width);
    last = values[i];
    for (std::size_t plane = 0; plane < width; ++plane) {
      bytes_[begin + plane * values.size() + i] =
          static_cast<std::uint8_t>(code >> (kBits * static_cast<unsigned>(plane)));
    }
  }
}

std::string PackedArrays::text() const
{
  const std::vector<std::uint8_t> packed = deflated(bytes_);
  return base64(std::as_bytes(std::span(packed)));
}

}  // namespace tessera::pipeline

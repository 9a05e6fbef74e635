// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/png.hpp"

#include <algorithm>
#include <span>
#include <string_view>

namespace tessera::pipeline {
namespace {

using Octets = std::vector<std::uint8_t>;

void put_32(Octets& out, std::uint32_t value)
{
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::uint32_t crc_of(std::span<const std::uint8_t> octets)
{
  std::uint32_t crc = 0xffffffffU;
  for (const std::uint8_t octet : octets) {
    crc ^= octet;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0U ? 0xedb88320U : 0U);
  }
  return ~crc;
}

std::uint32_t adler_of(std::span<const std::uint8_t> octets)
{
  constexpr std::uint32_t kModulus = 65521;
  std::uint32_t low = 1;
  std::uint32_t high = 0;
  for (const std::uint8_t octet : octets) {
    low = (low + octet) % kModulus;
    high = (high + low) % kModulus;
  }
  return (high << 16U) | low;
}

void put_chunk(Octets& out, std::string_view kind, const Octets& data)
{
  put_32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = out.size();
  out.insert(out.end(), kind.begin(), kind.end());
  out.insert(out.end(), data.begin(), data.end());
  put_32(out, crc_of(std::span(out).subspan(begin)));
}

// A zlib stream of blocks that are stored as they are (RFC 1950, RFC 1951).
Octets stored(const Octets& data)
{
  constexpr std::size_t kLargestBlock = 65535;
  Octets out{0x78, 0x01};
  for (std::size_t begin = 0; begin < data.size(); begin += kLargestBlock) {
    const std::size_t size = std::min(kLargestBlock, data.size() - begin);
    const auto length = static_cast<std::uint16_t>(size);
    const auto inverse = static_cast<std::uint16_t>(~length);
    out.push_back(begin + size == data.size() ? 1 : 0);
    for (const std::uint16_t word : {length, inverse}) {
      out.push_back(static_cast<std::uint8_t>(word & 0xffU));
      out.push_back(static_cast<std::uint8_t>(word >> 8U));
    }
    const auto first = data.begin() + static_cast<std::ptrdiff_t>(begin);
    out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(size));
  }
  put_32(out, adler_of(data));
  return out;
}

// Each row begins with the number of its filter: none.
Octets rows_of(const Picture& picture)
{
  Octets rows;
  const auto width = static_cast<std::ptrdiff_t>(picture.width);
  for (auto row = picture.pixels.begin(); row != picture.pixels.end(); row += width) {
    rows.push_back(0);
    rows.insert(rows.end(), row, row + width);
  }
  return rows;
}

}  // namespace

Bytes to_png(const Picture& picture)
{
  Octets out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Octets head;
  put_32(head, static_cast<std::uint32_t>(picture.width));
  put_32(head, static_cast<std::uint32_t>(picture.height));
  head.insert(head.end(), {8, 3, 0, 0, 0});  // 8 bits, palette, no interlacing.
  put_chunk(out, "IHDR", head);
  Octets palette;
  for (const auto& colour : picture.palette) {
    palette.insert(palette.end(), colour.begin(), colour.end());
  }
  put_chunk(out, "PLTE", palette);
  put_chunk(out, "IDAT", stored(rows_of(picture)));
  put_chunk(out, "IEND", {});
  const auto* const first = reinterpret_cast<const std::byte*>(out.data());
  return {first, first + out.size()};
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/png.hpp"

#include <span>
#include <string_view>

#include <zlib.h>

#include "pipeline/drawing/deflate.hpp"

namespace tessera::pipeline {
namespace {

using Octets = std::vector<std::uint8_t>;

void put_32(Octets& out, std::uint32_t value)
{
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift));
}

void put_chunk(Octets& out, std::string_view kind, const Octets& data)
{
  put_32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = out.size();
  out.insert(out.end(), kind.begin(), kind.end());
  out.insert(out.end(), data.begin(), data.end());
  const auto chunk = std::span(out).subspan(begin);
  put_32(out,
         static_cast<std::uint32_t>(crc32(0, chunk.data(), static_cast<unsigned>(chunk.size()))));
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
  put_chunk(out, "IDAT", deflated(rows_of(picture)));
  put_chunk(out, "IEND", {});
  const auto* const first = reinterpret_cast<const std::byte*>(out.data());
  return {first, first + out.size()};
}

}  // namespace tessera::pipeline

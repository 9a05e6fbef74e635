// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/stl_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "file_cursor.hpp"
#include "stl_ascii.hpp"

namespace tessera::model {
namespace {

// Binary STL: 80 bytes of anything, a 32-bit count, and 50 bytes a triangle: normal, three corners
// (32-bit floats), 2 bytes of attributes; all little-endian.
constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kTrianglesAt = 84;
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kNormalSize = 12;

std::uint32_t little_endian(std::string_view bytes, std::size_t at)
{
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = (value << 8U) | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

// Size that the header of a binary file promises; 0 if there is no whole header.
std::size_t promised_size(std::string_view bytes)
{
  if (bytes.size() < kTrianglesAt) return 0;
  return kTrianglesAt + kTriangleSize * std::size_t{little_endian(bytes, kHeaderSize)};
}

bool looks_like_text(std::string_view bytes)
{
  constexpr std::size_t kEnough = 1000;
  const std::string_view front = bytes.substr(0, kEnough);
  const bool no_control_characters = std::all_of(front.begin(), front.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 || (c >= '\t' && c <= '\r');
  });
  const auto first = front.find_first_not_of(" \t\r\n");
  if (!no_control_characters || first == std::string_view::npos) return false;
  constexpr std::string_view kSolid = "solid";
  return std::equal(
      kSolid.begin(), kSolid.end(), front.begin() + static_cast<std::ptrdiff_t>(first),
      front.begin() + static_cast<std::ptrdiff_t>(std::min(first + kSolid.size(), front.size())),
      [](char a, char b) { return a == (b | 0x20); });
}

// Binary files that begin with "solid" name the solid there, as ASCII files do.
std::string name_in_header(std::string_view bytes)
{
  constexpr std::string_view kSolid = "solid ";
  std::string_view header = bytes.substr(0, kHeaderSize);
  if (!header.starts_with(kSolid)) return {};
  header.remove_prefix(kSolid.size());
  const auto last = std::find_if(header.begin(), header.end(),
                                 [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  std::string name(header.begin(), last);
  while (name.ends_with(' ')) name.pop_back();
  return name;
}

TriangleSoup parse_binary_stl(std::string_view bytes, const std::string& name)
{
  const std::size_t num_triangles = (bytes.size() - kTrianglesAt) / kTriangleSize;
  TriangleSoup soup;
  soup.solid_names.push_back(name_in_header(bytes));
  soup.triangle_solid.assign(num_triangles, 0);
  soup.corner_xyz.reserve(9 * num_triangles);
  for (std::size_t t = 0; t < num_triangles; ++t) {
    const std::size_t corners_at = kTrianglesAt + t * kTriangleSize + kNormalSize;
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t at = corners_at + 4 * i;
      const auto value = std::bit_cast<float>(little_endian(bytes, at));
      if (!std::isfinite(value)) {
        throw InputError(fmt::format("{}: coordinate at byte {} is not a finite number", name, at));
      }
      soup.corner_xyz.push_back(static_cast<double>(value));
    }
  }
  return soup;
}

[[noreturn]] void refuse(std::string_view bytes, const std::string& name)
{
  if (bytes.size() < kTrianglesAt) {
    throw InputError(
        fmt::format("{}: is not an STL file: it does not begin with 'solid', and its {} bytes are "
                    "too few for a binary header",
                    name, bytes.size()));
  }
  throw InputError(
      fmt::format("{}: is truncated or not an STL file: the count at byte 80 promises {} "
                  "triangles, which is {} bytes, but the file has {}",
                  name, little_endian(bytes, kHeaderSize), promised_size(bytes), bytes.size()));
}

}  // namespace

TriangleSoup read_stl(const std::filesystem::path& file)
{
  const std::string bytes = read_bytes(file);
  const std::string name = file.string();
  const bool binary = promised_size(bytes) == bytes.size();
  if (!binary && !looks_like_text(bytes)) refuse(bytes, name);

  TriangleSoup soup = binary ? parse_binary_stl(bytes, name) : parse_ascii_stl(bytes, name);
  if (soup.triangle_solid.empty()) throw InputError(name + ": holds no triangle");
  constexpr auto kLargest = static_cast<std::size_t>(std::numeric_limits<LocalIndex>::max()) / 3;
  if (soup.triangle_solid.size() > kLargest) throw InputError(name + ": has too many triangles");
  for (double& x : soup.corner_xyz) x += 0.0;  // -0 and 0 are one position
  return soup;
}

}  // namespace tessera::model

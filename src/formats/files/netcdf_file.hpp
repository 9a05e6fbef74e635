// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "formats/files/record_file.hpp"

namespace tessera::formats {

/// @brief Types of values, with the numbers that the format has for them.
enum class NetcdfType : std::uint32_t {
  text = 2,
  int32 = 4,
  float32 = 5,
  float64 = 6,
  int64 = 10,
};

struct NetcdfDimension {
  std::string name{};
  GlobalIndex length = 0;  ///< 0: of records, of which there are none.
};

struct NetcdfAttribute {
  std::string name{};
  std::variant<std::string, std::int32_t, float> value{};
};

struct NetcdfVariable {
  std::string name{};
  NetcdfType type = NetcdfType::int64;
  std::vector<std::string> dimensions{};  ///< Names; slowest first.
  std::vector<NetcdfAttribute> attributes{};
  /// Values as they stand in the file, see big_endian(). Empty: they are written later.
  std::string values{};
};

/// @brief What a netCDF file holds.
struct NetcdfLayout {
  std::vector<NetcdfDimension> dimensions{};
  std::vector<NetcdfAttribute> attributes{};
  std::vector<NetcdfVariable> variables{};  ///< Those with values first, then those of 8 bytes.
};

/// @brief The file in the classic form with 64-bit sizes (CDF-5), which has every array at a place
/// that its header tells: any number of processes can write it, without a library.
/// @return A section for each variable that is written later, in their order, with records of 8
/// bytes. All else is the head of the first one.
[[nodiscard]] std::vector<RecordSection> netcdf_sections(const NetcdfLayout& layout);

/// @brief Values as they stand in the file.
template <class Value>
[[nodiscard]] std::string big_endian(std::span<const Value> values)
{
  static_assert(std::endian::native == std::endian::little);
  std::string bytes;
  bytes.reserve(values.size_bytes());
  for (const Value value : values) {
    const auto image = std::bit_cast<std::array<char, sizeof(Value)>>(value);
    bytes.append(image.rbegin(), image.rend());
  }
  return bytes;
}

}  // namespace tessera::formats

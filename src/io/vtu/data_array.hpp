// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/enum_words.hpp"

#include "io/vtu/mesh_file.hpp"
#include "io/vtu/xml.hpp"

namespace tessera::io {

enum class ScalarType : int { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

/// @brief VTK's names of the types.
constexpr auto enum_words(ScalarType /*tag*/)
{
  return std::to_array<EnumWord<ScalarType>>({
      {ScalarType::i8, "Int8"},
      {ScalarType::u8, "UInt8"},
      {ScalarType::i16, "Int16"},
      {ScalarType::u16, "UInt16"},
      {ScalarType::i32, "Int32"},
      {ScalarType::u32, "UInt32"},
      {ScalarType::i64, "Int64"},
      {ScalarType::u64, "UInt64"},
      {ScalarType::f32, "Float32"},
      {ScalarType::f64, "Float64"},
  });
}

/// @brief How the arrays of one VTK XML file are stored.
struct Encoding {
  bool swap_bytes = false;
  std::size_t header_word = 4;  ///< Bytes of a size in front of binary data: 4 or 8.
  std::string compressor{};     ///< VTK's name; empty without compression.
  StoredBytes appended{};
  bool appended_is_base64 = false;
};

/// @brief Encoding of a file from its root element. @throws InputError
[[nodiscard]] Encoding encoding_of(const XmlDocument& document);

/// @brief One DataArray, decoded: values in this machine's byte order.
struct DataArray {
  ScalarType type = ScalarType::u8;
  std::size_t num_components = 1;
  Bytes values{};

  [[nodiscard]] bool is_floating() const noexcept { return type >= ScalarType::f32; }
  [[nodiscard]] std::size_t num_values() const;
};

/// @brief Scalar type of the element "DataArray"; a string counts as bytes. @throws InputError
[[nodiscard]] ScalarType scalar_type_of(const XmlElement& element);

/// @brief Decodes an element "DataArray" or "Array" of any format. Local.
///
/// Allocates in proportion to the bytes that are really there, whatever the sizes in the file say.
/// @throws InputError if it is cut off or corrupt.
[[nodiscard]] DataArray decode_array(const XmlElement& element, const Encoding& encoding);

/// @brief Calls `visit` with the values as a span of their own type.
template <class Visitor>
decltype(auto) visit_values(const DataArray& array, Visitor&& visit)
{
  const auto as = [&]<class T>(T) {
    return visit(std::span(reinterpret_cast<const T*>(array.values.data()),
                           array.values.size() / sizeof(T)));
  };
  switch (array.type) {
    case ScalarType::i8:
      return as(std::int8_t{});
    case ScalarType::u8:
      return as(std::uint8_t{});
    case ScalarType::i16:
      return as(std::int16_t{});
    case ScalarType::u16:
      return as(std::uint16_t{});
    case ScalarType::i32:
      return as(std::int32_t{});
    case ScalarType::u32:
      return as(std::uint32_t{});
    case ScalarType::i64:
      return as(std::int64_t{});
    case ScalarType::u64:
      return as(std::uint64_t{});
    case ScalarType::f32:
      return as(float{});
    case ScalarType::f64:
      break;
  }
  return as(double{});
}

/// @brief The values as T, or nothing if one of them does not fit. No value is altered, except that
/// integers of more than 53 bits are rounded when T is double.
template <class T>
[[nodiscard]] std::optional<std::vector<T>> values_as(const DataArray& array)
{
  return visit_values(array, []<class From>(std::span<const From> values) {
    std::optional<std::vector<T>> result;
    if constexpr (std::is_integral_v<T> && std::is_integral_v<From>) {
      for (const From value : values) {
        if (!std::in_range<T>(value)) return result;
      }
    } else if constexpr (std::is_integral_v<T>) {
      return result;
    }
    result.emplace(values.size());
    if constexpr (std::is_same_v<T, From>) {
      if (!values.empty()) std::memcpy(result->data(), values.data(), values.size_bytes());
    } else {
      // NOLINTNEXTLINE(bugprone-signed-char-misuse): Int8 holds numbers here
      for (std::size_t i = 0; i < values.size(); ++i) (*result)[i] = static_cast<T>(values[i]);
    }
    return result;
  });
}

}  // namespace tessera::io

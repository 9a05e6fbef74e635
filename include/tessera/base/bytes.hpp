// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "tessera/base/error.hpp"

namespace tessera {

using Bytes = std::vector<std::byte>;

/// @brief Writes values and arrays one behind the other into a byte buffer, in this machine's byte
/// order. What one build writes, the same build reads with ByteReader: messages, piece records.
class ByteWriter {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { append(&value, sizeof(T)); }

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const std::vector<T>& values)
  {
    put(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(T));
  }

  void put(const std::string& text)
  {
    put(static_cast<std::uint64_t>(text.size()));
    append(text.data(), text.size());
  }

  void put(const std::vector<std::string>& texts)
  {
    put(static_cast<std::uint64_t>(texts.size()));
    for (const std::string& text : texts) put(text);
  }

  [[nodiscard]] Bytes take() && { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size)
  {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  Bytes bytes_{};
};

/// @brief Reads what ByteWriter wrote, in the same order. Never reads past the end: a size that
/// does not fit the bytes that are left is an InputError, before anything is allocated.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] T get()
  {
    T value;
    const auto from = take(sizeof(T));
    std::memcpy(&value, from.data(), sizeof(T));
    return value;
  }

  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] std::vector<T> get_vector()
  {
    const auto count = get<std::uint64_t>();
    require(count <= rest_.size() / sizeof(T));
    const auto from = take(static_cast<std::size_t>(count) * sizeof(T));
    std::vector<T> values(static_cast<std::size_t>(count));
    if (!values.empty()) std::memcpy(values.data(), from.data(), from.size());
    return values;
  }

  [[nodiscard]] std::string get_string()
  {
    const std::vector<char> text = get_vector<char>();
    return {text.begin(), text.end()};
  }

  [[nodiscard]] std::vector<std::string> get_strings()
  {
    const auto count = get<std::uint64_t>();
    require(count <= rest_.size() / sizeof(std::uint64_t));
    std::vector<std::string> texts;
    texts.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count; ++i) texts.push_back(get_string());
    return texts;
  }

  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }

 private:
  static void require(bool condition)
  {
    if (!condition) throw InputError("record is truncated or not of this version");
  }

  std::span<const std::byte> take(std::size_t size)
  {
    require(size <= rest_.size());
    const auto front = rest_.first(size);
    rest_ = rest_.subspan(size);
    return front;
  }

  std::span<const std::byte> rest_;
};

}  // namespace tessera

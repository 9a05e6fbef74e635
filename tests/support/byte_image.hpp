// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

/// Tests of what goes to bytes.
namespace tessera::testing {

/// @brief Gives every number, text and list in a value something of its own, so that no two fields
/// can be taken for one another. For a class that does not take any values, there is a function
/// set_sample(T&) beside it.
class Sampler {
 public:
  template <class T>
  void fill(T& value)
  {
    if constexpr (requires { set_sample(value); }) {
      set_sample(value);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = !value;
    } else if constexpr (BoundedEnum<T>) {
      value = last_value(T{});
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>) {
      value = static_cast<T>(++last_ % 100);
    } else {
      std::apply([this](auto&... fields) { (this->fill(fields), ...); }, FieldAccess::of(value));
    }
  }

  void fill(std::string& text) { text = "text " + std::to_string(++last_); }
  void fill(std::filesystem::path& path) { path = "path_" + std::to_string(++last_); }

  template <class T>
  void fill(std::vector<T>& values)
  {
    values.resize(2);
    for (T& value : values) fill(value);
  }

  template <class T>
  void fill(FlatArray<T>& values)
  {
    values.resize(2);
    for (T& value : values) fill(value);
  }

  template <class T, std::size_t N>
  void fill(std::array<T, N>& values)
  {
    for (T& value : values) fill(value);
  }

  template <class T>
  void fill(std::optional<T>& value)
  {
    fill(value.emplace());
  }

  template <class... T>
  void fill(std::variant<T...>& value)
  {
    fill(value.template emplace<sizeof...(T) - 1>());
  }

 private:
  int last_ = 4;  // Above the defaults of small counts.
};

/// @brief No field stands twice in the list; that none is missing is seen at compile time.
template <HasFields T>
void expect_different_fields(T value)
{
  std::set<const void*> places;
  std::apply([&](auto&... fields) { (places.insert(&fields), ...); }, FieldAccess::of(value));
  EXPECT_EQ(places.size(), std::tuple_size_v<FieldsOf<T>>);
}

/// @brief A value comes back as it was, and of what is cut off or too long nothing comes back.
template <class T>
void expect_round_trip(const T& value)
{
  const Bytes bytes = to_bytes(value);
  EXPECT_EQ(to_bytes(from_bytes<T>(bytes)), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(static_cast<void>(from_bytes<T>(std::span(bytes).first(size))), InputError)
        << size << " of " << bytes.size() << " bytes";
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_THROW(static_cast<void>(from_bytes<T>(longer)), InputError);
}

/// @brief Whatever stands in the place of eight bytes: it is refused, or it is another value.
template <class T>
void expect_garbage_is_harmless(const T& value)
{
  const Bytes bytes = to_bytes(value);
  for (const std::byte garbage : {std::byte{0xFF}, std::byte{0x7F}, std::byte{0x01}}) {
    for (std::size_t first = 0; first < bytes.size(); ++first) {
      Bytes damaged = bytes;
      const std::size_t last = std::min(first + 8, bytes.size());
      std::fill(&damaged[first], damaged.data() + last, garbage);
      try {
        EXPECT_EQ(to_bytes(from_bytes<T>(damaged)).size(), bytes.size());
      } catch (const InputError&) {
        continue;
      }
    }
  }
}

}  // namespace tessera::testing

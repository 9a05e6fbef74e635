// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/fields.hpp"
#include "tessera/base/flat_array.hpp"

/// Bytes of values, in this machine's byte order: messages between processes and records of the
/// store. What one build writes, the same build reads.
///
/// A value is one of these:
/// - a number, a bool, or an enumeration with a last_value();
/// - a std::string or a path;
/// - a std::vector, std::map, std::array, std::optional or std::variant of values;
/// - a FlatArray, which begins where memory of its type may begin, seen from the first byte;
/// - a class with a list of fields (see fields.hpp).
///
/// Anything else does not compile, so no padding ever goes to bytes.
namespace tessera {

using Bytes = std::vector<std::byte>;

/// @brief A class that travels as another value: `Image image() const` makes that value, and
/// `void set_image(const Image&)` takes it back and throws InputError if it does not fit.
template <class T>
concept HasImage = std::same_as<decltype(std::declval<const T&>().image()), typename T::Image>;

/// @brief An enumeration whose values are those from 0 to `last_value(E)`.
template <class E>
concept BoundedEnum = std::is_enum_v<E> && std::same_as<decltype(last_value(E{})), E>;

namespace detail {

/// Fewest bytes that a T can have: a count that promises more than is left is refused at once.
template <class T>
struct LeastSize {
  static constexpr std::size_t value()
  {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      return sizeof(T);
    } else if constexpr (HasImage<T>) {
      return LeastSize<typename T::Image>::value();
    } else if constexpr (HasFields<T>) {
      return of_fields(static_cast<FieldsOf<T>*>(nullptr));
    } else {
      return sizeof(std::uint64_t);  // The count of a string or a vector.
    }
  }

 private:
  template <class... Fields>
  static constexpr std::size_t of_fields(std::tuple<Fields&...>* /*type*/)
  {
    return (std::size_t{0} + ... + LeastSize<Fields>::value());
  }
};

/// Of each element.
template <class T, std::size_t N>
struct LeastSize<std::array<T, N>> {
  static constexpr std::size_t value() { return N * LeastSize<T>::value(); }
};

/// Whether it is there.
template <class T>
struct LeastSize<std::optional<T>> {
  static constexpr std::size_t value() { return sizeof(bool); }
};

/// Which one it is.
template <class... T>
struct LeastSize<std::variant<T...>> {
  static constexpr std::size_t value() { return sizeof(std::uint32_t); }
};

}  // namespace detail

/// @brief Fewest bytes that a T has; those of every T if it holds no string, vector or option.
template <class T>
inline constexpr std::size_t kLeastSize = detail::LeastSize<T>::value();

/// @brief Counts the bytes that are put into it.
class ByteCounter {
 public:
  void append(const void* /*data*/, std::size_t size) { size_ += size; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  std::size_t size_ = 0;
};

/// @brief Keeps the bytes that are put into it.
class ByteBuffer {
 public:
  /// @param[in] size Bytes that will come; for more the buffer grows.
  explicit ByteBuffer(std::size_t size) : bytes_(size) {}

  void append(const void* data, std::size_t size)
  {
    if (size > bytes_.size() - used_) grow(size);
    if (size > 0) std::memcpy(bytes_.data() + used_, data, size);
    used_ += size;
  }

  [[nodiscard]] std::size_t size() const noexcept { return used_; }

  [[nodiscard]] Bytes take() &&
  {
    bytes_.resize(used_);
    return std::move(bytes_);
  }

 private:
  // Not inlined: GCC 12 else sees writes past the end that cannot happen.
  [[gnu::noinline]] void grow(std::size_t size) { bytes_.resize(used_ + size); }

  Bytes bytes_;
  std::size_t used_ = 0;
};

/// @brief Writes what is put into it to memory that is there. @pre There is enough of it.
class ByteSpan {
 public:
  explicit ByteSpan(std::span<std::byte> bytes) : bytes_(bytes) {}

  void append(const void* data, std::size_t size)
  {
    if (size > 0) std::memcpy(bytes_.data() + used_, data, size);
    used_ += size;
  }

  [[nodiscard]] std::size_t size() const noexcept { return used_; }

 private:
  std::span<std::byte> bytes_;
  std::size_t used_ = 0;
};

/// @brief Bytes from `position` to the next place where a T may begin.
template <class T>
[[nodiscard]] constexpr std::size_t padding_at(std::size_t position)
{
  return (alignof(T) - position % alignof(T)) % alignof(T);
}

/// @brief Puts values one behind the other into a sink, field by field.
template <class Sink>
class ValueWriter {
 public:
  explicit ValueWriter(Sink& sink) : sink_(sink) {}

  template <class T>
  void put(const T& value)
  {
    static_assert(
        kIsPlain<T> || BoundedEnum<T> || HasImage<T> || HasFields<T> || std::is_same_v<T, bool>,
        "only numbers, enumerations with a last_value() and classes with a list of "
        "fields go to bytes");
    if constexpr (kIsPlain<T>) {
      sink_.append(&value, sizeof(T));
    } else if constexpr (std::is_same_v<T, bool>) {
      put(static_cast<std::uint8_t>(value));
    } else if constexpr (std::is_enum_v<T>) {
      put(static_cast<std::underlying_type_t<T>>(value));
    } else if constexpr (HasImage<T>) {
      put(value.image());
    } else {
      std::apply([this](const auto&... fields) { (this->put(fields), ...); },
                 FieldAccess::of(value));
    }
  }

  void put(const std::string& text)
  {
    put(static_cast<std::uint64_t>(text.size()));
    sink_.append(text.data(), text.size());
  }

  void put(const std::filesystem::path& path) { put(path.string()); }

  template <class T>
  void put(const std::vector<T>& values)
  {
    put(static_cast<std::uint64_t>(values.size()));
    put_all(std::span<const T>(values));
  }

  template <class T>
  void put(const FlatArray<T>& values)
  {
    constexpr std::array<std::byte, alignof(T)> kZeros{};
    put(static_cast<std::uint64_t>(values.size()));
    sink_.append(kZeros.data(), padding_at<T>(sink_.size()));
    put_all(std::span<const T>(values));
  }

  template <class Key, class T>
  void put(const std::map<Key, T>& values)
  {
    put(static_cast<std::uint64_t>(values.size()));
    for (const auto& [key, value] : values) {
      put(key);
      put(value);
    }
  }

  template <class T, std::size_t N>
  void put(const std::array<T, N>& values)
  {
    put_all(std::span<const T>(values));
  }

  template <class T>
  void put(const std::optional<T>& value)
  {
    put(value.has_value());
    if (value) put(*value);
  }

  template <class... T>
  void put(const std::variant<T...>& value)
  {
    put(static_cast<std::uint32_t>(value.index()));
    std::visit([this](const auto& held) { this->put(held); }, value);
  }

 private:
  template <class T>
  void put_all(std::span<const T> values)
  {
    if constexpr (kIsPlain<T>) {
      sink_.append(values.data(), values.size_bytes());
    } else {
      for (const T& value : values) put(value);
    }
  }

  Sink& sink_;
};

/// @brief Reads values in the order in which they were written. Never reads past the end: a size
/// that does not fit the bytes that are left is an InputError, before anything is allocated.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes), size_(bytes.size()) {}

  /// @brief The same, but flat arrays of plain values borrow them from the bytes.
  /// @param[in] keeper Of the bytes, which nobody changes.
  ByteReader(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper)
      : ByteReader(bytes)
  {
    keeper_ = std::move(keeper);
  }

  /// @throws InputError if the bytes are truncated or the value is not sound: a count is beyond
  /// what is left, or a bool or an enumeration has none of its values.
  template <class T>
  [[nodiscard]] T get()
  {
    T value{};
    read(value);
    return value;
  }

  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }

  /// @throws InputError if bytes are left over.
  void require_end() const { require(at_end(), "record is longer than its fields"); }

 private:
  static void require(bool condition, const char* what)
  {
    if (!condition) throw InputError(what);
  }

  std::span<const std::byte> take(std::size_t size)
  {
    require(size <= rest_.size(), kTruncated);
    const auto front = rest_.first(size);
    rest_ = rest_.subspan(size);
    return front;
  }

  // The count of elements that follow, of at least `least_size` bytes each.
  std::size_t read_count(std::size_t least_size)
  {
    const auto count = get<std::uint64_t>();
    require(count <= rest_.size() / least_size, kTruncated);
    return static_cast<std::size_t>(count);
  }

  template <class T>
  void read(T& value)
  {
    if constexpr (kIsPlain<T>) {
      read_all(std::span<T>(&value, 1));
    } else if constexpr (std::is_same_v<T, bool>) {
      const auto byte = get<std::uint8_t>();
      require(byte <= 1, kOutOfRange);
      value = byte == 1;
    } else if constexpr (std::is_enum_v<T>) {
      auto number = get<std::underlying_type_t<T>>();
      require(0 <= number && number <= static_cast<decltype(number)>(last_value(T{})), kOutOfRange);
      value = static_cast<T>(number);
    } else if constexpr (HasImage<T>) {
      value.set_image(get<typename T::Image>());
    } else {
      std::apply([this](auto&... fields) { (this->read(fields), ...); }, FieldAccess::of(value));
      if constexpr (HasInvariant<T>) std::as_const(value).require_sound();
    }
  }

  void read(std::string& text)
  {
    text.resize(read_count(1));
    read_all(std::span<char>(text));
  }

  void read(std::filesystem::path& path) { path = get<std::string>(); }

  template <class T>
  void read(std::vector<T>& values)
  {
    const std::size_t count = read_count(kLeastSize<T>);
    read_elements(values, count);
  }

  template <class T>
  void read(FlatArray<T>& values)
  {
    const std::size_t count = read_count(kLeastSize<T>);
    take(padding_at<T>(size_ - rest_.size()));
    if (!borrow(values, count)) read_elements(values, count);
  }

  // Nothing is borrowed from bytes without a keeper, or where a T may not begin.
  template <class T>
  bool borrow(FlatArray<T>& values, std::size_t count)
  {
    if (!kIsPlain<T> || !keeper_) return false;
    if (reinterpret_cast<std::uintptr_t>(rest_.data()) % alignof(T) != 0) return false;
    const auto* const first = reinterpret_cast<const T*>(take(count * sizeof(T)).data());
    values = FlatArray<T>::borrowed({first, count}, keeper_);
    return true;
  }

  template <class Array>
  void read_elements(Array& values, std::size_t count)
  {
    using T = typename Array::value_type;
    if constexpr (kIsPlain<T>) {
      values.resize(count);
      read_all(std::span<T>(values));
    } else {
      values.clear();
      values.reserve(count);
      for (std::size_t i = 0; i < count; ++i) read(values.emplace_back());
    }
  }

  template <class Key, class T>
  void read(std::map<Key, T>& values)
  {
    values.clear();
    for (std::size_t left = read_count(kLeastSize<Key> + kLeastSize<T>); left > 0; --left) {
      const Key key = get<Key>();
      read(values[key]);
    }
  }

  template <class T, std::size_t N>
  void read(std::array<T, N>& values)
  {
    for (T& value : values) read(value);
  }

  template <class T>
  void read(std::optional<T>& value)
  {
    value.reset();
    if (get<bool>()) read(value.emplace());
  }

  template <class... T>
  void read(std::variant<T...>& value)
  {
    const auto index = get<std::uint32_t>();
    require(index < sizeof...(T), kOutOfRange);
    std::uint32_t next = 0;
    ((next++ == index ? read(value.template emplace<T>()) : void()), ...);
  }

  template <class T>
  void read_all(std::span<T> values)
  {
    const auto from = take(values.size_bytes());
    if (!from.empty()) std::memcpy(values.data(), from.data(), from.size());
  }

  static constexpr const char* kTruncated = "record is truncated or not of this version";
  static constexpr const char* kOutOfRange = "record has a value that is out of range";

  std::span<const std::byte> rest_;
  std::size_t size_;
  std::shared_ptr<const void> keeper_{};
};

/// @brief Bytes of a value. Local.
template <class T>
[[nodiscard]] Bytes to_bytes(const T& value)
{
  ByteCounter counter;
  ValueWriter(counter).put(value);
  ByteBuffer buffer(counter.size());
  ValueWriter(buffer).put(value);
  return std::move(buffer).take();
}

/// @brief The value that to_bytes() made the bytes of. Local.
/// @throws InputError as ByteReader::get(), and if bytes are left over.
template <class T>
[[nodiscard]] T from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  T value = in.get<T>();
  in.require_end();
  return value;
}

}  // namespace tessera

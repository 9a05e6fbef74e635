// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>

namespace tessera::model {

/// @brief All bytes of a file. @throws InputError if it is missing, empty or cannot be read.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& file);

/// @brief A word of a file, short and without control characters, for a message.
[[nodiscard]] std::string printable(std::string_view word);

/// @brief A place in the bytes of a file that has text, raw numbers, or both. Says where it stands
/// if something is wrong there.
class FileCursor {
 public:
  /// @param[in] name What messages call the file. Both are borrowed.
  FileCursor(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  /// @brief Whether numbers are raw from here on.
  void set_binary(bool is_binary) { is_binary_ = is_binary; }
  [[nodiscard]] bool is_binary() const { return is_binary_; }

  /// @brief Passes white space; whether nothing else is left.
  bool at_end();
  /// @brief The next word. @param[in] expected What it should be, for the message.
  std::string_view word(std::string_view expected);
  /// @brief The rest of the line, without the line's end and white space around it.
  std::string_view line();
  void expect(std::string_view expected);
  /// @brief Passes everything up to the end of a section. @throws InputError if there is none.
  void skip_behind(std::string_view text);
  /// @brief Passes the line's end that stands before raw numbers.
  void skip_line_end();

  /// @brief The next number: raw, of type T, or a word.
  template <class T>
  T number(std::string_view expected)
  {
    if (is_binary_) return raw<T>(expected);
    if constexpr (std::is_floating_point_v<T>) {
      return real(expected);
    } else {
      return static_cast<T>(integer(expected));
    }
  }

  /// @brief A number of things that follow, as number(), each of which takes some bytes at least.
  template <class T>
  std::size_t count(std::string_view what, std::size_t least_bytes)
  {
    return checked_count(static_cast<std::int64_t>(number<T>(what)), what, least_bytes);
  }

  /// @brief A coordinate: a finite number.
  double coordinate();

  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <class T>
  T raw(std::string_view expected)
  {
    T value{};
    if (bytes_.size() - at_ < sizeof(T)) fail_truncated(expected);
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  std::int64_t integer(std::string_view expected);
  double real(std::string_view expected);
  [[nodiscard]] std::size_t checked_count(std::int64_t value, std::string_view what,
                                          std::size_t least_bytes) const;
  [[noreturn]] void fail_truncated(std::string_view expected) const;

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  bool is_binary_ = false;
};

}  // namespace tessera::model

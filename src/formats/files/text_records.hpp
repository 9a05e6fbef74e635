// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "tessera/base/types.hpp"

namespace tessera::formats {

/// @brief Characters of the longest number of 64 bits that reads back to the same bits.
inline constexpr std::size_t kRealWidth = 24;

/// @brief Digits of a number. @pre number >= 0.
[[nodiscard]] std::size_t num_digits(GlobalIndex number);

/// @brief Text of fields of fixed width, in which numbers stand at the right.
class TextRecords {
 public:
  TextRecords& text(std::string_view characters)
  {
    text_ += characters;
    return *this;
  }

  /// @pre the number has no more than `width` digits, and is not negative.
  TextRecords& integer(GlobalIndex number, std::size_t width);

  /// @brief The shortest text that reads back to the same bits; if that is too long, as many digits
  /// as there is room for. @pre width >= 13; number is finite.
  TextRecords& real(double number, std::size_t width);

  [[nodiscard]] std::string take() { return std::exchange(text_, {}); }

 private:
  void right_aligned(std::string_view field, std::size_t width);

  std::string text_{};
};

}  // namespace tessera::formats

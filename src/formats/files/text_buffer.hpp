// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace tessera::formats {

/// @brief A text that grows line by line, for files of numbers.
class TextBuffer {
 public:
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values)
  {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  [[nodiscard]] std::string_view view() const { return {text_.data(), text_.size()}; }

 private:
  fmt::memory_buffer text_{};
};

}  // namespace tessera::formats

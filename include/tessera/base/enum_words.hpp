// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "tessera/base/error.hpp"

namespace tessera {

/// @brief One value of an enumeration, and its word in case files, options, reports and messages.
template <class Enum>
struct EnumWord {
  Enum value;
  std::string_view word;
};

/// @brief An enumeration with words. Its header has the one table of them:
///
/// `constexpr auto enum_words(Colour) { return std::to_array<EnumWord<Colour>>({{…}, {…}}); }`
///
/// The order of the table is the order in which people read the words; that of the enumeration does
/// not matter. A new value needs one line of the table.
template <class Enum>
concept EnumWithWords = std::is_enum_v<Enum> && requires
{
  enum_words(Enum{});
};

/// @brief The table of an enumeration. It does not compile with a value or a word given twice.
template <EnumWithWords Enum>
inline constexpr auto kEnumWords = [] {
  constexpr auto table = enum_words(Enum{});
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (table[i].value == table[j].value || table[i].word == table[j].word) {
        throw "a value or a word stands twice in a table of words";  // Seen by compilers only.
      }
    }
  }
  return table;
}();

/// @brief All words of an enumeration, in the order of its table. Shape (number of words).
template <EnumWithWords Enum>
inline constexpr auto kWords = [] {
  std::array<std::string_view, kEnumWords<Enum>.size()> words;
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = kEnumWords<Enum>[i].word;
  return words;
}();

/// @brief The word of a value. Local. @throws Error if its table lacks the value.
template <EnumWithWords Enum>
[[nodiscard]] constexpr std::string_view word_of(Enum value)
{
  for (const EnumWord<Enum>& entry : kEnumWords<Enum>) {
    if (entry.value == value) return entry.word;
  }
  throw Error("value " + std::to_string(static_cast<long long>(value))
              + " of an enumeration has no word");
}

/// @brief The value that a word stands for; nothing if it is no word of the enumeration. Local.
template <EnumWithWords Enum>
[[nodiscard]] constexpr std::optional<Enum> value_of(std::string_view word)
{
  for (const EnumWord<Enum>& entry : kEnumWords<Enum>) {
    if (entry.word == word) return entry.value;
  }
  return std::nullopt;
}

}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/config/case.hpp"

#include "config/toml_document.hpp"

namespace tessera::config {

/// @brief Lengths, scales and times beyond this are mistakes; toml11 turns an overflow into the
/// largest double, which this excludes as well.
inline constexpr double kHuge = 1e30;

enum class Bound : int { inclusive, exclusive };

// The kinds of keys: what a value may be, and the member of Case that holds it. The default is the
// value of that member in a default-constructed Case. A number outside its range, or an empty path,
// stands for "not given".

struct RealRule {
  double& (*field)(Case&);
  double low;
  Bound low_bound;
  double high;
  Bound high_bound;
};

struct IntegerRule {
  int& (*field)(Case&);
  int low;
  int high;
  std::string_view word_for_zero{};  ///< Text that stands for 0, itself out of range; or empty.
};

struct FlagRule {
  bool& (*field)(Case&);
};

/// @brief A flag, or "auto" for none.
struct SwitchRule {
  std::optional<bool>& (*field)(Case&);
};

struct PathRule {
  std::filesystem::path& (*field)(Case&);
};

/// @brief A point or a vector: three numbers.
struct TripleRule {
  Vec3& (*field)(Case&);
  double largest;  ///< No coordinate is beyond it, on either side.
};

/// @brief A list of points, three numbers each, not empty.
struct PointListRule {
  std::vector<Vec3>& (*field)(Case&);
  double largest;  ///< As of TripleRule.
};

/// @brief A list of numbers from 1, without repetitions, not empty.
struct NumberListRule {
  std::vector<LocalIndex>& (*field)(Case&);
};

/// @brief A word of an enumeration; made by word_rule().
struct WordRule {
  std::span<const std::string_view> words;
  std::string_view (*get)(Case&);
  bool (*set)(Case&, std::string_view);  ///< False, and nothing set, if it is none of the words.
};

/// @brief Text, not empty.
struct TextRule {
  std::string& (*field)(Case&);
};

/// @brief A list of words of an enumeration, without repetitions, not empty; made by
/// word_list_rule().
struct WordListRule {
  std::span<const std::string_view> words;
  std::vector<std::string_view> (*get)(Case&);
  /// False, and nothing set, if one of them is none of the words.
  bool (*set)(Case&, std::span<const std::string_view>);
};

using Rule = std::variant<RealRule, IntegerRule, FlagRule, SwitchRule, PathRule, TripleRule,
                          PointListRule, NumberListRule, WordRule, TextRule, WordListRule>;

/// @brief The rule of a field of an enumeration with words.
/// @param[in] field Captureless; from a Case& to a reference to the member.
template <class Field>
constexpr WordRule word_rule(Field /*field*/)
{
  using Enum = std::remove_reference_t<std::invoke_result_t<Field, Case&>>;
  return {.words = kWords<Enum>,
          .get = [](Case& from) { return word_of(Field{}(from)); },
          .set =
              [](Case& into, std::string_view word) {
                const std::optional<Enum> value = value_of<Enum>(word);
                if (value) Field{}(into) = *value;
                return value.has_value();
              }};
}

/// @brief The rule of a field that is a vector of an enumeration with words.
/// @param[in] field As of word_rule().
template <class Field>
constexpr WordListRule word_list_rule(Field /*field*/)
{
  using Values = std::remove_reference_t<std::invoke_result_t<Field, Case&>>;
  using Enum = typename Values::value_type;
  return {.words = kWords<Enum>,
          .get =
              [](Case& from) {
                std::vector<std::string_view> words;
                for (const Enum value : Field{}(from)) words.push_back(word_of(value));
                return words;
              },
          .set =
              [](Case& into, std::span<const std::string_view> words) {
                Values values;
                for (const std::string_view word : words) {
                  const std::optional<Enum> value = value_of<Enum>(word);
                  if (!value) return false;
                  values.push_back(*value);
                }
                Field{}(into) = std::move(values);
                return true;
              }};
}

/// @brief All there is to say about one key of a case file.
struct Key {
  std::string_view name;  ///< "table.key".
  Rule rule;
  std::string_view unit{};  ///< Empty: none.
  std::string_view meaning;
  std::string_view reason;             ///< Why this default; why none if there is none.
  std::string_view derived_default{};  ///< In words, for a default that no constant can hold.
  std::string_view example{};          ///< TOML value for the reference, if there is no default.
  bool is_optional = false;            ///< No constant default, and may be left out all the same.
};

/// @brief A table that may stand any number of times, as `[[name]]`. Every key that is not optional
/// must be given, but only of one of the alternatives.
struct TableList {
  std::string_view name;
  std::span<const Key> keys;      ///< Their rules see the last element of a case's list.
  std::string_view unique_key{};  ///< No two elements have the same value of it. A TextRule; empty:
                                  ///< elements may be equal.
  /// A key, or a prefix "word." of keys, after the list's name: "patch", "ball". Of these, an
  /// element has just one, with all of its keys that are not optional.
  std::span<const std::string_view> alternatives{};
  std::string_view meaning;
  std::string_view reason;  ///< Why there are none unless given.
  std::size_t (*size)(const Case&);
  void (*resize)(Case&, std::size_t);
  std::string (*defect)(const Case&) = nullptr;  ///< What is wrong with the last element as a
                                                 ///< whole; empty: nothing.
};

/// @brief Every key outside of lists, table by table, in the order in which people read them.
[[nodiscard]] std::span<const Key> all_keys();

/// @brief Every list of tables.
[[nodiscard]] std::span<const TableList> all_table_lists();

/// @brief The key of that name, or null.
[[nodiscard]] const Key* find_key(std::string_view name);

/// @brief The list of that name, or null.
[[nodiscard]] const TableList* find_table_list(std::string_view name);

/// @brief The list that a key of that name would stand in, or null.
[[nodiscard]] const TableList* list_around(std::string_view name);

/// @brief "ball.radius" of "size.region.ball.radius". @pre The key is one of the list's.
[[nodiscard]] std::string_view name_in_list(const TableList& list, const Key& key);

/// @brief The alternative that the key belongs to, or "" if it stands beside all of them.
[[nodiscard]] std::string_view alternative_of(const TableList& list, const Key& key);

/// @brief Whether a key of all_keys() stands in that table.
[[nodiscard]] bool is_table(std::string_view name);

/// @brief "coarse" of "coarse.max_size".
[[nodiscard]] std::string_view table_of(std::string_view name);

/// @brief "max_size" of "coarse.max_size".
[[nodiscard]] std::string_view last_part(std::string_view name);

/// @brief The known key or list that `name` most likely means, or nothing if none is near.
[[nodiscard]] std::optional<std::string_view> nearest_key(std::string_view name);

/// @brief Put the value into the case. False, and the case unchanged, if the rule forbids it.
[[nodiscard]] bool assign(const Rule& rule, const Value& value, Case& into);

/// @brief What the rule allows, to follow "must be ".
[[nodiscard]] std::string allowed(const Rule& rule);

/// @brief What a list is, to follow "must be ".
[[nodiscard]] std::string allowed(const TableList& list);

/// @brief The case's value as TOML, or nothing if it is not given and has no default.
[[nodiscard]] std::optional<std::string> toml_value(const Rule& rule, const Case& from);

/// @brief Whether every value is text, so that an override needs no quotes.
[[nodiscard]] bool takes_text(const Rule& rule);

}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/error.hpp"

#include "config/key_table.hpp"
#include "config/text.hpp"

namespace tessera::config {
namespace {

constexpr std::string_view kAuto = "auto";  // Of SwitchRule.

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

// Written so that NaN is outside.
bool in_range(const RealRule& rule, double value)
{
  const bool above = rule.low_bound == Bound::inclusive ? value >= rule.low : value > rule.low;
  const bool below = rule.high_bound == Bound::inclusive ? value <= rule.high : value < rule.high;
  return above && below;
}

std::optional<double> as_real(const Value& value)
{
  if (const auto* real = std::get_if<double>(&value.data)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
    return static_cast<double>(*integer);
  }
  return std::nullopt;
}

bool assign_to(const RealRule& rule, const Value& value, Case& into)
{
  const std::optional<double> number = as_real(value);
  if (!number || !in_range(rule, *number)) return false;
  rule.field(into) = *number;
  return true;
}

bool assign_to(const IntegerRule& rule, const Value& value, Case& into)
{
  if (const auto* text = std::get_if<std::string>(&value.data)) {
    if (rule.word_for_zero.empty() || *text != rule.word_for_zero) return false;
    rule.field(into) = 0;
    return true;
  }
  const auto* number = std::get_if<std::int64_t>(&value.data);
  if (number == nullptr || *number < rule.low || *number > rule.high) return false;
  rule.field(into) = static_cast<int>(*number);
  return true;
}

bool assign_to(const FlagRule& rule, const Value& value, Case& into)
{
  const auto* flag = std::get_if<bool>(&value.data);
  if (flag == nullptr) return false;
  rule.field(into) = *flag;
  return true;
}

bool assign_to(const SwitchRule& rule, const Value& value, Case& into)
{
  const auto* flag = std::get_if<bool>(&value.data);
  const auto* text = std::get_if<std::string>(&value.data);
  if (flag == nullptr && (text == nullptr || *text != kAuto)) return false;
  rule.field(into) = flag == nullptr ? std::nullopt : std::optional(*flag);
  return true;
}

bool assign_to(const PathRule& rule, const Value& value, Case& into)
{
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr || text->empty() || text->find('\0') != std::string::npos) return false;
  rule.field(into) = *text;
  return true;
}

bool in_range(const Vec3& triple, double largest)
{
  return std::ranges::all_of(triple, [&](double x) { return std::abs(x) <= largest; });
}

// Three numbers in range; nothing if that is something else.
std::optional<Vec3> as_triple(const Value& value, double largest)
{
  const auto* items = std::get_if<std::vector<Value>>(&value.data);
  if (items == nullptr || items->size() != 3) return std::nullopt;
  Vec3 triple{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double> number = as_real((*items)[axis]);
    if (!number) return std::nullopt;
    triple[axis] = *number;
  }
  return in_range(triple, largest) ? std::optional(triple) : std::nullopt;
}

bool assign_to(const TripleRule& rule, const Value& value, Case& into)
{
  const std::optional<Vec3> triple = as_triple(value, rule.largest);
  if (triple) rule.field(into) = *triple;
  return triple.has_value();
}

bool assign_to(const PointListRule& rule, const Value& value, Case& into)
{
  const auto* items = std::get_if<std::vector<Value>>(&value.data);
  if (items == nullptr || items->empty()) return false;
  std::vector<Vec3> points;
  for (const Value& item : *items) {
    const std::optional<Vec3> point = as_triple(item, rule.largest);
    if (!point) return false;
    points.push_back(*point);
  }
  rule.field(into) = std::move(points);
  return true;
}

bool assign_to(const NumberListRule& rule, const Value& value, Case& into)
{
  const auto* items = std::get_if<std::vector<Value>>(&value.data);
  if (items == nullptr || items->empty()) return false;
  std::vector<LocalIndex> numbers;
  for (const Value& item : *items) {
    const auto* number = std::get_if<std::int64_t>(&item.data);
    if (number == nullptr || *number < 1 || *number > std::numeric_limits<LocalIndex>::max()) {
      return false;
    }
    if (std::ranges::count(numbers, *number) != 0) return false;
    numbers.push_back(static_cast<LocalIndex>(*number));
  }
  rule.field(into) = std::move(numbers);
  return true;
}

bool assign_to(const WordRule& rule, const Value& value, Case& into)
{
  const auto* text = std::get_if<std::string>(&value.data);
  return text != nullptr && rule.set(into, *text);
}

bool assign_to(const TextRule& rule, const Value& value, Case& into)
{
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr || text->empty()) return false;
  rule.field(into) = *text;
  return true;
}

bool assign_to(const WordListRule& rule, const Value& value, Case& into)
{
  const auto* items = std::get_if<std::vector<Value>>(&value.data);
  if (items == nullptr || items->empty()) return false;
  std::vector<std::string_view> words;
  for (const Value& item : *items) {
    const auto* text = std::get_if<std::string>(&item.data);
    if (text == nullptr || std::ranges::count(words, *text) != 0) return false;
    words.push_back(*text);
  }
  return rule.set(into, words);
}

std::string bound_text(std::string_view relation, double value)
{
  std::string number = number_text(value);
  if (number.ends_with(".0")) number.resize(number.size() - 2);
  return std::string(relation).append(number);
}

std::string allowed_range(const RealRule& rule)
{
  return std::string("a number ")
      .append(bound_text(rule.low_bound == Bound::inclusive ? ">= " : "> ", rule.low))
      .append(bound_text(rule.high_bound == Bound::inclusive ? " and <= " : " and < ", rule.high));
}

std::string word_list(std::span<const std::string_view> words)
{
  std::string result;
  for (const std::string_view word : words) {
    if (!result.empty()) result += ", ";
    result += toml_string(word);
  }
  return result;
}

std::string triple_text(const Vec3& triple)
{
  return fmt::format("[{}, {}, {}]", number_text(triple[0]), number_text(triple[1]),
                     number_text(triple[2]));
}

std::string path_value(const std::filesystem::path& path)
{
  if (!is_utf8(path.string())) {
    throw ConfigError(
        fmt::format("path {} is not valid UTF-8, so no case file can hold it; rename it",
                    toml_string(path.string())));
  }
  return toml_string(path.string());
}

}  // namespace

bool assign(const Rule& rule, const Value& value, Case& into)
{
  return std::visit([&](const auto& kind) { return assign_to(kind, value, into); }, rule);
}

std::string allowed(const Rule& rule)
{
  return std::visit(
      Overloaded{
          [](const RealRule& real) { return allowed_range(real); },
          [](const IntegerRule& integer) {
            const std::string word = integer.word_for_zero.empty()
                                         ? std::string()
                                         : ", or " + toml_string(integer.word_for_zero);
            return fmt::format("a whole number from {} to {}{}", integer.low, integer.high, word);
          },
          [](const FlagRule&) { return std::string("true or false"); },
          [](const SwitchRule&) { return std::string("true, false or ") + toml_string(kAuto); },
          [](const PathRule&) { return std::string("a path in quotes, not empty"); },
          [](const TripleRule&) { return std::string("a list of three numbers"); },
          [](const PointListRule&) {
            return std::string("a list of points, each a list of three numbers");
          },
          [](const NumberListRule&) {
            return std::string("a list of whole numbers from 1, without repetitions, not empty");
          },
          [](const WordRule& word) {
            return (word.words.size() > 1 ? "one of " : "") + word_list(word.words);
          },
          [](const TextRule&) { return std::string("text in quotes, not empty"); },
          [](const WordListRule& list) {
            return "a list without repetitions, not empty, of: " + word_list(list.words);
          },
      },
      rule);
}

std::string allowed(const TableList& list)
{
  std::string keys;
  std::string optional_keys;
  for (const Key& key : list.keys) {
    if (!alternative_of(list, key).empty()) continue;
    std::string& into = key.is_optional ? optional_keys : keys;
    into.append(into.empty() ? "" : " and ").append(name_in_list(list, key));
  }
  if (!list.alternatives.empty()) {
    keys.append(fmt::format(" and one of {}", fmt::join(list.alternatives, ", ")));
  }
  if (!optional_keys.empty()) keys.append("; they may have ").append(optional_keys);
  if (!list.unique_key.empty()) {
    keys.append(" and no two with the same ").append(last_part(list.unique_key));
  }
  return std::string("tables [[").append(list.name).append("]], each with ").append(keys);
}

std::optional<std::string> toml_value(const Rule& rule, const Case& from)
{
  Case copy = from;  // The rules hand out references; a copy keeps `from` const.
  using Text = std::optional<std::string>;
  return std::visit(
      Overloaded{
          [&](const RealRule& real) {
            const double value = real.field(copy);
            return in_range(real, value) ? Text(number_text(value)) : Text();
          },
          [&](const IntegerRule& integer) {
            const int value = integer.field(copy);
            if (value == 0 && !integer.word_for_zero.empty()) {
              return Text(toml_string(integer.word_for_zero));
            }
            const bool is_given = integer.low <= value && value <= integer.high;
            return is_given ? Text(fmt::to_string(value)) : Text();
          },
          [&](const FlagRule& flag) { return Text(flag.field(copy) ? "true" : "false"); },
          [&](const SwitchRule& choice) {
            const std::optional<bool> value = choice.field(copy);
            if (!value) return Text(toml_string(kAuto));
            return Text(*value ? "true" : "false");
          },
          [&](const PathRule& path) {
            return path.field(copy).empty() ? Text() : Text(path_value(path.field(copy)));
          },
          [&](const TripleRule& triple) {
            const Vec3 value = triple.field(copy);
            return in_range(value, triple.largest) ? Text(triple_text(value)) : Text();
          },
          [&](const PointListRule& list) {
            std::vector<std::string> points;
            for (const Vec3& point : list.field(copy)) points.push_back(triple_text(point));
            return points.empty() ? Text() : Text(fmt::format("[{}]", fmt::join(points, ", ")));
          },
          [&](const NumberListRule& list) {
            const std::vector<LocalIndex>& numbers = list.field(copy);
            return numbers.empty() ? Text() : Text(fmt::format("[{}]", fmt::join(numbers, ", ")));
          },
          [&](const WordRule& word) { return Text(toml_string(word.get(copy))); },
          [&](const TextRule& text) {
            return text.field(copy).empty() ? Text() : Text(toml_string(text.field(copy)));
          },
          [&](const WordListRule& list) {
            return Text(std::string("[").append(word_list(list.get(copy))).append("]"));
          },
      },
      rule);
}

bool takes_text(const Rule& rule)
{
  return std::holds_alternative<PathRule>(rule) || std::holds_alternative<WordRule>(rule)
         || std::holds_alternative<TextRule>(rule);
}

}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#include "config/toml_document.hpp"

#include <algorithm>
#include <cstddef>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "config/text.hpp"
#include "config/toml11.hpp"

namespace tessera::config {
namespace {

// toml11 follows nested lists, and the parts of a dotted key, by recursion: some ten thousand open
// brackets or dots overflow the stack. No case file has this number of brackets in all (a hundred
// fill regions have 200), or of dots in a line.
bool is_too_deep(std::string_view text)
{
  constexpr std::ptrdiff_t kMost = 1000;
  std::ptrdiff_t num_brackets = 0;
  std::ptrdiff_t num_dots = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++num_brackets;
    if (c == '.') ++num_dots;
    if (c == '\n') num_dots = 0;
    if (num_brackets > kMost || num_dots > kMost) return true;
  }
  return false;
}

// toml11 reads past the end of the text where a character is cut off in a string.
void require_utf8(std::string_view text, const std::string& file_name)
{
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (!is_utf8(line)) {
      throw ConfigError(
          fmt::format("{}:{}: not valid TOML: holds bytes that are not UTF-8", file_name, number));
    }
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
}

TomlValue parse(std::string_view text, const std::string& file_name)
{
  std::istringstream stream{std::string(text)};
  return parse_stream(stream, file_name);
}

// Says where a value stands. All that an override gives stands in the override.
class OriginOf {
 public:
  OriginOf() = default;
  explicit OriginOf(std::string everywhere) : everywhere_(std::move(everywhere)) {}

  std::string operator()(const TomlValue& value) const
  {
    if (!everywhere_.empty()) return everywhere_;
    return fmt::format("{}:{}", value.location().file_name(), line_of(value));
  }

 private:
  std::string everywhere_{};
};

std::vector<Entry> entries_of(const TomlValue& table, const std::string& prefix,
                              const OriginOf& origin_of);

Value to_value(const TomlValue& toml, const std::string& name, const OriginOf& origin_of)
{
  switch (toml.type()) {
    case toml::value_t::boolean:
      return {toml.as_boolean()};
    case toml::value_t::integer:
      return {toml.as_integer()};
    case toml::value_t::floating:
      return {toml.as_floating()};
    case toml::value_t::string:
      return {text_of(toml)};
    case toml::value_t::table:
      return {Table{entries_of(toml, name, origin_of), origin_of(toml)}};
    case toml::value_t::array:
      break;
    default:
      return {OtherValue{"a date or time"}};
  }
  std::vector<Value> items;
  for (const TomlValue& item : toml.as_array()) items.push_back(to_value(item, name, origin_of));
  return {std::move(items)};
}

struct LinedEntry {
  std::size_t line = 0;
  Entry entry{};
};

void flatten(const TomlValue& table, const std::string& prefix, const OriginOf& origin_of,
             std::vector<LinedEntry>& entries)
{
  for (const auto& [key, value] : table.as_table()) {
    const std::string name = prefix.empty() ? key : fmt::format("{}.{}", prefix, key);
    if (value.is_table() && !value.as_table().empty()) {
      flatten(value, name, origin_of, entries);
      continue;
    }
    Value plain = value.is_table() ? Value{OtherValue{std::string(kEmptyTable)}}
                                   : to_value(value, name, origin_of);
    entries.push_back({line_of(value), {name, std::move(plain), origin_of(value)}});
  }
}

std::vector<Entry> entries_of(const TomlValue& table, const std::string& prefix,
                              const OriginOf& origin_of)
{
  std::vector<LinedEntry> lined;
  flatten(table, prefix, origin_of, lined);
  std::ranges::stable_sort(lined, {}, &LinedEntry::line);
  std::vector<Entry> entries;
  entries.reserve(lined.size());
  for (LinedEntry& item : lined) entries.push_back(std::move(item.entry));
  return entries;
}

// toml11 describes an error by a headline and then, for one or two places, the line of the file and
// below it a marker with a comment:
//     [error] toml::insert_value: value ("a") already exists.
//      --> case.toml
//        |
//      2 | a = 3
//        |     ^--- value defined twice
// Of two places toml11 3 names the first line first, toml11 4 the second.
struct Place {
  int line_number = 0;
  std::string line{};
  std::string comment{};
};

// A number that is too large for a line of a file is none.
int number_in(const std::string& digits)
{
  constexpr std::size_t kMostDigits = 9;
  return digits.size() > kMostDigits ? 0 : std::stoi(digits);
}

std::vector<Place> places_in(const std::vector<std::string>& lines)
{
  static const std::regex numbered(R"(^ *([0-9]+) \| (.*)$)");
  static const std::regex marked(R"(^ +\| *(\^-*|~+) ?(.*)$)");
  std::vector<Place> places;
  std::smatch match;
  for (const std::string& line : lines) {
    if (std::regex_match(line, match, numbered)) {
      places.push_back({number_in(match[1]), match[2], {}});
    } else if (!places.empty() && std::regex_match(line, match, marked)) {
      places.back().comment = match[2];
    }
  }
  return places;
}

std::string without_prefix(const std::string& headline)
{
  static const std::regex prefix(R"(^(\[error\] )?((toml::)?[a-z_]+:+ *)?)");
  return std::string(trimmed(std::regex_replace(headline, prefix, "")));
}

std::vector<std::string> first_of_lines(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream stream(text);
  // The recursion of std::regex is as deep as a line is long.
  constexpr std::size_t kLongest = 500;
  for (std::string line; std::getline(stream, line);) lines.push_back(line.substr(0, kLongest));
  return lines;
}

std::string one_line_message(const std::string& file_name, const toml::exception& error)
{
  const std::vector<std::string> lines = first_of_lines(error.what());
  const std::string headline = lines.empty() ? "" : without_prefix(lines.front());
  const std::vector<Place> places = places_in(lines);
  if (places.empty()) return fmt::format("{}: not valid TOML: {}", file_name, printable(headline));
  const auto [first, last] = std::ranges::minmax(places, {}, &Place::line_number);
  std::string message = fmt::format("{}:{}: ", file_name, last.line_number);
  if (places.size() == 2 && headline.find("already") != std::string::npos) {
    message += fmt::format("defined twice (first on line {})", first.line_number);
  } else {
    message += "not valid TOML: " + headline;
    if (!last.comment.empty()) message += (headline.empty() ? "" : ": ") + last.comment;
  }
  constexpr std::size_t kLongestLine = 120;
  return printable(fmt::format("{}: {}", message, last.line.substr(0, kLongestLine)));
}

}  // namespace

std::string value_text(const Value& value)
{
  struct Writer {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return fmt::to_string(number); }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(const std::string& text) const { return toml_string(text); }
    std::string operator()(const Table&) const { return "a table"; }
    std::string operator()(const OtherValue& other) const { return other.kind; }
    std::string operator()(const std::vector<Value>& items) const
    {
      std::string result = "[";
      for (const Value& item : items) {
        if (result.size() > 1) result += ", ";
        result += value_text(item);
      }
      return result + "]";
    }
  };
  return std::visit(Writer{}, value.data);
}

std::vector<Entry> parse_toml(std::string_view text, const std::string& file_name)
{
  if (is_too_deep(text)) {
    throw ConfigError(file_name + ": has too many brackets or dots for a case file");
  }
  require_utf8(text, file_name);
  try {
    return entries_of(parse(text, file_name), "", OriginOf());
  } catch (const toml::exception& error) {
    throw ConfigError(one_line_message(file_name, error));
  }
}

std::optional<Entry> parse_toml_value(std::string_view text, const std::string& name,
                                      const std::string& origin)
{
  const bool is_one_line = text.find('\n') == std::string_view::npos;
  if (!is_one_line || is_too_deep(text) || !is_utf8(text)) return std::nullopt;
  try {
    const TomlValue table = parse("value = " + std::string(text), "");
    Value value = to_value(table.as_table().at("value"), name, OriginOf(origin));
    return Entry{name, std::move(value), origin};
  } catch (const toml::exception&) {
    return std::nullopt;
  }
}

}  // namespace tessera::config

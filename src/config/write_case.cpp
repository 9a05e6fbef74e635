// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "config/key_table.hpp"

namespace tessera::config {
namespace {

// Writes "[table]" before the first key of each table.
class TableHeadings {
 public:
  explicit TableHeadings(std::string& out) : out_(out) {}

  void before(const Key& key)
  {
    const std::string_view table = table_of(key.name);
    if (table == current_) return;
    out_ += fmt::format("{}[{}]\n", current_.empty() ? "" : "\n", table);
    current_ = table;
  }

 private:
  std::string& out_;
  std::string_view current_{};
};

void write_comment(std::string& out, const std::string& text)
{
  constexpr std::size_t kWidth = 96;
  std::istringstream words(text);
  std::string line = "#";
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kWidth) {
      out += line + '\n';
      line = "#  ";
    }
    line += ' ' + word;
  }
  out += line + '\n';
}

void write_reference_entry(std::string& out, const Key& key)
{
  const std::optional<std::string> constant = toml_value(key.rule, Case{});
  const std::string derived(key.derived_default.empty() ? "none" : key.derived_default);

  out += '\n';
  write_comment(out, std::string(key.meaning));
  if (!key.unit.empty()) write_comment(out, fmt::format("Unit: {}.", key.unit));
  write_comment(out, fmt::format("Allowed: {}.", allowed(key.rule)));
  write_comment(out,
                fmt::format("Default: {}, because: {}.", constant.value_or(derived), key.reason));
  // The reference is itself a case with every default, so what has none is only shown.
  out += fmt::format("{}{} = {}\n", key.is_optional ? "# " : "", last_part(key.name),
                     constant.value_or(std::string(key.example)));
}

// Commented out as a whole: the reference is a case without any of them.
void write_reference_list(std::string& out, const TableList& list)
{
  out += '\n';
  write_comment(out, std::string(list.meaning));
  write_comment(out, fmt::format("Allowed: {}.", allowed(list)));
  write_comment(out, fmt::format("Default: none, because: {}.", list.reason));
  out += fmt::format("# [[{}]]\n", list.name);
  for (const Key& key : list.keys) {
    const std::string_view alternative = alternative_of(list, key);
    const bool is_shown = alternative.empty() || alternative == list.alternatives.front();
    const std::string_view standard = key.derived_default.empty() ? "none" : key.derived_default;
    out += '\n';
    write_comment(out, std::string(key.meaning));
    if (!key.unit.empty()) write_comment(out, fmt::format("Unit: {}.", key.unit));
    write_comment(out, fmt::format("Allowed: {}.", allowed(key.rule)));
    write_comment(out, fmt::format("Default: {}, because: {}.", standard, key.reason));
    out +=
        fmt::format("# {}{} = {}\n", is_shown ? "" : "or ", name_in_list(list, key), key.example);
  }
}

void write_list(std::string& out, const TableList& list, const Case& resolved)
{
  for (std::size_t size = 1; size <= list.size(resolved); ++size) {
    Case shortened = resolved;  // The rules of the keys see the last element.
    list.resize(shortened, size);
    out += fmt::format("\n[[{}]]\n", list.name);
    for (const Key& key : list.keys) {
      const std::optional<std::string> value = toml_value(key.rule, shortened);
      if (value) out += fmt::format("{} = {}\n", name_in_list(list, key), *value);
    }
  }
}

// A number that the key cannot have, and that does not say either that none is given.
template <class NumberRule>
std::optional<std::string> wrong_value(const NumberRule& rule, const Case& given)
{
  Case copy = given;  // The rules hand out references.
  Case standard;
  const auto value = rule.field(copy);
  if (toml_value(rule, given) || value == rule.field(standard)) return std::nullopt;
  return fmt::to_string(value);
}

std::optional<std::string> wrong_number(const Rule& rule, const Case& given)
{
  if (const auto* real = std::get_if<RealRule>(&rule)) return wrong_value(*real, given);
  if (const auto* integer = std::get_if<IntegerRule>(&rule)) return wrong_value(*integer, given);
  return std::nullopt;
}

}  // namespace

void require_in_range(const Case& given, const std::string& where)
{
  for (const Key& key : all_keys()) {
    const std::optional<std::string> value = wrong_number(key.rule, given);
    if (!value) continue;
    throw ConfigError(
        fmt::format("{}: {} = {}: must be {}", where, key.name, *value, allowed(key.rule)));
  }
}

std::string to_toml(const Case& resolved)
{
  std::string out;
  TableHeadings headings(out);
  for (const Key& key : all_keys()) {
    const std::optional<std::string> value = toml_value(key.rule, resolved);
    if (!value) continue;
    headings.before(key);
    out += fmt::format("{} = {}\n", last_part(key.name), *value);
  }
  for (const TableList& list : all_table_lists()) write_list(out, list, resolved);
  return out;
}

std::string reference_toml()
{
  std::string out =
      "# Every key of a case file. Made from the program's key table by the target\n"
      "# `update_reference`; do not edit. A line `--set table.key=value` overrides a key.\n\n";
  TableHeadings headings(out);
  for (const Key& key : all_keys()) {
    headings.before(key);
    write_reference_entry(out, key);
  }
  for (const TableList& list : all_table_lists()) write_reference_list(out, list);
  return out;
}

std::vector<KnownKey> known_keys()
{
  std::vector<KnownKey> known;
  for (const Key& key : all_keys()) {
    KnownKey& entry = known.emplace_back(KnownKey{.name = key.name});
    entry.is_path = std::holds_alternative<PathRule>(key.rule);
    if (const auto* word = std::get_if<WordRule>(&key.rule)) {
      entry.words.assign(word->words.begin(), word->words.end());
    } else if (std::holds_alternative<FlagRule>(key.rule)) {
      entry.words = {"true", "false"};
    } else if (std::holds_alternative<SwitchRule>(key.rule)) {
      entry.words = {"true", "false", "auto"};
    }
  }
  return known;
}

}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "tessera/config/case.hpp"

#include "config/key_table.hpp"

namespace tessera::config {
namespace {

bool is_given(std::string_view name, const Case& from)
{
  const Key* key = find_key(name);
  return key != nullptr && toml_value(key->rule, from).has_value();
}

// Writes "[table]" before the first key of each table.
class TableHeadings {
 public:
  explicit TableHeadings(std::ostream& out) : out_(out) {}

  void before(const Key& key)
  {
    const std::string_view table = table_of(key.name);
    if (table == current_) return;
    out_ << (current_.empty() ? "" : "\n") << '[' << table << "]\n";
    current_ = table;
  }

 private:
  std::ostream& out_;
  std::string_view current_{};
};

void write_comment(std::ostream& out, const std::string& text)
{
  constexpr std::size_t kWidth = 96;
  std::istringstream words(text);
  std::string line = "#";
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kWidth) {
      out << line << '\n';
      line = "#  ";
    }
    line += ' ' + word;
  }
  out << line << '\n';
}

void write_reference_entry(std::ostream& out, const Key& key)
{
  const std::optional<std::string> constant = toml_value(key.rule, Case{});
  const std::string derived(key.derived_default.empty() ? "none" : key.derived_default);

  out << '\n';
  write_comment(out, std::string(key.meaning));
  if (!key.unit.empty()) write_comment(out, "Unit: " + std::string(key.unit) + ".");
  write_comment(out, "Allowed: " + allowed(key.rule) + ".");
  write_comment(out, "Default: " + constant.value_or(derived)
                         + ", because: " + std::string(key.reason) + ".");
  // The reference is itself a case with every default, so what has none is only shown.
  out << (key.is_optional ? "# " : "") << last_part(key.name) << " = "
      << constant.value_or(std::string(key.example)) << '\n';
}

// Commented out as a whole: the reference is a case without any of them.
void write_reference_list(std::ostream& out, const TableList& list)
{
  out << '\n';
  write_comment(out, std::string(list.meaning));
  write_comment(out, "Allowed: " + allowed(list) + ".");
  write_comment(out, "Default: none, because: " + std::string(list.reason) + ".");
  out << "# [[" << list.name << "]]\n";
  for (const Key& key : list.keys) {
    out << '\n';
    write_comment(out, std::string(key.meaning));
    write_comment(out, "Allowed: " + allowed(key.rule) + ".");
    write_comment(out, "Default: none, because: " + std::string(key.reason) + ".");
    out << "# " << last_part(key.name) << " = " << key.example << '\n';
  }
}

void write_list(std::ostream& out, const TableList& list, const Case& resolved)
{
  for (std::size_t size = 1; size <= list.size(resolved); ++size) {
    Case shortened = resolved;  // The rules of the keys see the last element.
    list.resize(shortened, size);
    out << "\n[[" << list.name << "]]\n";
    for (const Key& key : list.keys) {
      out << last_part(key.name) << " = " << toml_value(key.rule, shortened).value() << '\n';
    }
  }
}

}  // namespace

std::string to_toml(const Case& resolved)
{
  std::ostringstream out;
  TableHeadings headings(out);
  for (const Key& key : all_keys()) {
    const std::optional<std::string> value = toml_value(key.rule, resolved);
    if (!value) continue;
    if (!key.excluded_by.empty() && is_given(key.excluded_by, resolved)) continue;
    headings.before(key);
    out << last_part(key.name) << " = " << *value << '\n';
  }
  for (const TableList& list : all_table_lists()) write_list(out, list, resolved);
  return out.str();
}

std::string reference_toml()
{
  std::ostringstream out;
  out << "# Every key of a case file. Made from the program's key table by the target\n"
         "# `update_reference`; do not edit. A line `--set table.key=value` overrides a key.\n\n";
  TableHeadings headings(out);
  for (const Key& key : all_keys()) {
    headings.before(key);
    write_reference_entry(out, key);
  }
  for (const TableList& list : all_table_lists()) write_reference_list(out, list);
  return out.str();
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
    }
  }
  return known;
}

}  // namespace tessera::config

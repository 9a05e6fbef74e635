// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tessera::config {

/// @brief A value that no key takes, and the word for it in messages ("a date").
struct OtherValue {
  std::string kind{};
};

struct Entry;  // No initializers where it is incomplete: they would need its destructor.

/// @brief A table that stands in a list, such as one `[[fill.region]]`.
struct Table {
  std::vector<Entry> entries;  ///< In the order of their lines.
  std::string origin{};        ///< Where it begins.
};

/// @brief One value of a TOML file, free of toml11's types.
struct Value {
  std::variant<bool, std::int64_t, double, std::string, std::vector<Value>, Table, OtherValue> data;
};

/// @brief The value as a user would write it, on one line.
[[nodiscard]] std::string value_text(const Value& value);

/// @brief A table without keys: the `kind` of the OtherValue that stands for it.
inline constexpr std::string_view kEmptyTable = "an empty table";

/// @brief One `key = value` of a TOML file, its tables joined into the name ("coarse.max_size").
struct Entry {
  std::string name{};
  Value value{};
  std::string origin{};  ///< Where it stands, for messages: "case.toml:3" or "--set coarse.…".
};

/// @brief All entries of a TOML text, in the order of their lines. A table without keys is an entry
/// with kEmptyTable.
/// @throws ConfigError with file and line if the text is not TOML or holds a key twice.
[[nodiscard]] std::vector<Entry> parse_toml(std::string_view text, const std::string& file_name);

/// @brief The entry `name` with a single TOML value (`0.3`, `"text"`, `["pvtu"]`), or nothing if
/// the text is none. It and all within it have the origin given.
[[nodiscard]] std::optional<Entry> parse_toml_value(std::string_view text, const std::string& name,
                                                    const std::string& origin);

}  // namespace tessera::config

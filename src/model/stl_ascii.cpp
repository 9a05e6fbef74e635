// SPDX-License-Identifier: BSD-3-Clause
#include "stl_ascii.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "file_cursor.hpp"

namespace tessera::model {
namespace {

constexpr std::string_view kSpaces = " \t\r\n\v\f";

bool equal_ignoring_case(std::string_view word, std::string_view keyword)
{
  if (word.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(word[i])) != keyword[i]) return false;
  }
  return true;
}

std::string_view trimmed(std::string_view text)
{
  const auto first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

class AsciiReader {
 public:
  AsciiReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  TriangleSoup read()
  {
    while (!at_end()) read_solid();
    return std::move(soup_);
  }

 private:
  void read_solid()
  {
    expect("solid");
    soup_.solid_names.emplace_back(rest_of_line());
    for (;;) {
      const std::string_view word = next_word("facet' or 'endsolid");
      if (equal_ignoring_case(word, "endsolid")) break;
      if (!equal_ignoring_case(word, "facet")) fail("facet' or 'endsolid", word);
      read_facet();
    }
    rest_of_line();  // endsolid may repeat the name
  }

  // The word `facet` has been read.
  void read_facet()
  {
    expect("normal");
    for (int i = 0; i < 3; ++i)
      next_word("a component of the normal");  // may be anything, even nan
    expect("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      for (int axis = 0; axis < 3; ++axis) soup_.corner_xyz.push_back(read_coordinate());
    }
    expect("endloop");
    expect("endfacet");
    soup_.triangle_solid.push_back(static_cast<LocalIndex>(soup_.solid_names.size()) - 1);
  }

  double read_coordinate()
  {
    std::string_view word = next_word("a coordinate");
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw InputError(
          fmt::format("{}coordinate '{}' is not a finite number", here(), printable(word)));
    }
    return value;
  }

  void expect(std::string_view keyword)
  {
    const std::string_view word = next_word(keyword);
    if (!equal_ignoring_case(word, keyword)) fail(keyword, word);
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const
  {
    throw InputError(
        fmt::format("{}expected '{}', found '{}'", here(), expected, printable(found)));
  }

  [[nodiscard]] std::string here() const { return fmt::format("{}:{}: ", name_, line_); }

  bool at_end()
  {
    skip_spaces();
    return at_ == text_.size();
  }

  void skip_spaces()
  {
    while (at_ < text_.size() && kSpaces.find(text_[at_]) != std::string_view::npos) {
      if (text_[at_++] == '\n') ++line_;
    }
  }

  std::string_view next_word(std::string_view expected)
  {
    if (at_end()) {
      throw InputError(
          fmt::format("{}file is truncated: it ends where '{}' should stand", here(), expected));
    }
    const std::size_t first = at_;
    at_ = std::min(text_.find_first_of(kSpaces, first), text_.size());
    return text_.substr(first, at_ - first);
  }

  // Without the line's end, which counts for the next word.
  std::string_view rest_of_line()
  {
    const std::size_t first = at_;
    at_ = std::min(text_.find('\n', first), text_.size());
    return trimmed(text_.substr(first, at_ - first));
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  TriangleSoup soup_{};
};

}  // namespace

TriangleSoup parse_ascii_stl(std::string_view text, const std::string& name)
{
  return AsciiReader(text, name).read();
}

}  // namespace tessera::model

// SPDX-License-Identifier: BSD-3-Clause
#include "file_cursor.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::model {
namespace {

constexpr std::string_view kSpaces = " \t\r\n\v\f";

template <class T>
bool parse(std::string_view word, T& value)
{
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(file.string() + ": no such file");
  }
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.good() && !in.eof()) throw InputError(file.string() + ": cannot be read");
  if (bytes.empty()) throw InputError(file.string() + ": is empty, or cannot be read");
  return bytes;
}

std::string printable(std::string_view word)
{
  constexpr std::size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  for (char& c : text) {
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  }
  return text;
}

bool FileCursor::at_end()
{
  at_ = std::min(bytes_.find_first_not_of(kSpaces, at_), bytes_.size());
  return at_ == bytes_.size();
}

std::string_view FileCursor::word(std::string_view expected)
{
  if (at_end()) fail_truncated(expected);
  const std::size_t first = at_;
  at_ = std::min(bytes_.find_first_of(kSpaces, first), bytes_.size());
  return bytes_.substr(first, at_ - first);
}

std::string_view FileCursor::line()
{
  const std::size_t first = at_;
  const std::size_t last = std::min(bytes_.find('\n', first), bytes_.size());
  at_ = std::min(last + 1, bytes_.size());
  std::string_view text = bytes_.substr(first, last - first);
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

void FileCursor::expect(std::string_view expected)
{
  const std::string_view found = word(expected);
  if (found != expected) fail(fmt::format("expected {}, found '{}'", expected, printable(found)));
}

void FileCursor::skip_behind(std::string_view text)
{
  const std::size_t found = bytes_.find(text, at_);
  if (found == std::string_view::npos) fail_truncated(text);
  at_ = found + text.size();
}

void FileCursor::skip_line_end()
{
  if (at_ < bytes_.size() && bytes_[at_] == '\r') ++at_;
  if (at_ >= bytes_.size() || bytes_[at_] != '\n') fail("expected the end of the line");
  ++at_;
}

double FileCursor::coordinate()
{
  const double value = number<double>("a coordinate");
  if (!std::isfinite(value)) fail("a coordinate is not a finite number");
  return value;
}

std::int64_t FileCursor::integer(std::string_view expected)
{
  const std::string_view text = word(expected);
  std::int64_t value = 0;
  if (!parse(text, value)) {
    fail(fmt::format("expected {}, found '{}'", expected, printable(text)));
  }
  return value;
}

double FileCursor::real(std::string_view expected)
{
  const std::string_view text = word(expected);
  double value = 0.0;
  if (!parse(text, value)) {
    fail(fmt::format("expected {}, found '{}'", expected, printable(text)));
  }
  return value;
}

std::size_t FileCursor::checked_count(std::int64_t value, std::string_view what,
                                      std::size_t least_bytes) const
{
  const std::size_t left = bytes_.size() - at_;
  const bool is_possible = value >= 0 && value <= std::numeric_limits<std::int32_t>::max()
                           && static_cast<std::size_t>(value) * least_bytes <= left;
  if (!is_possible) {
    fail(fmt::format("{} is {}, but only {} bytes follow: the file is truncated or damaged", what,
                     value, left));
  }
  return static_cast<std::size_t>(value);
}

void FileCursor::fail(const std::string& what) const
{
  if (is_binary_) throw InputError(fmt::format("{}: byte {}: {}", name_, at_, what));
  const auto read = bytes_.substr(0, at_);
  throw InputError(
      fmt::format("{}:{}: {}", name_, 1 + std::count(read.begin(), read.end(), '\n'), what));
}

void FileCursor::fail_truncated(std::string_view expected) const
{
  fail(fmt::format("the file is truncated: it ends where {} should stand", expected));
}

}  // namespace tessera::model

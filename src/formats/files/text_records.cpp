// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files/text_records.hpp"

#include <array>
#include <charconv>

namespace tessera::formats {
namespace {

using Characters = std::array<char, 32>;

std::string_view until(const Characters& characters, const char* end)
{
  return {characters.data(), static_cast<std::size_t>(end - characters.data())};
}

}  // namespace

std::size_t num_digits(GlobalIndex number)
{
  std::size_t count = 1;
  for (; number >= 10; number /= 10) ++count;
  return count;
}

TextRecords& TextRecords::integer(GlobalIndex number, std::size_t width)
{
  Characters characters;
  const auto done = std::to_chars(characters.data(), characters.data() + characters.size(), number);
  right_aligned(until(characters, done.ptr), width);
  return *this;
}

TextRecords& TextRecords::real(double number, std::size_t width)
{
  Characters characters;
  char* const end = characters.data() + characters.size();
  std::string_view field = until(characters, std::to_chars(characters.data(), end, number).ptr);
  for (int digits = 16; field.size() > width; --digits) {
    const auto done =
        std::to_chars(characters.data(), end, number, std::chars_format::general, digits);
    field = until(characters, done.ptr);
  }
  right_aligned(field, width);
  return *this;
}

void TextRecords::right_aligned(std::string_view field, std::size_t width)
{
  text_.append(width - field.size(), ' ');
  text_ += field;
}

}  // namespace tessera::formats

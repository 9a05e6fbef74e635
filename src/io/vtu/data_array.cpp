// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu/data_array.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "io/vtu/decompress.hpp"

namespace tessera::io {
namespace {

/// No compressor of VTK packs better (zlib 1032, LZ4 255, LZMA a few thousand); a block that claims
/// to is corrupt, and its size must not be allocated.
constexpr std::size_t kMaxCompressionRatio = 8192;

void require(bool condition, const char* what)
{
  if (!condition) throw InputError(what);
}

constexpr const char* kCutOff = "binary data are cut off or corrupt";

[[nodiscard]] int base64_digit(char character)
{
  if (character >= 'A' && character <= 'Z') return character - 'A';
  if (character >= 'a' && character <= 'z') return character - 'a' + 26;
  if (character >= '0' && character <= '9') return character - '0' + 52;
  if (character == '+') return 62;
  if (character == '/') return 63;
  throw InputError("base64 data hold a character that is none of theirs");
}

/// @brief Bytes of one stored array, taken from the front in runs, raw or base64.
class Source {
 public:
  explicit Source(std::string_view base64) : base64_(base64)
  {
    base64_.remove_prefix(std::min(base64_.find_first_not_of(" \t\r\n"), base64_.size()));
  }
  Source(const StoredBytes& raw, std::size_t begin) : raw_(&raw), at_(begin) {}

  /// Takes a run of `size` bytes; in base64, the run has its own padding.
  [[nodiscard]] Bytes take(std::size_t size)
  {
    Bytes bytes = peek(0, size);
    if (raw_ != nullptr)
      at_ += size;
    else
      base64_.remove_prefix(num_digits(size));
    return bytes;
  }

  /// Bytes from `begin` to `end` of the next run, which may be longer.
  [[nodiscard]] Bytes peek(std::size_t begin, std::size_t end) const
  {
    if (raw_ != nullptr) {
      require(end <= raw_->size() - at_, kCutOff);
      return raw_->read(at_ + begin, at_ + end);
    }
    require(end <= base64_.size(), kCutOff);  // Rules out overflows.
    Bytes bytes = decode_base64(end);
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(begin));
    return bytes;
  }

 private:
  [[nodiscard]] static std::size_t num_digits(std::size_t size) { return (size + 2) / 3 * 4; }

  [[nodiscard]] Bytes decode_base64(std::size_t size) const
  {
    require(num_digits(size) <= base64_.size(), kCutOff);
    Bytes bytes;
    bytes.reserve(size + 2);
    for (std::size_t at = 0; bytes.size() < size; at += 4) {
      std::uint32_t triple = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const char character = base64_[at + i];
        const int digit = character == '=' ? 0 : base64_digit(character);
        triple = triple << 6U | static_cast<std::uint32_t>(digit);
      }
      for (const unsigned shift : {16U, 8U, 0U}) {
        bytes.push_back(static_cast<std::byte>(triple >> shift & 0xffU));
      }
    }
    bytes.resize(size);
    return bytes;
  }

  std::string_view base64_{};
  const StoredBytes* raw_ = nullptr;  // If it is not base64.
  std::size_t at_ = 0;
};

void swap_words(std::span<std::byte> bytes, std::size_t word)
{
  for (std::size_t at = 0; at + word <= bytes.size(); at += word) {
    std::ranges::reverse(bytes.subspan(at, word));
  }
}

template <class Word>
[[nodiscard]] std::vector<std::size_t> words_of(std::span<const std::byte> bytes)
{
  std::vector<std::size_t> words;
  for (std::size_t at = 0; at + sizeof(Word) <= bytes.size(); at += sizeof(Word)) {
    Word word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof(Word));
    words.push_back(word);
  }
  return words;
}

/// @brief The sizes in a header, whatever their width and byte order.
[[nodiscard]] std::vector<std::size_t> header_words(Bytes bytes, const Encoding& encoding)
{
  if (encoding.swap_bytes) swap_words(bytes, encoding.header_word);
  return encoding.header_word == 8 ? words_of<std::uint64_t>(bytes)
                                   : words_of<std::uint32_t>(bytes);
}

/// @brief [number of bytes][bytes], one run.
[[nodiscard]] Bytes decode_plain(const Source& source, const Encoding& encoding)
{
  const std::size_t word = encoding.header_word;
  const std::size_t size = header_words(source.peek(0, word), encoding).front();
  require(size <= SIZE_MAX - word, kCutOff);
  return source.peek(word, word + size);
}

/// @brief [number of blocks][size of a block][size of the last if smaller][compressed sizes…], then
/// the compressed blocks as a second run.
[[nodiscard]] Bytes decode_compressed(Source source, const Encoding& encoding)
{
  const std::size_t word = encoding.header_word;
  const std::size_t num_blocks = header_words(source.peek(0, word), encoding).front();
  if (num_blocks == 0) return {};
  require(num_blocks <= SIZE_MAX / word - 3, kCutOff);
  const auto header = header_words(source.take((3 + num_blocks) * word), encoding);
  const std::size_t block_size = header[1];
  const std::size_t last_size = header[2] == 0 ? block_size : header[2];
  require(last_size <= block_size, kCutOff);

  std::size_t num_compressed = 0;
  for (std::size_t i = 0; i < num_blocks; ++i) {
    const std::size_t size = header[3 + i];
    require(size <= SIZE_MAX / kMaxCompressionRatio - num_compressed, kCutOff);
    num_compressed += size;
  }
  const Bytes compressed = source.take(num_compressed);
  std::vector<CompressedBlock> blocks;
  auto rest = std::span(compressed);
  for (std::size_t i = 0; i < num_blocks; ++i) {
    const CompressedBlock block{rest.first(header[3 + i]),
                                i + 1 == num_blocks ? last_size : block_size};
    require(block.size / kMaxCompressionRatio <= block.from.size(), kCutOff);
    blocks.push_back(block);
    rest = rest.subspan(block.from.size());
  }
  return decompress(encoding.compressor, blocks);
}

template <class T>
[[nodiscard]] Bytes parse_numbers(std::string_view text)
{
  std::vector<T> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && std::isspace(static_cast<unsigned char>(*at)) != 0) ++at;
    if (at == end) break;
    if (*at == '+') ++at;
    T value{};
    const auto [next, error] = std::from_chars(at, end, value);
    require(error == std::errc(),
            "an array in text form holds something that is no number of its type");
    values.push_back(value);
    at = next;
  }
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

[[nodiscard]] Bytes parse_numbers(std::string_view text, ScalarType type)
{
  switch (type) {
    case ScalarType::i8:
      return parse_numbers<std::int8_t>(text);
    case ScalarType::u8:
      return parse_numbers<std::uint8_t>(text);
    case ScalarType::i16:
      return parse_numbers<std::int16_t>(text);
    case ScalarType::u16:
      return parse_numbers<std::uint16_t>(text);
    case ScalarType::i32:
      return parse_numbers<std::int32_t>(text);
    case ScalarType::u32:
      return parse_numbers<std::uint32_t>(text);
    case ScalarType::i64:
      return parse_numbers<std::int64_t>(text);
    case ScalarType::u64:
      return parse_numbers<std::uint64_t>(text);
    case ScalarType::f32:
      return parse_numbers<float>(text);
    case ScalarType::f64:
      break;
  }
  return parse_numbers<double>(text);
}

[[nodiscard]] std::size_t size_of(ScalarType type)
{
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

[[nodiscard]] Bytes decode_binary(Source source, const Encoding& encoding)
{
  return encoding.compressor.empty() ? decode_plain(source, encoding)
                                     : decode_compressed(source, encoding);
}

/// @brief Base64 text without the line breaks that some writers put into it.
[[nodiscard]] std::string without_space(std::string_view text)
{
  std::string dense(text);
  std::erase_if(dense, [](unsigned char character) { return std::isspace(character) != 0; });
  return dense;
}

}  // namespace

Encoding encoding_of(const XmlDocument& document)
{
  const XmlElement& root = document.root;
  const bool is_big = root.attribute_or("byte_order", "LittleEndian") == "BigEndian";
  Encoding encoding;
  encoding.swap_bytes = is_big != (std::endian::native == std::endian::big);
  encoding.header_word = root.attribute_or("header_type", "UInt32") == "UInt64" ? 8 : 4;
  encoding.compressor = root.attribute_or("compressor", "");
  encoding.appended = StoredBytes(document.appended);
  encoding.appended_is_base64 = document.appended_is_base64;
  return encoding;
}

std::size_t DataArray::num_values() const { return values.size() / size_of(type); }

ScalarType scalar_type_of(const XmlElement& element)
{
  const std::string& name = element.attribute("type");
  if (name == "String") return ScalarType::i8;
  const std::optional<ScalarType> type = value_of<ScalarType>(name);
  if (!type) throw InputError(fmt::format("type {} of an array is not known", name));
  return *type;
}

DataArray decode_array(const XmlElement& element, const Encoding& encoding)
{
  DataArray array;
  array.type = scalar_type_of(element);
  if (element.attributes.contains("NumberOfComponents")) {
    array.num_components = std::max<std::size_t>(1, element.count_attribute("NumberOfComponents"));
  }
  const std::string format = element.attribute_or("format", "ascii");
  if (format == "ascii") {
    array.values = parse_numbers(element.text, array.type);
    return array;
  }
  if (format == "binary") {
    const std::string text = without_space(element.text);
    if (text.empty()) return array;
    array.values = decode_binary(Source(text), encoding);
  } else {
    require(format == "appended", "the format of an array is not known");
    const std::size_t offset = element.count_attribute("offset");
    require(offset < encoding.appended.size(), "an array begins behind the end of the file");
    const Source source = encoding.appended_is_base64
                              ? Source(encoding.appended.in_memory().substr(offset))
                              : Source(encoding.appended, offset);
    array.values = decode_binary(source, encoding);
  }
  require(array.values.size() % size_of(array.type) == 0, kCutOff);
  if (encoding.swap_bytes) swap_words(array.values, size_of(array.type));
  return array;
}

}  // namespace tessera::io

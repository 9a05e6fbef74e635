// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/deflate.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tessera::pipeline {
namespace {

using Octets = std::vector<std::uint8_t>;

constexpr std::size_t kShortestMatch = 3;
constexpr std::size_t kLongestMatch = 258;
constexpr std::size_t kFarthestMatch = 32768;

// Values that share one code: the first of them, and how many bits tell them apart.
struct CodeRange {
  std::uint32_t first;
  int extra_bits;
};

// By code from 257 (RFC 1951, 3.2.5).
constexpr std::array<CodeRange, 29> kLengths{
    {{3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
     {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
     {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}}};

constexpr std::array<CodeRange, 30> kDistances{
    {{1, 0},     {2, 0},     {3, 0},     {4, 0},      {5, 1},      {7, 1},
     {9, 2},     {13, 2},    {17, 3},    {25, 3},     {33, 4},     {49, 4},
     {65, 5},    {97, 5},    {129, 6},   {193, 6},    {257, 7},    {385, 7},
     {513, 8},   {769, 8},   {1025, 9},  {1537, 9},   {2049, 10},  {3073, 10},
     {4097, 11}, {6145, 11}, {8193, 12}, {12289, 12}, {16385, 13}, {24577, 13}}};

template <std::size_t N>
std::uint32_t code_of(const std::array<CodeRange, N>& ranges, std::size_t value)
{
  const auto above = std::ranges::upper_bound(ranges, value, {}, &CodeRange::first);
  return static_cast<std::uint32_t>(above - ranges.begin()) - 1;
}

class BitWriter {
 public:
  // The lowest bit first.
  void put(std::uint32_t bits, int count)
  {
    held_ |= static_cast<std::uint64_t>(bits) << num_held_;
    num_held_ += count;
    for (; num_held_ >= 8; num_held_ -= 8, held_ >>= 8U) {
      octets_.push_back(static_cast<std::uint8_t>(held_ & 0xffU));
    }
  }

  // A Huffman code goes the other way round.
  void put_code(std::uint32_t code, int count)
  {
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < count; ++bit) reversed = (reversed << 1U) | ((code >> bit) & 1U);
    put(reversed, count);
  }

  void put_symbol(std::uint32_t symbol)
  {
    if (symbol < 144) return put_code(0x30 + symbol, 8);
    if (symbol < 256) return put_code(0x190 + symbol - 144, 9);
    if (symbol < 280) return put_code(symbol - 256, 7);
    put_code(0xc0 + symbol - 280, 8);
  }

  void put_match(std::size_t length, std::size_t distance)
  {
    const std::uint32_t l = code_of(kLengths, length);
    put_symbol(257 + l);
    put(static_cast<std::uint32_t>(length) - kLengths[l].first, kLengths[l].extra_bits);
    const std::uint32_t d = code_of(kDistances, distance);
    put_code(d, 5);
    put(static_cast<std::uint32_t>(distance) - kDistances[d].first, kDistances[d].extra_bits);
  }

  [[nodiscard]] Octets finish() &&
  {
    if (num_held_ > 0) put(0, 8 - num_held_);
    return std::move(octets_);
  }

 private:
  Octets octets_{};
  std::uint64_t held_ = 0;
  int num_held_ = 0;
};

struct Match {
  std::size_t length = 0;
  std::size_t distance = 0;
};

// Finds where bytes have stood before, by chains of places with the same three bytes.
class Matcher {
 public:
  explicit Matcher(std::span<const std::uint8_t> data)
      : data_(data), last_(kNumChains, kNone), before_(data.size(), kNone)
  {
  }

  [[nodiscard]] Match find(std::size_t at) const
  {
    Match best;
    if (at + kShortestMatch > data_.size()) return best;
    const std::size_t most = std::min(kLongestMatch, data_.size() - at);
    std::size_t place = last_[chain(at)];
    for (int tries = 0; tries < kMostTries && place != kNone; ++tries, place = before_[place]) {
      if (at - place > kFarthestMatch) break;
      const auto begin = data_.begin() + static_cast<std::ptrdiff_t>(at);
      const auto end = begin + static_cast<std::ptrdiff_t>(most);
      const auto other = data_.begin() + static_cast<std::ptrdiff_t>(place);
      const auto length = static_cast<std::size_t>(std::mismatch(begin, end, other).first - begin);
      if (length > best.length) best = {length, at - place};
      if (length == most) break;
    }
    return best.length < kShortestMatch ? Match{} : best;
  }

  void add(std::size_t at)
  {
    if (at + kShortestMatch > data_.size()) return;
    std::size_t& last = last_[chain(at)];
    before_[at] = last;
    last = at;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  static constexpr std::size_t kNumChains = 32768;
  static constexpr int kMostTries = 16;

  [[nodiscard]] std::size_t chain(std::size_t at) const
  {
    const std::uint32_t three = data_[at] | static_cast<std::uint32_t>(data_[at + 1]) << 8U
                                | static_cast<std::uint32_t>(data_[at + 2]) << 16U;
    return (three * 2654435761U) >> 17U;
  }

  std::span<const std::uint8_t> data_;
  std::vector<std::size_t> last_;
  std::vector<std::size_t> before_;
};

std::uint32_t adler_of(std::span<const std::uint8_t> octets)
{
  constexpr std::uint32_t kModulus = 65521;
  std::uint32_t low = 1;
  std::uint32_t high = 0;
  for (const std::uint8_t octet : octets) {
    low = (low + octet) % kModulus;
    high = (high + low) % kModulus;
  }
  return (high << 16U) | low;
}

}  // namespace

std::vector<std::uint8_t> to_zlib(std::span<const std::uint8_t> data)
{
  constexpr std::uint32_t kEndOfBlock = 256;
  BitWriter out;
  out.put(0x0178, 16);  // Deflate, a window of 32 KiB.
  out.put(1, 1);        // The last block,
  out.put(1, 2);        // with the fixed codes.
  Matcher matcher(data);
  for (std::size_t at = 0; at < data.size();) {
    const Match match = matcher.find(at);
    if (match.length == 0) {
      out.put_symbol(data[at]);
    } else {
      out.put_match(match.length, match.distance);
    }
    for (std::size_t end = at + std::max<std::size_t>(match.length, 1); at < end; ++at) {
      matcher.add(at);
    }
  }
  out.put_symbol(kEndOfBlock);
  Octets stream = std::move(out).finish();
  const std::uint32_t sum = adler_of(data);
  for (int shift = 24; shift >= 0; shift -= 8) {
    stream.push_back(static_cast<std::uint8_t>(sum >> shift));
  }
  return stream;
}

}  // namespace tessera::pipeline

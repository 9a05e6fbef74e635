// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/io/open_files.hpp"

/// The bytes of a record: a head, then one SegmentHead a segment, then the segments. So a reader
/// takes out one segment, and knows that it is what was written. All functions are local.
namespace tessera::io {

struct SegmentHead {
  std::uint64_t size = 0;
  Hash128 hash{};
};
static_assert(sizeof(SegmentHead) == 24, "padding would leave bytes that are not set");

using SegmentHeads = std::vector<SegmentHead>;

/// @brief Borrowed bytes of segments.
using SegmentViews = std::vector<std::span<const std::byte>>;

[[nodiscard]] inline SegmentViews views_of(std::span<const Bytes> segments)
{
  return {segments.begin(), segments.end()};
}

[[nodiscard]] SegmentHeads heads_of(const SegmentViews& segments);

/// @brief Of a record's name and its segments.
[[nodiscard]] Hash128 hash_of(std::span<const std::byte> name,
                              std::span<const SegmentHead> segments);

/// @brief Bytes of the file. @throws OutputError
[[nodiscard]] std::uint64_t size_of_file(const OpenFile& file);

/// @brief Whether all of it was there. @throws OutputError
[[nodiscard]] bool read_at(const OpenFile& file, std::uint64_t offset, std::span<std::byte> bytes);

/// @brief The heads that stand there; nothing if the file is too short for them.
/// @param[in] num_segments May be garbage.
[[nodiscard]] std::optional<SegmentHeads> read_heads(const OpenFile& file, std::uint64_t offset,
                                                     std::uint64_t num_segments);

/// @brief One segment; nothing if it is cut off, altered or not there.
/// @param[in] offset Of the first segment.
[[nodiscard]] std::optional<Bytes> read_segment(const OpenFile& file, std::uint64_t offset,
                                                std::span<const SegmentHead> heads,
                                                std::size_t number);

}  // namespace tessera::io

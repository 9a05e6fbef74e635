// SPDX-License-Identifier: BSD-3-Clause
#include "io/segments.hpp"

#include <cerrno>

#include <unistd.h>

#include "io/atomic_file.hpp"

namespace tessera::io {

SegmentHeads heads_of(const SegmentViews& segments)
{
  SegmentHeads heads;
  heads.reserve(segments.size());
  for (const auto& segment : segments) heads.push_back({segment.size(), hash_bytes(segment)});
  return heads;
}

Hash128 hash_of(std::span<const std::byte> name, std::span<const SegmentHead> segments)
{
  Hash128 hash = hash_bytes(name);
  hash += hash_bytes(std::as_bytes(segments));
  return hash;
}

std::uint64_t size_of_file(const OpenFile& file)
{
  const off_t end = ::lseek(file.descriptor, 0, SEEK_END);
  if (end < 0) throw_cannot_read_back(file.path, errno);
  return static_cast<std::uint64_t>(end);
}

bool read_at(const OpenFile& file, std::uint64_t offset, std::span<std::byte> bytes)
{
  while (!bytes.empty()) {
    const ssize_t got =
        ::pread(file.descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_cannot_read_back(file.path, errno);
    if (got == 0) return false;
    offset += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

std::optional<SegmentHeads> read_heads(const OpenFile& file, std::uint64_t offset,
                                       std::uint64_t num_segments)
{
  const std::uint64_t end = size_of_file(file);
  if (offset > end || num_segments > (end - offset) / sizeof(SegmentHead)) return std::nullopt;
  SegmentHeads heads(num_segments);
  if (!read_at(file, offset, std::as_writable_bytes(std::span(heads)))) return std::nullopt;
  return heads;
}

std::optional<Bytes> read_segment(const OpenFile& file, std::uint64_t offset,
                                  std::span<const SegmentHead> heads, std::size_t number)
{
  if (number >= heads.size()) return std::nullopt;
  for (const SegmentHead& before : heads.first(number)) offset += before.size;
  const std::uint64_t end = size_of_file(file);
  if (offset > end || heads[number].size > end - offset) return std::nullopt;
  Bytes segment(heads[number].size);
  if (!read_at(file, offset, segment) || hash_bytes(segment) != heads[number].hash) {
    return std::nullopt;
  }
  return segment;
}

}  // namespace tessera::io

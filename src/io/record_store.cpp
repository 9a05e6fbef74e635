// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/record_store.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/io/files.hpp"

#include "io/atomic_file.hpp"
#include "io/segments.hpp"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".record";

/// First bytes of a record file. The hash is over name and segments, so that a file under a wrong
/// name is noticed.
struct Header {
  std::array<char, 8> magic{'T', 'S', 'R', 'E', 'C', 'O', 'R', 'D'};
  std::uint64_t version = 3;
  std::uint64_t num_segments = 0;
  Hash128 hash{};

  friend bool operator==(const Header&, const Header&) = default;
};
static_assert(sizeof(Header) == 40, "padding would leave bytes that are not set");

[[nodiscard]] Header header_of(const std::string& name, std::span<const SegmentHead> heads)
{
  Header header;
  header.num_segments = heads.size();
  header.hash = hash_of(std::as_bytes(std::span(name)), heads);
  return header;
}

// The heads of a record's segments, if they are sound and the file is as long as they say.
[[nodiscard]] std::optional<SegmentHeads> heads_of_file(const OpenFile& file,
                                                        const std::string& name)
{
  Header header;
  if (!read_at(file, 0, std::as_writable_bytes(std::span(&header, 1)))) return std::nullopt;
  auto heads = read_heads(file, sizeof(header), header.num_segments);
  if (!heads || header != header_of(name, *heads)) return std::nullopt;
  std::uint64_t size = sizeof(header) + heads->size() * sizeof(SegmentHead);
  for (const SegmentHead& head : *heads) size += head.size;
  return size == size_of_file(file) ? std::move(heads) : std::nullopt;
}

[[nodiscard]] fs::path file_path(const fs::path& folder, const std::string& name)
{
  return folder / (name + std::string(kSuffix));
}

void write_record(const fs::path& path, const std::string& name, const SegmentViews& segments)
{
  const SegmentHeads heads = heads_of(segments);
  const Header header = header_of(name, heads);
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(&header, 1)));
  file.write(std::as_bytes(std::span(heads)));
  for (const auto& segment : segments) file.write(segment);
  file.commit();
}

[[noreturn]] void throw_damaged(const fs::path& file)
{
  throw InputError(file.string() + " is cut off or altered");
}

[[nodiscard]] bool is_record_name(const std::string& name)
{
  return name.ends_with(kSuffix) || is_temporary_name(name);
}

void remove_file(const fs::path& file)
{
  std::error_code error;
  fs::remove(file, error);
  if (error) throw OutputError(fmt::format("cannot remove {}: {}", file.string(), error.message()));
}

}  // namespace

RecordStore::RecordStore(fs::path folder) : folder_(std::move(folder)) { make_own_folder(folder_); }

fs::path RecordStore::file_of(const std::string& name) const { return file_path(folder_, name); }

void RecordStore::put(const std::string& name, std::span<const std::byte> record) const
{
  write_record(file_of(name), name, {record});
}

void RecordStore::put(const std::string& name, std::span<const Bytes> segments) const
{
  write_record(file_of(name), name, views_of(segments));
}

Bytes RecordStore::get(const std::string& name, LocalIndex segment) const
{
  return RecordReader(folder_).segment(name, segment);
}

std::optional<Bytes> RecordStore::find(const std::string& name) const
{
  if (!contains(name)) return std::nullopt;
  try {
    const RecordReader reader(folder_);
    const LocalIndex num_segments = reader.num_segments(name);
    for (LocalIndex i = 1; i < num_segments; ++i) static_cast<void>(reader.segment(name, i));
    return reader.segment(name, 0);
  } catch (const InputError&) {  // Damaged: who asks makes it again, as one that is missing.
    return std::nullopt;
  }
}

bool RecordStore::contains(const std::string& name) const
{
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(file_of(name), error));
}

void RecordStore::remove(const std::string& name) const { remove_file(file_of(name)); }

void RecordStore::remove_all() const
{
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    if (is_record_name(entry.path().filename().string())) remove_file(entry.path());
  }
  fs::remove(folder_, error);  // Fails, as it should, when something else is in it.
}

RecordReader::RecordReader(fs::path folder) : folder_(std::move(folder)) {}

LocalIndex RecordReader::num_segments(const std::string& name) const
{
  const fs::path path = file_path(folder_, name);
  const auto heads = heads_of_file(files_.open(path), name);
  if (!heads) throw_damaged(path);
  return static_cast<LocalIndex>(heads->size());
}

Bytes RecordReader::segment(const std::string& name, LocalIndex number) const
{
  const fs::path path = file_path(folder_, name);
  const OpenFile file = files_.open(path);
  const auto heads = heads_of_file(file, name);
  if (!heads) throw_damaged(path);
  const std::uint64_t first = sizeof(Header) + heads->size() * sizeof(SegmentHead);
  auto bytes = read_segment(file, first, *heads, at(number));
  if (!bytes) throw_damaged(path);
  return *std::move(bytes);
}

}  // namespace tessera::io

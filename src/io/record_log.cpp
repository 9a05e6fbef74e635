// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/record_log.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"

#include "io/atomic_file.hpp"
#include "io/segments.hpp"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "log_";
constexpr std::string_view kSuffix = ".record";  // So RecordStore::remove_all() removes it, too.

// What stands before the segments: this, then their sizes and hashes.
struct RecordHead {
  std::array<char, 8> magic{'T', 'S', 'R', 'E', 'C', 'L', 'O', 'G'};
  LocalIndex kind = 0;
  LocalIndex number = 0;
  std::uint64_t num_segments = 0;
  Hash128 hash{};  // hash_of() the record.
};
static_assert(sizeof(RecordHead) == 40, "padding would leave bytes that are not set");

std::uint64_t size_of_heads(std::uint64_t num_segments)
{
  return sizeof(RecordHead) + num_segments * sizeof(SegmentHead);
}

std::span<const std::byte> bytes_of(const LogName& name)
{
  return std::as_bytes(std::span(&name, 1));
}

fs::path file_path(const fs::path& folder, LocalIndex file)
{
  return folder / fmt::format("{}{:06}{}", kPrefix, file, kSuffix);
}

// The record there if it is whole; then `offset` becomes that of the next one.
std::optional<LogPlace> place_at(const OpenFile& file, std::uint64_t& offset)
{
  RecordHead head;
  if (!read_at(file, offset, std::as_writable_bytes(std::span(&head, 1)))) return {};
  if (head.magic != RecordHead().magic) return {};
  const auto heads = read_heads(file, offset + sizeof(head), head.num_segments);
  const LogName name{head.kind, head.number};
  if (!heads || head.hash != hash_of(bytes_of(name), *heads)) return {};
  const std::uint64_t first = offset + size_of_heads(heads->size());
  std::uint64_t next = first;
  for (std::size_t i = 0; i < heads->size(); ++i) {
    if (!read_segment(file, first, *heads, i)) return {};
    next += (*heads)[i].size;
  }
  return LogPlace{.name = name,
                  .num_segments = static_cast<LocalIndex>(heads->size()),
                  .offset = std::exchange(offset, next),
                  .head_hash = head.hash};
}

}  // namespace

LogWriter::LogWriter(fs::path folder, LocalIndex file) : path_(file_path(folder, file)), file_(file)
{
}

LogWriter::~LogWriter()
{
  if (descriptor_ >= 0) ::close(descriptor_);
}

// By way of a temporary file: it takes the place of a symbolic link, and follows none.
void LogWriter::open()
{
  write_text_atomically(path_, {});
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw OutputError(fmt::format("cannot write {}: {}", path_.string(), system_error_text(errno)));
  }
}

LogPlace LogWriter::append(const LogName& name, std::span<const Bytes> segments)
{
  if (descriptor_ < 0) open();
  const SegmentHeads heads = heads_of(views_of(segments));
  const LogPlace place{name, file_, static_cast<LocalIndex>(segments.size()), end_,
                       hash_of(bytes_of(name), heads)};
  const RecordHead head{.kind = name.kind,
                        .number = name.number,
                        .num_segments = heads.size(),
                        .hash = place.head_hash};
  // In one go: a call for each segment would cost more than the copy.
  Bytes all;
  const auto add = [&](std::span<const std::byte> bytes) {
    all.insert(all.end(), bytes.begin(), bytes.end());
  };
  add(std::as_bytes(std::span(&head, 1)));
  add(std::as_bytes(std::span(heads)));
  for (const Bytes& segment : segments) add(segment);
  write(all);
  end_ += all.size();
  return place;
}

void LogWriter::write(std::span<const std::byte> bytes)
{
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      throw OutputError(
          fmt::format("cannot write {}: {}", path_.string(), system_error_text(errno)));
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

LogReader::LogReader(fs::path folder) : folder_(std::move(folder)) {}

OpenFile LogReader::open(LocalIndex file) const { return files_.open(file_path(folder_, file)); }

Bytes LogReader::segment(const LogPlace& place, LocalIndex number) const
{
  const OpenFile file = open(place.file);
  const auto heads = read_heads(file, place.offset + sizeof(RecordHead), at(place.num_segments));
  std::optional<Bytes> segment;
  if (heads && hash_of(bytes_of(place.name), *heads) == place.head_hash) {
    segment = read_segment(file, place.offset + size_of_heads(heads->size()), *heads, at(number));
  }
  if (segment) return *std::move(segment);
  throw InputError(file_path(folder_, place.file).string() + " is cut off or altered");
}

std::vector<LocalIndex> LogReader::files() const
{
  std::vector<LocalIndex> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) continue;
    LocalIndex file = kNoIndex;
    const char* end = name.data() + name.size() - kSuffix.size();
    const auto [last, wrong] = std::from_chars(name.data() + kPrefix.size(), end, file);
    std::error_code ignored;
    const bool is_number = wrong == std::errc() && last == end && file >= 0;
    if (is_number && fs::is_regular_file(entry.symlink_status(ignored))) files.push_back(file);
  }
  std::ranges::sort(files);
  return files;
}

std::vector<LogPlace> LogReader::find_places(LocalIndex file) const
{
  const OpenFile opened = open(file);
  std::vector<LogPlace> places;
  std::uint64_t offset = 0;
  while (const auto place = place_at(opened, offset)) {
    places.push_back(*place);
    places.back().file = file;
  }
  return places;
}

void remove_logs(const fs::path& folder)
{
  for (const LocalIndex file : LogReader(folder).files()) {
    const fs::path path = file_path(folder, file);
    std::error_code error;
    fs::remove(path, error);
    if (error) {
      throw OutputError(fmt::format("cannot remove {}: {}", path.string(), error.message()));
    }
  }
}

}  // namespace tessera::io

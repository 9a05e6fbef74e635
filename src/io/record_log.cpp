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

#include "atomic_file.hpp"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "log_";
constexpr std::string_view kSuffix = ".record";  // So RecordStore::remove_all() removes it, too.
constexpr std::size_t kMostOpen = 64;

// What stands before the segments: this, then their sizes and hashes.
struct RecordHead {
  std::array<char, 8> magic{'T', 'S', 'R', 'E', 'C', 'L', 'O', 'G'};
  LocalIndex kind = 0;
  LocalIndex number = 0;
  std::uint64_t num_segments = 0;
  Hash128 hash{};  // hash_of() name and segments.
};
static_assert(sizeof(RecordHead) == 40, "padding would leave bytes that are not set");

struct SegmentHead {
  std::uint64_t size = 0;
  Hash128 hash{};
};
static_assert(sizeof(SegmentHead) == 24, "padding would leave bytes that are not set");

using SegmentHeads = std::vector<SegmentHead>;

std::uint64_t size_of_heads(std::uint64_t num_segments)
{
  return sizeof(RecordHead) + num_segments * sizeof(SegmentHead);
}

Hash128 hash_of(const LogName& name, std::span<const SegmentHead> segments)
{
  Hash128 hash = hash_bytes(std::as_bytes(std::span(&name, 1)));
  hash += hash_bytes(std::as_bytes(segments));
  return hash;
}

fs::path file_path(const fs::path& folder, LocalIndex file)
{
  return folder / fmt::format("{}{:06}{}", kPrefix, file, kSuffix);
}

// Whether all of it was there.
bool read_at(int descriptor, std::uint64_t offset, std::span<std::byte> bytes)
{
  while (!bytes.empty()) {
    const ssize_t got = ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    offset += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

std::uint64_t size_of_file(int descriptor)
{
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  return end < 0 ? 0 : static_cast<std::uint64_t>(end);
}

// The record there if it is whole; then `offset` becomes that of the next one.
std::optional<LogPlace> place_at(int descriptor, std::uint64_t& offset, std::uint64_t end)
{
  RecordHead head;
  if (!read_at(descriptor, offset, std::as_writable_bytes(std::span(&head, 1)))) return {};
  std::uint64_t next = offset + sizeof(head);
  if (head.magic != RecordHead().magic) return {};
  if (head.num_segments > (end - next) / sizeof(SegmentHead)) return {};
  SegmentHeads heads(head.num_segments);
  if (!read_at(descriptor, next, std::as_writable_bytes(std::span(heads)))) return {};
  const LogName name{head.kind, head.number};
  if (head.hash != hash_of(name, heads)) return {};
  next += heads.size() * sizeof(SegmentHead);
  for (const SegmentHead& segment : heads) {
    if (segment.size > end - next) return {};
    Bytes bytes(segment.size);
    if (!read_at(descriptor, next, bytes) || hash_bytes(bytes) != segment.hash) return {};
    next += segment.size;
  }
  return LogPlace{.name = name,
                  .num_segments = static_cast<LocalIndex>(heads.size()),
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
  SegmentHeads heads;
  for (const Bytes& segment : segments) heads.push_back({segment.size(), hash_bytes(segment)});
  const LogPlace place{name, file_, static_cast<LocalIndex>(segments.size()), end_,
                       hash_of(name, heads)};
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

LogReader::~LogReader() { close_all(); }

void LogReader::close_all() const
{
  for (const auto& [file, descriptor] : descriptors_) ::close(descriptor);
  descriptors_.clear();
}

int LogReader::open(LocalIndex file) const
{
  const auto known = descriptors_.find(file);
  if (known != descriptors_.end()) return known->second;
  if (descriptors_.size() >= kMostOpen) close_all();
  const fs::path path = file_path(folder_, file);
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) {
    throw InputError(fmt::format("cannot read {}: {}", path.string(), system_error_text(errno)));
  }
  descriptors_.emplace(file, descriptor);
  return descriptor;
}

Bytes LogReader::segment(const LogPlace& place, LocalIndex number) const
{
  const int descriptor = open(place.file);
  const auto require = [&](bool condition) {
    if (!condition) {
      throw InputError(file_path(folder_, place.file).string() + " is cut off or altered");
    }
  };
  require(number < place.num_segments);
  SegmentHeads heads(at(place.num_segments));
  require(read_at(descriptor, place.offset + sizeof(RecordHead),
                  std::as_writable_bytes(std::span(heads))));
  require(hash_of(place.name, heads) == place.head_hash);
  std::uint64_t offset = place.offset + size_of_heads(heads.size());
  for (std::size_t i = 0; i < at(number); ++i) offset += heads[i].size;
  Bytes segment(heads[at(number)].size);
  require(read_at(descriptor, offset, segment));
  require(hash_bytes(segment) == heads[at(number)].hash);
  return segment;
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
  const int descriptor = open(file);
  std::vector<LogPlace> places;
  std::uint64_t offset = 0;
  const std::uint64_t end = size_of_file(descriptor);
  while (const auto place = place_at(descriptor, offset, end)) {
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

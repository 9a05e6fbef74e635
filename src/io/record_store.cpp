// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/record_store.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/io/files.hpp"

#include "atomic_file.hpp"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".record";

/// First bytes of a record file. The hash is over name and record, so that a file under a wrong
/// name is noticed.
struct Header {
  std::array<char, 8> magic{'T', 'S', 'R', 'E', 'C', 'O', 'R', 'D'};
  std::uint64_t version = 2;
  std::uint64_t size = 0;
  Hash128 hash{};

  friend bool operator==(const Header&, const Header&) = default;
};
static_assert(sizeof(Header) == 40, "padding would leave bytes that are not set");

[[nodiscard]] Header header_of(const std::string& name, std::span<const std::byte> record)
{
  Header header;
  header.size = record.size();
  header.hash = hash_bytes(record);
  header.hash += hash_bytes(std::as_bytes(std::span(name)));
  return header;
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

fs::path RecordStore::file_of(const std::string& name) const
{
  return folder_ / (name + std::string(kSuffix));
}

void RecordStore::put(const std::string& name, std::span<const std::byte> record) const
{
  const Header header = header_of(name, record);
  AtomicFile file(file_of(name));
  file.write(std::as_bytes(std::span(&header, 1)));
  file.write(record);
  file.commit();
}

Bytes RecordStore::get(const std::string& name) const
{
  const fs::path path = file_of(name);
  std::error_code error;
  const std::uintmax_t file_size = fs::file_size(path, error);
  if (error) throw InputError(fmt::format("cannot read {}: {}", path.string(), error.message()));
  const auto require = [&](bool condition) {
    if (!condition) throw InputError(path.string() + " is cut off or altered");
  };

  std::ifstream file(path, std::ios::binary);
  Header header;
  file.read(reinterpret_cast<char*>(&header), sizeof(header));
  require(file.good() && file_size - sizeof(header) == header.size);

  Bytes record(header.size);
  file.read(reinterpret_cast<char*>(record.data()), static_cast<std::streamsize>(record.size()));
  require(file.good() && header == header_of(name, record));
  return record;
}

std::optional<Bytes> RecordStore::find(const std::string& name) const
{
  if (!contains(name)) return std::nullopt;
  try {
    return get(name);
  } catch (const InputError&) {
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

}  // namespace tessera::io

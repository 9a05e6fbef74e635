// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu/mesh_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <span>
#include <system_error>
#include <utility>

#include "io/atomic_file.hpp"

namespace tessera::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCutShort = "it cannot be read to its end";

struct OpenedFile {
  std::ifstream stream{};
  std::uintmax_t size = 0;
};

[[nodiscard]] OpenedFile open_file(const fs::path& path)
{
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(system_error_text(EISDIR));
  OpenedFile file{std::ifstream(path, std::ios::binary), 0};
  if (!file.stream) throw InputError(system_error_text(errno));
  file.size = fs::file_size(path, error);
  if (error) throw InputError(error.message());
  return file;
}

}  // namespace

std::string load_file(const fs::path& path, std::size_t max_size)
{
  OpenedFile file = open_file(path);
  std::string bytes(static_cast<std::size_t>(std::min<std::uintmax_t>(file.size, max_size)), '\0');
  file.stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.stream) throw InputError(kCutShort);
  return bytes;
}

StoredBytes::StoredBytes(const fs::path& path)
{
  OpenedFile file = open_file(path);
  size_ = static_cast<std::size_t>(file.size);
  file_ = std::make_shared<std::ifstream>(std::move(file.stream));
}

StoredBytes StoredBytes::from(std::size_t begin) const
{
  StoredBytes rest = *this;
  rest.size_ -= begin;
  if (file_ == nullptr) {
    rest.memory_.remove_prefix(begin);
  } else {
    rest.begin_ += begin;
  }
  return rest;
}

Bytes StoredBytes::read(std::size_t begin, std::size_t end) const
{
  if (file_ == nullptr) {
    const auto bytes = std::as_bytes(std::span(memory_.substr(begin, end - begin)));
    return {bytes.begin(), bytes.end()};
  }
  Bytes bytes(end - begin);
  file_->clear();
  file_->seekg(static_cast<std::streamoff>(begin_ + begin));
  file_->read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!*file_) throw InputError(kCutShort);
  return bytes;
}

}  // namespace tessera::io

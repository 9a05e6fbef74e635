// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.hpp"

#include <atomic>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"

namespace tessera::io {
namespace {

constexpr std::string_view kTemporaryMark = ".tmp-";

}  // namespace

std::string system_error_text(int error_number)
{
  return std::generic_category().message(error_number);
}

void throw_cannot_read_back(const std::filesystem::path& file, int error_number)
{
  throw OutputError(
      fmt::format("cannot read back {}: {}", file.string(), system_error_text(error_number)));
}

bool is_temporary_name(const std::string& name)
{
  const auto mark = name.rfind(kTemporaryMark);
  return mark != std::string::npos
         && name.find_first_not_of("0123456789-", mark + kTemporaryMark.size())
                == std::string::npos;
}

AtomicFile::AtomicFile(std::filesystem::path final_path) : final_(std::move(final_path))
{
  static std::atomic<unsigned> counter{0};
  do {
    temporary_ = final_;
    temporary_ += fmt::format("{}{}-{}", kTemporaryMark, ::getpid(), counter++);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail(errno);
}

AtomicFile::~AtomicFile()
{
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) fail(errno);
    if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit()
{
  close();
  if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);
  committed_ = true;
}

void AtomicFile::close()
{
  // Network file systems report a full disk as late as here.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
}

void AtomicFile::fail(int error_number) const
{
  throw OutputError(
      fmt::format("cannot write {}: {}", final_.string(), system_error_text(error_number)));
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text)
{
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

void make_own_folder(const std::filesystem::path& folder)
{
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(folder, error))) {
    throw OutputError(folder.string()
                      + " is a symbolic link: a run writes into folders of its own");
  }
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw OutputError(fmt::format("cannot make folder {}: {}", folder.string(), error.message()));
}

}  // namespace tessera::io

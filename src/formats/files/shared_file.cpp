// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files/shared_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

namespace tessera::formats {

// Under a name that io::OutputFolder knows as one of a half-written file.
SharedFile::SharedFile(std::filesystem::path final_path)
    : final_(std::move(final_path)), temporary_(final_)
{
  temporary_ += ".tmp-0";
}

SharedFile::~SharedFile()
{
  if (descriptor_ >= 0) ::close(descriptor_);
  if (created_) ::unlink(temporary_.c_str());
}

void SharedFile::create()
{
  ::unlink(temporary_.c_str());
  open(O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC);
  created_ = true;
}

void SharedFile::write(GlobalIndex offset, std::span<const std::byte> bytes)
{
  if (descriptor_ < 0) open(O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno != EINTR) fail(errno);
    if (written <= 0) continue;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += written;
  }
}

void SharedFile::close()
{
  if (descriptor_ < 0) return;
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
}

void SharedFile::commit()
{
  if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);
  created_ = false;
}

void SharedFile::open(int flags)
{
  constexpr mode_t kUsual = 0666;
  descriptor_ = ::open(temporary_.c_str(), flags, kUsual);
  if (descriptor_ < 0) fail(errno);
}

void SharedFile::fail(int error_number) const
{
  throw OutputError(fmt::format("cannot write {}: {}", final_.string(),
                                std::generic_category().message(error_number)));
}

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#include "io/folder_lock.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

#include "io/atomic_file.hpp"

namespace tessera::io {
namespace {

[[nodiscard]] std::string host_name()
{
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

[[nodiscard]] std::string now_utc()
{
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

[[nodiscard]] std::string host_line() { return fmt::format("host {}\n", host_name()); }

[[nodiscard]] std::string in_words(std::string owner)
{
  std::replace(owner.begin(), owner.end(), '\n', ' ');
  return owner.empty() ? "an unknown process" : owner;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(folder), file_(folder / kLockName)
{
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor_ < 0) {
    throw OutputError(
        fmt::format("cannot write to folder {}: {}", folder.string(), system_error_text(errno)));
  }
  try {
    acquire();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

FolderLock::~FolderLock()
{
  // Emptied before it is given up: the next owner must not find this one's name.
  forget_owner();
  ::close(descriptor_);
}

void FolderLock::acquire()
{
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) {
      throw OutputError(
          fmt::format("folder {} is in use by {}", folder_.string(), in_words(read_owner())));
    }
    throw OutputError(
        fmt::format("cannot lock folder {}: {}", folder_.string(), system_error_text(errno)));
  }
  refuse_owner_on_other_host();
  write_owner();
}

void FolderLock::refuse_owner_on_other_host() const
{
  const std::string owner = read_owner();
  if (owner.empty() || owner.starts_with(host_line())) return;
  throw OutputError(fmt::format("folder {} may be in use by {}; if that run is over, remove {}",
                                folder_.string(), in_words(owner), file_.string()));
}

void FolderLock::write_owner() const
{
  const std::string owner =
      fmt::format("{}process {}\nsince {}\n", host_line(), ::getpid(), now_utc());
  int error_number = ::ftruncate(descriptor_, 0) == 0 ? 0 : errno;
  for (std::size_t done = 0; error_number == 0 && done < owner.size();) {
    const ssize_t written =
        ::pwrite(descriptor_, owner.data() + done, owner.size() - done, static_cast<off_t>(done));
    if (written < 0)
      error_number = errno;
    else
      done += static_cast<std::size_t>(written);
  }
  if (error_number == 0) return;
  forget_owner();
  throw OutputError(
      fmt::format("cannot write {}: {}", file_.string(), system_error_text(error_number)));
}

// Half of a name would be that of a stranger.
void FolderLock::forget_owner() const
{
  [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, 0);
}

std::string FolderLock::read_owner() const
{
  std::array<char, 512> text{};
  const ssize_t size = ::pread(descriptor_, text.data(), text.size(), 0);
  return {text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

}  // namespace tessera::io

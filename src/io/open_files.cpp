// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/open_files.hpp"

#include <cerrno>
#include <cstddef>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

#include "io/atomic_file.hpp"

namespace tessera::io {
namespace {

constexpr std::size_t kMostOpen = 64;

[[noreturn]] void throw_cannot_open(const std::filesystem::path& file, int error)
{
  if (error != ENOENT && error != ELOOP) throw_cannot_read_back(file, error);
  throw InputError(fmt::format("cannot read {}: {}", file.string(), system_error_text(error)));
}

}  // namespace

OpenFiles::~OpenFiles() { close_all(); }

void OpenFiles::close_all()
{
  for (const auto& [file, descriptor] : descriptors_) ::close(descriptor);
  descriptors_.clear();
}

OpenFile OpenFiles::open(const std::filesystem::path& file)
{
  const auto known = descriptors_.find(file);
  if (known != descriptors_.end()) return {known->second, file};
  if (descriptors_.size() >= kMostOpen) close_all();
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) throw_cannot_open(file, errno);
  descriptors_.emplace(file, descriptor);
  return {descriptor, file};
}

}  // namespace tessera::io

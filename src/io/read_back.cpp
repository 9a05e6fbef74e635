// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/read_back.hpp"

#include <cerrno>
#include <cstdint>
#include <system_error>

#include <fcntl.h>

#include "tessera/base/file_descriptor.hpp"

#include "io/atomic_file.hpp"
#include "io/segments.hpp"

namespace tessera::io {

Bytes read_back(const std::filesystem::path& path)
{
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw_cannot_read_back(path, error.value());
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw_cannot_read_back(path, errno);
  Bytes bytes(size);
  // It has become shorter meanwhile.
  if (!read_at({file.get(), path}, 0, bytes)) throw_cannot_read_back(path, EIO);
  return bytes;
}

}  // namespace tessera::io

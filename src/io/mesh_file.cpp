// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "atomic_file.hpp"

namespace tessera::io {

namespace fs = std::filesystem;

std::string load_file(const fs::path& path, std::size_t max_size)
{
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(system_error_text(EISDIR));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(system_error_text(errno));
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError(error.message());
  std::string bytes(static_cast<std::size_t>(std::min<std::uintmax_t>(size, max_size)), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw InputError("it cannot be read to its end");
  return bytes;
}

}  // namespace tessera::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>

namespace tessera::io {

/// @brief Files that stay open for reading, the most recent ones. All functions are local.
class OpenFiles {
 public:
  OpenFiles() = default;
  ~OpenFiles();
  OpenFiles(const OpenFiles&) = delete;
  OpenFiles& operator=(const OpenFiles&) = delete;

  /// @brief Descriptor of the file, valid until the next call. Opens it where needed; follows no
  /// symbolic link.
  /// @throws InputError naming the file if it cannot be opened.
  [[nodiscard]] int open(const std::filesystem::path& file);

 private:
  void close_all();

  std::map<std::filesystem::path, int> descriptors_{};
};

}  // namespace tessera::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>

namespace tessera::io {

/// @brief A file that OpenFiles has open; the descriptor stays theirs.
struct OpenFile {
  int descriptor = -1;
  std::filesystem::path path{};
};

/// @brief Files that stay open for reading, the most recent ones. All functions are local.
class OpenFiles {
 public:
  OpenFiles() = default;
  ~OpenFiles();
  OpenFiles(const OpenFiles&) = delete;
  OpenFiles& operator=(const OpenFiles&) = delete;

  /// @brief The file, valid until the next call. Opens it where needed; follows no symbolic link.
  /// @throws InputError naming the file if it is not there, or a symbolic link; OutputError if the
  /// file system fails, as for a stale handle: this is for files of a run's own folder.
  [[nodiscard]] OpenFile open(const std::filesystem::path& file);

 private:
  void close_all();

  std::map<std::filesystem::path, int> descriptors_{};
};

}  // namespace tessera::io

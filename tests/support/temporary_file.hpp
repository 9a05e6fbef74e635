// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace tessera::testing {

/// @brief A file in a folder of its own, removed with it.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content)
      : folder_(std::filesystem::temp_directory_path()
                / ("tessera_test_" + std::to_string(::getpid()) + "_" + std::to_string(next_++))),
        path_(folder_ / name)
  {
    std::filesystem::create_directories(folder_);
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove_all(folder_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  static inline int next_ = 0;
  std::filesystem::path folder_;
  std::filesystem::path path_;
};

}  // namespace tessera::testing

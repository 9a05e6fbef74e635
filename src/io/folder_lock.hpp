// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace tessera::io {

inline constexpr const char* kLockName = ".tessera.lock";

/// @brief Holds the lock file of a folder for its lifetime; see OutputFolder.
///
/// flock does the locking, as the kernel gives it up when the owner dies, however it dies. The text
/// in the file tells people who holds it, and tells apart owners on other hosts, which flock does
/// not see on every network file system.
class FolderLock {
 public:
  /// @brief Takes the lock. @throws OutputError naming the owner, or why there can be no lock.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  void acquire();
  void refuse_owner_on_other_host() const;
  void write_owner() const;
  void forget_owner() const;
  [[nodiscard]] std::string read_owner() const;

  std::filesystem::path folder_;
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace tessera::io

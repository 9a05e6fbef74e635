// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace tessera::io {

/// @brief What to do with an output folder that already holds something, other than what a dry run
/// has left: that is in nobody's way.
enum class ExistingFolder : int {
  refuse,     ///< It is an error.
  overwrite,  ///< Remove what a Tessera run made; refuse a folder that no Tessera run has used.
  resume,     ///< Keep everything but half-written files; refuse a folder that no run has used.
};
[[nodiscard]] constexpr ExistingFolder last_value(ExistingFolder /*type*/)
{
  return ExistingFolder::resume;
}

/// @brief The output folder of one run, held by a lock for as long as this object lives.
///
/// The lock is the file ".tessera.lock". It names its owner (host, process, start time) while it is
/// held. Afterwards it stays, empty, as the mark of a folder that a Tessera run has used. The lock
/// of a process that died on this host is taken over. Whether a process on another host still lives
/// nobody can tell, so its file must be removed by hand. Rank 0 makes it; all functions are local.
class OutputFolder {
 public:
  /// @brief Makes the folder with its parents, or takes the existing one as `existing` says.
  ///
  /// Overwriting removes only names that a run makes, follows no symbolic link, and keeps all else.
  /// @throws OutputError naming the folder: not empty, in use (by whom), not writable (why).
  OutputFolder(std::filesystem::path folder, ExistingFolder existing);
  ~OutputFolder();
  OutputFolder(OutputFolder&&) noexcept;
  OutputFolder& operator=(OutputFolder&&) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return folder_; }

  /// @brief Removes the half-written files of writers that were killed. @pre nobody writes.
  /// @throws OutputError
  void remove_half_written() const;

 private:
  std::filesystem::path folder_;
  std::unique_ptr<class FolderLock> lock_;
};

}  // namespace tessera::io

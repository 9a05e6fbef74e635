// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace tessera::io {

/// @brief The error number's text, e.g. "No space left on device".
[[nodiscard]] std::string system_error_text(int error_number);

/// @brief The file system fails with a file of the run's own: not what the user gave is wrong, but
/// the output folder. @throws OutputError
[[noreturn]] void throw_cannot_read_back(const std::filesystem::path& file, int error_number);

/// @brief Whether `name` is one that AtomicFile gives to temporary files.
[[nodiscard]] bool is_temporary_name(const std::string& name);

/// @brief A file under a temporary name beside its final one; nobody sees it before `commit`.
///
/// Own code, because VTK writes to the temporary name too, and a later run must know the files of a
/// killed writer by their names. Not synced to the disk: who reads a file finds by its hashes what
/// a power cut has left.
class AtomicFile {
 public:
  /// @brief Makes the temporary file, empty. @throws OutputError
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @brief Where the file is until `commit`; others may write to it instead of `write`.
  [[nodiscard]] const std::filesystem::path& temporary_path() const noexcept { return temporary_; }

  /// @brief Appends bytes. @throws OutputError naming the final file.
  void write(std::span<const std::byte> bytes);

  /// @brief Gives the file its final name, replacing an older file. @throws OutputError
  void commit();

 private:
  void close();
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path final_;
  std::filesystem::path temporary_{};
  int descriptor_ = -1;
  bool committed_ = false;
};

}  // namespace tessera::io

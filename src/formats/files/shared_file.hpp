// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "tessera/base/types.hpp"

namespace tessera::formats {

/// @brief A file that all ranks write to, each at its own places, under a temporary name that all
/// of them know. Rank 0 creates and commits it.
///
/// Plain writes at offsets, so it needs no more of a file system than that writes to different
/// bytes do not disturb each other.
class SharedFile {
 public:
  explicit SharedFile(std::filesystem::path final_path);
  /// @brief Removes the temporary file if this object created and did not commit it.
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  [[nodiscard]] const std::filesystem::path& temporary_path() const noexcept { return temporary_; }

  /// @brief Makes the temporary file, in place of one that a killed writer has left. One rank.
  /// @throws OutputError
  void create();

  /// @brief Writes bytes at an offset. @pre some rank has created the file. @throws OutputError
  void write(GlobalIndex offset, std::span<const std::byte> bytes);
  void write(GlobalIndex offset, std::string_view text)
  {
    write(offset, std::as_bytes(std::span(text)));
  }

  /// @brief No more comes from this rank. @throws OutputError: the disk may turn out full here.
  void close();

  /// @brief Gives it its final name. @pre all have closed it. One rank. @throws OutputError
  void commit();

 private:
  void open(int flags);
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path final_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
  bool created_ = false;
};

}  // namespace tessera::formats

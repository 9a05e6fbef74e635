// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/io/open_files.hpp"

namespace tessera::io {

/// @brief Finished parts of a run as immutable, named records in a scratch folder.
///
/// A piece goes here as soon as it is filled. So memory holds only the pieces in flight, and a run
/// that died can be resumed. There is no state but the folder: ranks and their job processes each
/// make their own RecordStore on it. Names are file names without suffix. A record may have several
/// segments, to be read one by one. All functions are local.
class RecordStore {
 public:
  /// @brief Opens the store, making its folder where needed. @throws OutputError
  explicit RecordStore(std::filesystem::path folder);

  /// @brief Stores a record; replaces an older one. It is there whole or not at all, whenever the
  /// process dies. @throws OutputError (disk full, permission).
  void put(const std::string& name, std::span<const std::byte> record) const;
  void put(const std::string& name, std::span<const Bytes> segments) const;

  /// @brief A segment of the record of that name, proven to be what was stored by its size and
  /// 128-bit hash. Other segments are not read.
  /// @throws InputError naming the file if it is missing, cut off or altered; OutputError if the
  /// file system fails.
  [[nodiscard]] Bytes get(const std::string& name, LocalIndex segment = 0) const;

  /// @brief The first segment of the record, if all of it is there and sound. Reads all of it.
  /// @throws OutputError if the file system fails.
  [[nodiscard]] std::optional<Bytes> find(const std::string& name) const;

  /// @brief Whether there is a record of that name; whether it is sound, `get` tells.
  [[nodiscard]] bool contains(const std::string& name) const;

  /// @brief Removes a record, if it is there. @throws OutputError
  void remove(const std::string& name) const;

  /// @brief Removes all records and what died writers left, and the folder if then empty.
  /// @throws OutputError
  void remove_all() const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& name) const;

  std::filesystem::path folder_;
};

/// @brief Reads many segments of records that do not change meanwhile; their files stay open. All
/// functions are local.
class RecordReader {
 public:
  explicit RecordReader(std::filesystem::path folder);

  /// @throws InputError naming the file if it is missing or damaged; OutputError if the file system
  /// fails.
  [[nodiscard]] LocalIndex num_segments(const std::string& name) const;

  /// @brief As RecordStore::get(). @throws InputError, OutputError
  [[nodiscard]] Bytes segment(const std::string& name, LocalIndex number) const;

 private:
  std::filesystem::path folder_;
  mutable OpenFiles files_{};
};

}  // namespace tessera::io

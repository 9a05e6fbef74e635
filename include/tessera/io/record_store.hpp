// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "tessera/base/bytes.hpp"

namespace tessera::io {

/// @brief Finished parts of a run as immutable, named records in a scratch folder.
///
/// A piece goes here as soon as it is filled. So memory holds only the pieces in flight, and a run
/// that died can be resumed. There is no state but the folder: ranks and their job processes each
/// make their own RecordStore on it. Names are file names without suffix. All functions are local.
class RecordStore {
 public:
  /// @brief Opens the store, making its folder where needed. @throws OutputError
  explicit RecordStore(std::filesystem::path folder);

  /// @brief Stores a record; replaces an older one. It is there whole or not at all, whenever the
  /// process dies. @throws OutputError (disk full, permission).
  void put(const std::string& name, std::span<const std::byte> record) const;

  /// @brief The record of that name, proven to be what was stored by its size and 128-bit hash.
  /// @throws InputError naming the file if it is missing, cut off or altered.
  [[nodiscard]] Bytes get(const std::string& name) const;

  /// @brief The record if it is there and sound.
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

}  // namespace tessera::io

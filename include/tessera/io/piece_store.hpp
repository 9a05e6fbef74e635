// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"

namespace tessera::io {

/// @brief Finished pieces as immutable records in a scratch folder.
///
/// A piece goes here as soon as it is filled, so that memory holds only the pieces in flight and a
/// run that died can be resumed. There is no state but the folder: ranks and their job processes
/// each make their own PieceStore on it. All functions are local.
class PieceStore {
 public:
  /// @brief Opens the store, making its folder where needed. @throws OutputError
  explicit PieceStore(std::filesystem::path folder);

  /// @brief Stores the record of piece `id`; replaces an older one. A record is there whole or not
  /// at all, whenever the process dies. @pre id >= 0. @throws OutputError (disk full, permission).
  void put(LocalIndex id, std::span<const std::byte> record) const;

  /// @brief The record of piece `id`, proven to be what was stored by its size and 128-bit hash.
  /// @throws InputError naming the file if it is missing, cut off or altered.
  [[nodiscard]] Bytes get(LocalIndex id) const;

  /// @brief Whether there is a record of piece `id`; whether it is sound, `get` tells.
  [[nodiscard]] bool contains(LocalIndex id) const;

  /// @brief Removes the record of piece `id`, if there is one. @throws OutputError
  void remove(LocalIndex id) const;

  /// @brief Removes all records and what died writers left, and the folder if then empty.
  /// @throws OutputError
  void remove_all() const;

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  [[nodiscard]] std::filesystem::path file_of(LocalIndex id) const;

  std::filesystem::path folder_;
};

}  // namespace tessera::io

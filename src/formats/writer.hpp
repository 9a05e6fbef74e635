// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "tessera/formats/piece.hpp"
#include "tessera/io/options.hpp"

namespace tessera::formats {

/// @brief Writes a mesh in one format, piece by piece. Rank 0 begins, all ranks write their pieces
/// and close, rank 0 commits; between these steps all ranks wait for each other.
class Writer {
 public:
  virtual ~Writer() = default;

  /// @brief Whether pieces must come with their ghosts, for which all are read once more.
  [[nodiscard]] virtual bool needs_ghosts() const { return false; }

  /// @brief Makes folders, and files that all write to, with what stands before and after the
  /// pieces. Rank 0 alone.
  virtual void begin() = 0;

  /// @brief Writes one piece to its place. Local; pieces come in any order.
  virtual void write(const Piece& piece) = 0;

  /// @brief All pieces of this rank are written: reports what could not be. Local.
  virtual void close() {}

  /// @brief Gives files their final names. Rank 0 alone.
  virtual void commit() {}
};

/// @brief What a writer writes. Borrowed.
struct WriterTarget {
  const Outline& outline;
  const std::filesystem::path& folder;
};

/// @throws ConfigError if the format cannot hold the mesh, saying why and which one can.
[[nodiscard]] std::unique_ptr<Writer> make_writer(io::Format format, const WriterTarget& target);

}  // namespace tessera::formats

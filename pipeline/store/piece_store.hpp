// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "tessera/mesh/piece.hpp"

#include "pipeline/store/filled_pieces.hpp"

namespace tessera::pipeline {

/// @brief Where finished pieces wait.
struct PieceStore {
  std::filesystem::path folder{};                    ///< The output folder.
  std::shared_ptr<const ImprovedPieces> improved{};  ///< nullptr: they are as they were filled.
  bool are_refined = false;                          ///< They were split further after that.
};

/// @brief The store of these pieces, in their latest state. Local.
[[nodiscard]] PieceStore store_of(const FilledPieces& filled, const std::filesystem::path& folder);

/// @brief Reads a piece from the store. Local.
/// @throws InputError if the record is missing or damaged.
[[nodiscard]] mesh::Piece stored_piece(const PieceStore& store, LocalIndex subdomain);

}  // namespace tessera::pipeline

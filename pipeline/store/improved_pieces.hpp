// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tessera/io/record_store.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/number/shared_vertices.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

namespace tessera::pipeline {

/// @brief Reads a piece from the store. *Generation* 0 is as it was filled, p + 1 as phase p of the
/// improvement has left it. Local.
/// @throws InputError if the record is missing or damaged.
[[nodiscard]] mesh::Piece stored_piece(const io::RecordStore& store, LocalIndex subdomain,
                                       int generation);

/// @brief The piece that was split further, where such pieces wait in the store. Local.
/// @throws InputError if its record is missing or damaged.
[[nodiscard]] mesh::Piece refined_piece(const io::RecordStore& store, LocalIndex subdomain);

/// @brief Name of an improved piece's record. @pre generation > 0
[[nodiscard]] std::string improved_name(LocalIndex subdomain, int generation);

/// @brief The pieces of the store after the improvement, and who owns their shared vertices.
/// Numbers and files are made from these. There is no state but the folder. All functions are
/// local.
///
/// Three steps, each for all pieces before the next one begins: every piece's list is kept; it is
/// compared with those of its neighbours; places are known.
class ImprovedPieces {
 public:
  ImprovedPieces(const std::filesystem::path& output, const mesh::Skeleton& skeleton,
                 int generation);

  [[nodiscard]] mesh::Piece piece(LocalIndex subdomain) const
  {
    return stored_piece(store_, subdomain, generation_);
  }

  /// @brief Notes which vertices the piece shares.
  void keep_list(const mesh::Piece& piece) const;

  /// @brief Compares a piece's list with its neighbours', and notes what it owns.
  [[nodiscard]] number::SharedBy own_vertices(LocalIndex subdomain) const;

  /// @brief Owner of each vertex of a piece: shape (num_vertices).
  [[nodiscard]] std::vector<subdomain::VertexPlace> places_of(const mesh::Piece& piece) const;

 private:
  [[nodiscard]] number::VertexList list_of(LocalIndex subdomain) const;
  [[nodiscard]] std::vector<mesh::HostPoint> owned_by(LocalIndex subdomain) const;

  io::RecordStore store_;
  std::vector<std::vector<LocalIndex>> neighbours_;  ///< By subdomain, ascending.
  int generation_;
};

}  // namespace tessera::pipeline

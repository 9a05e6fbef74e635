// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/piece_store.hpp"

#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/improved_pieces.hpp"

namespace tessera::pipeline {

PieceStore store_of(const FilledPieces& filled, const std::filesystem::path& folder)
{
  return {folder, filled.improvement.pieces, filled.are_refined};
}

mesh::Piece stored_piece(const PieceStore& store, LocalIndex subdomain)
{
  if (store.are_refined) return piece_of_record(store.folder, refined_name(subdomain));
  return store.improved ? store.improved->piece(subdomain)
                        : piece_of_record(store.folder, record_name(subdomain));
}

}  // namespace tessera::pipeline

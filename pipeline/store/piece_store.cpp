// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/piece_store.hpp"

#include "tessera/base/bytes.hpp"

#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/improved_pieces.hpp"

namespace tessera::pipeline {

PieceStore store_of(const FilledPieces& filled, const std::filesystem::path& folder)
{
  return {folder, filled.improvement.pieces, filled.are_refined};
}

mesh::Piece stored_piece(const PieceStore& store, LocalIndex subdomain)
{
  const io::RecordStore records(store_folder(store.folder));
  if (store.are_refined) {
    const auto record = from_bytes<FillRecord>(records.get(refined_name(subdomain)));
    return from_bytes<mesh::Piece>(record.piece);
  }
  return store.improved ? store.improved->piece(subdomain) : filled_piece(records, subdomain);
}

}  // namespace tessera::pipeline

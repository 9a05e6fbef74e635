// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "tessera/improve/region_band.hpp"
#include "tessera/improve/region_update.hpp"
#include "tessera/improve/seam_regions.hpp"
#include "tessera/io/record_store.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/number/shared_vertices.hpp"
#include "tessera/subdomain/improve_seam_region.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

#include "pipeline/store/seam_records.hpp"

namespace tessera::pipeline {

/// @brief Reads a piece from the store, as it was filled. Local.
/// @throws InputError if the record is missing or damaged.
[[nodiscard]] mesh::Piece filled_piece(const io::RecordStore& store, LocalIndex subdomain);

/// @brief The pieces in the course of the improvement and after it, and who owns their shared
/// vertices. Numbers and files are made from these.
///
/// A piece is never written again: it is the filled piece and the updates of its regions, put
/// together by whoever needs it. All functions are local; what other ranks have kept is known after
/// records().share().
class ImprovedPieces {
 public:
  ImprovedPieces(const std::filesystem::path& output, const mesh::Skeleton& skeleton,
                 std::shared_ptr<const improve::SeamRegions> regions,
                 const comm::Communicator& comm);  ///< @note Collective.

  /// @brief As all updates that are known have left it. Reads the filled piece once.
  /// @throws InputError if a record is missing or damaged.
  [[nodiscard]] mesh::Piece piece(LocalIndex subdomain) const;

  /// @brief Keeps the bands of a piece for a phase. They are made from the filled piece, or from
  /// its rim after the phase before.
  /// @param[in] phase_before kNoPhase: none; else a phase that is over, and the piece's last one
  /// before `phase`.
  /// @param[in] most_of_rim A rim of more tets is not kept: later phases then make do with the
  /// filled piece. 0 if there are none.
  void keep_bands(LocalIndex subdomain, int phase_before, int phase, GlobalIndex most_of_rim);
  static constexpr int kNoPhase = -1;

  [[nodiscard]] bool has_bands(LocalIndex subdomain, int phase) const
  {
    return records_.contains(bands_of_phase(phase), subdomain);
  }

  /// @brief Bytes of the bands of a region, in the order of its subdomains.
  [[nodiscard]] std::vector<Bytes> bands_of(LocalIndex region) const;

  void keep_region(LocalIndex region, const subdomain::RegionRecord& record);

  [[nodiscard]] bool has_region(LocalIndex region) const
  {
    return records_.contains(SeamRecord::region, region);
  }

  /// @brief How a region has ended, without its updates. @pre has_region().
  [[nodiscard]] subdomain::RegionRecord find_region(LocalIndex region) const;

  // Three steps, each for all pieces before the next one begins: every piece's list is kept; it is
  // compared with those of its neighbours; places are known.

  /// @brief Notes which vertices the piece shares.
  void keep_list(const mesh::Piece& piece);

  /// @brief What the lists will say of a piece's seams, but for a vertex in ten thousand that one
  /// of two pieces has lost; nothing of owners.
  [[nodiscard]] number::SharedBy expected_seams(const mesh::Piece& piece) const;

  /// @brief What the neighbours' lists say of a piece.
  struct Comparison {
    number::SharedBy shared{};
    bool is_as_expected = false;  ///< Of the seams.
  };

  /// @brief Compares a piece's list with its neighbours', and notes what it owns.
  [[nodiscard]] Comparison own_vertices(LocalIndex subdomain);

  /// @brief Owner of each vertex of a piece: shape (num_vertices).
  [[nodiscard]] std::vector<subdomain::VertexPlace> places_of(const mesh::Piece& piece) const;

  [[nodiscard]] SeamRecords& records() { return records_; }

 private:
  [[nodiscard]] std::vector<improve::RegionExchange> exchanges(LocalIndex subdomain,
                                                               int phase) const;
  [[nodiscard]] std::vector<char> may_be_on_seam(const std::vector<mesh::HostPoint>& names) const;
  // A stopped run may have left updates of later phases as well: they do not count.
  [[nodiscard]] improve::PiecePart whole_part(LocalIndex subdomain, int last_phase) const;
  [[nodiscard]] improve::PiecePart part_after(LocalIndex subdomain, int phase) const;
  [[nodiscard]] number::VertexList list_of(LocalIndex subdomain) const;
  [[nodiscard]] std::vector<mesh::HostPoint> owned_by(LocalIndex subdomain) const;

  io::RecordStore store_;
  std::shared_ptr<const improve::SeamRegions> regions_;
  std::vector<std::vector<LocalIndex>> neighbours_;  ///< By subdomain, ascending.
  SeamRecords records_;
};

}  // namespace tessera::pipeline

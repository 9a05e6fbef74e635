// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/improve/piece_part.hpp"
#include "tessera/improve/region_update.hpp"
#include "tessera/improve/seam_regions.hpp"
#include "tessera/io/record_store.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/number/shared_vertices.hpp"
#include "tessera/subdomain/core_figures.hpp"
#include "tessera/subdomain/improve_seam_region.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

#include "pipeline/store/band_segments.hpp"
#include "pipeline/store/seam_records.hpp"

namespace tessera::pipeline {

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

  /// @brief What the improvement may have changed of a piece, and the figures of the rest.
  struct Outer {
    improve::PiecePart part{};      ///< As all updates have left it.
    subdomain::CoreFigures core{};  ///< None if the part is the whole piece.
  };

  /// @brief Reads the filled piece only if there are no bands that were made of the whole piece.
  /// @throws InputError if a record is missing or damaged.
  [[nodiscard]] Outer outer(LocalIndex subdomain) const;

  /// @brief Keeps the bands of a piece for a later phase than 0; those of phase 0 come from its
  /// fill. They are made from its rim after the phase before, if there is one.
  /// @param[in] phase_before 0, or the piece's last one before `phase`; it is over.
  /// @param[in] most_of_rim A rim of more tets is not kept: later phases then make do without.
  void keep_bands(LocalIndex subdomain, int phase_before, int phase, GlobalIndex most_of_rim);

  /// @pre phase > 0
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
  void keep_list(const Outer& outer);

  /// @brief What the neighbours' lists say of a piece.
  struct Comparison {
    number::SharedBy shared{};
    std::vector<mesh::HostPoint> vertices{};  ///< Of the piece's own list: what `shared` is about.
    bool is_as_expected = false;              ///< Of the seams.

    /// @brief Which shared vertices of a part of the piece are on seams. Shape (num_skin_vertices).
    [[nodiscard]] std::vector<char> seams_of(const mesh::Piece& part) const;
  };

  /// @brief Compares a piece's list with its neighbours', and notes what it owns.
  [[nodiscard]] Comparison own_vertices(LocalIndex subdomain);

  /// @brief Owner of each vertex of a piece: shape (num_vertices).
  [[nodiscard]] std::vector<subdomain::VertexPlace> places_of(const mesh::Piece& piece) const;

  /// @brief The same of vertices of the skeleton, whatever pieces have them.
  [[nodiscard]] std::vector<subdomain::VertexPlace> places_of_names(
      std::span<const mesh::HostPoint> names) const;

  [[nodiscard]] SeamRecords& records() { return records_; }

 private:
  [[nodiscard]] bool has_bands_of_phase(LocalIndex subdomain, int phase) const;
  [[nodiscard]] Bytes band_segment(LocalIndex subdomain, int phase, LocalIndex number) const;
  [[nodiscard]] Bytes band_segment(LocalIndex subdomain, int phase, BandSegment segment) const
  {
    return band_segment(subdomain, phase, static_cast<LocalIndex>(segment));
  }
  // The band of a region's row in the phase.
  [[nodiscard]] Bytes band(LocalIndex subdomain, int phase, LocalIndex row) const
  {
    return band_segment(subdomain, phase, static_cast<LocalIndex>(BandSegment::first_band) + row);
  }
  [[nodiscard]] IndexLists tet_tags(LocalIndex subdomain, int phase) const;
  [[nodiscard]] std::optional<improve::PiecePart> find_rim(LocalIndex subdomain, int phase) const;
  // A stopped run may have left updates of later phases as well: they do not count.
  [[nodiscard]] std::vector<improve::RegionExchange> exchanges(LocalIndex subdomain,
                                                               int first_phase,
                                                               int last_phase) const;
  [[nodiscard]] improve::PiecePart whole_part(LocalIndex subdomain, int last_phase) const;
  // As the phases from `first_phase` to `last_phase` have left it.
  [[nodiscard]] improve::PiecePart outer_part(LocalIndex subdomain, int first_phase,
                                              int last_phase) const;
  // The phase up to that one in which the core was measured; none if it never was.
  [[nodiscard]] std::optional<int> phase_of_core(LocalIndex subdomain, int last_phase) const;
  [[nodiscard]] improve::PiecePart part_after(LocalIndex subdomain, int phase) const;
  // What each of its neighbours may have of a piece's list, in their order.
  [[nodiscard]] std::vector<number::VertexList> lists_for_neighbours(
      const number::VertexList& all) const;
  // What `other` has noted for a subdomain.
  [[nodiscard]] number::VertexList list_for(LocalIndex subdomain, LocalIndex other) const;
  [[nodiscard]] std::vector<mesh::HostPoint> owned_by(LocalIndex subdomain) const;

  io::RecordReader filled_;
  std::shared_ptr<const improve::SeamRegions> regions_;
  std::vector<std::vector<LocalIndex>> neighbours_;  ///< By subdomain, ascending.
  SeamRecords records_;
};

}  // namespace tessera::pipeline

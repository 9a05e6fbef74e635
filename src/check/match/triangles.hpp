// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/comm/record_exchange.hpp"

#include "check/components.hpp"
#include "check/findings.hpp"
#include "check/match/records.hpp"

namespace tessera::check {

/// @brief Different triangles among those sent; of this rank's share of the keys.
struct TriangleCounts {
  GlobalIndex num_triangles = 0;
  GlobalIndex num_outside = 0;
  GlobalIndex num_seam = 0;
  GlobalIndex num_interface = 0;
  GlobalIndex num_unlisted = 0;  ///< On one tet, but not in the boundary file.
};

/// @brief What the boundary file must hold: nothing, or all triangles on one tet. If only some
/// pieces of the mesh were made (partial), it may lack some of these, but holds nothing else.
enum class BoundaryFile { none, complete, partial };

/// @brief What a triangle on the surface of a piece turned out to be.
struct TriangleVerdict {
  LocalIndex piece = 0;
  LocalIndex row = 0;  ///< As in its TriangleSide.
  LocalIndex partner =
      kNoPiece;  ///< Piece of the tet on the other side; kNoPiece if there is none.
  TriangleRole role = TriangleRole::inner;

  static auto fields(auto& self) { return std::tie(self.piece, self.row, self.partner, self.role); }
};

/// @brief A part of all triangles, by the hash of their keys; the same on every rank.
struct TriangleRound {
  std::uint64_t number = 0;
  std::uint64_t num_rounds = 1;

  [[nodiscard]] bool contains(const TriangleKey& key) const { return number_of(key) == number; }
  /// @brief The round that contains the key.
  [[nodiscard]] std::uint64_t number_of(const TriangleKey& key) const
  {
    return (hash_of(key) >> 32) % num_rounds;  // The low bits choose the rank.
  }
};

/// @brief Brings the sides of each triangle together, batch by batch of pieces, and in the end the
/// boundary file's triangles with them.
///
/// A triangle is done with when its two sides have met between two tets of one material. Then only
/// 12 bytes of its key stay, by which a third side is noticed. Of all others 24 bytes a side stay
/// until the end: of the interfaces, and of the front between the pieces that were read and those
/// that were not. Who read their pieces sends them once more then, with all that messages say, a
/// part at a time. Only of interfaces inside a piece, which no reader keeps, the full records stay
/// as well: 88 bytes a side. Sides that are likely to be on the boundary may be held back until
/// then: nothing is lost by it.
class TriangleMatcher {
 public:
  TriangleMatcher(BoundaryFile boundary, const comm::Communicator& comm, Findings& findings)
      : boundary_(boundary), comm_(comm), findings_(findings), buckets_(kNumBuckets)
  {
  }

  /// @brief Takes triangles of a batch; any part of them at a time.
  /// @note Collective.
  /// @param[in] open Sides on one tet of their piece; the reader has them still at the end. Some
  /// may be missing, which decide() gets all the same.
  /// @param[in] inner Both sides of triangles on two tets of a piece, without rows.
  void add(std::span<const TriangleSide> open, std::span<const TriangleRecord> inner);

  /// @brief What is known now of triangles in the pieces of this rank (piece mod size).
  /// @note Collective; once all triangles of the batch were added.
  [[nodiscard]] std::vector<TriangleVerdict> match();

  /// @brief Sides of triangles inside a piece that wait for the end on this rank.
  [[nodiscard]] std::size_t num_inner() const;

  /// @brief Forgets the open sides, since they will be sent again. Local.
  void drop_open();

  /// @brief Decides about the triangles of a round.
  /// @note Collective; once for each round, at the end.
  /// @pre drop_open()
  /// @param[in] records Of this round: the open sides of this rank's pieces, and the triangles of
  /// its pieces of the boundary file.
  [[nodiscard]] std::vector<TriangleVerdict> decide(std::vector<TriangleRecord> records,
                                                    TriangleRound round);

  /// @brief Frees what only further triangles need. Local.
  void close() { buckets_ = std::vector<Bucket>(); }

  [[nodiscard]] const TriangleCounts& counts() const { return counts_; }
  /// @brief Components of tets joined across pieces.
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }

 private:
  // Arrays of this many parts grow and are matched without a second copy of the whole.
  static constexpr std::size_t kNumBuckets = 64;

  // 96 of a key's 128 bits. Of 10^10 triangles any two agree in them with a chance of 10^-9.
  using ShortKey = std::array<std::uint32_t, 3>;

  // What sides of one piece have in common.
  struct Region {
    LocalIndex piece = 0;
    LocalIndex component = 0;
    std::int32_t attribute = 0;
    std::int32_t subdomain = 0;

    friend auto operator<=>(const Region&, const Region&) = default;
  };
  struct OpenSide {
    TriangleKey key{};
    std::uint32_t region_and_parity = 0;
    LocalIndex row = 0;  // If negative, -1 - the row among the inner records of its bucket.
  };
  struct Bucket {
    std::vector<OpenSide> open{};
    std::vector<TriangleRecord> inner{};  // Full, for their readers do not have them any more.
    std::vector<ShortKey> complete{};     // Ascending.
  };

  [[nodiscard]] static ShortKey short_key(const TriangleKey& key);
  [[nodiscard]] Bucket& bucket_of(const TriangleKey& key);
  void take_open(std::span<const TriangleSide> sides);
  void take_inner(std::span<const TriangleRecord> records);
  [[nodiscard]] OpenSide packed(const TriangleSide& side);
  [[nodiscard]] TriangleSide unpacked(const OpenSide& side) const;
  void match(Bucket& bucket, std::vector<TriangleVerdict>& verdicts);
  [[nodiscard]] bool match_two(const TriangleSide& a, const TriangleSide& b,
                               std::vector<TriangleVerdict>& verdicts);
  [[nodiscard]] bool is_complete(const TriangleKey& key);

  BoundaryFile boundary_;
  const comm::Communicator& comm_;
  Findings& findings_;
  std::vector<Bucket> buckets_;
  std::vector<Region> regions_{};
  std::map<Region, std::uint32_t> region_row_{};
  std::uint32_t last_region_ = 0;  // Asked for last.
  TriangleCounts counts_{};
  std::vector<Link> links_{};
};

}  // namespace tessera::check

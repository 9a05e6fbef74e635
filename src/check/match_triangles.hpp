// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/comm/record_exchange.hpp"

#include "check/components.hpp"
#include "check/findings.hpp"
#include "check/records.hpp"

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
  LocalIndex row = 0;  ///< As in its TriangleRecord.
  LocalIndex partner =
      kNoPiece;  ///< Piece of the tet on the other side; kNoPiece if there is none.
  TriangleRole role = TriangleRole::inner;

  static auto fields(auto& self) { return std::tie(self.piece, self.row, self.partner, self.role); }
};

/// @brief Brings the sides of each triangle together, and the boundary file's triangles with them,
/// batch by batch of pieces.
///
/// A triangle is done with when its two sides have met between two tets of one material. Then only
/// its key stays, by which a third side is noticed. All others stay until the end: the boundary,
/// the interfaces, and the front between the pieces that were read and those that were not.
class TriangleMatcher {
 public:
  TriangleMatcher(BoundaryFile boundary, const comm::Communicator& comm, Findings& findings)
      : boundary_(boundary), comm_(comm), findings_(findings)
  {
  }

  /// @brief Takes the records of a batch.
  /// @note Collective.
  /// @return What is known now of triangles in the pieces of this rank (piece mod size).
  [[nodiscard]] std::vector<TriangleVerdict> add(std::vector<TriangleRecord> records);

  /// @brief Decides about all triangles that are left.
  /// @note Collective.
  [[nodiscard]] std::vector<TriangleVerdict> finish();

  [[nodiscard]] const TriangleCounts& counts() const { return counts_; }
  /// @brief Components of tets joined across pieces.
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }

 private:
  [[nodiscard]] std::vector<TriangleVerdict> match(std::vector<TriangleRecord> records,
                                                   bool is_last);
  [[nodiscard]] bool is_complete(const TriangleKey& key) const;
  void complete(std::vector<TriangleKey> keys);

  BoundaryFile boundary_;
  const comm::Communicator& comm_;
  Findings& findings_;
  std::vector<TriangleRecord> open_{};
  std::vector<TriangleKey> complete_{};  // Ascending.
  TriangleCounts counts_{};
  std::vector<Link> links_{};
};

}  // namespace tessera::check

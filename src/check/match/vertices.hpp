// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/comm/communicator.hpp"

#include "check/findings.hpp"
#include "check/match/id_runs.hpp"
#include "check/match/records.hpp"

namespace tessera::check {

/// @brief What is known of a vertex from all pieces.
struct VertexFlags {
  bool is_on_seam = false;   ///< On a seam triangle of any piece.
  bool is_shared = false;    ///< In several pieces of tets.
  bool is_on_split = false;  ///< On a patch of a split.

  static auto fields(auto& self)
  {
    return std::tie(self.is_on_seam, self.is_shared, self.is_on_split);
  }
};

struct VertexTotals {
  GlobalIndex num_vertices = 0;      ///< Different ones that a tet uses, of this rank's share.
  GlobalIndex num_shared_ids = 0;    ///< Ids that stand in several pieces, of this rank's share.
  GlobalIndex num_contradicted = 0;  ///< Of those, with more than one position.
  std::vector<PointId> ids{};        ///< Different ids of this rank's share; matching by ids only.
};

/// @brief Brings together what different pieces say about the same vertex, batch by batch of
/// pieces. One record stays of every vertex: that of its lowest piece.
class VertexMatcher {
 public:
  VertexMatcher(const comm::Communicator& comm, Findings& findings);

  /// @brief Takes the vertices of a batch.
  /// @note Collective; the batches in the order of pieces, all of them with the same identity.
  /// @pre a batch of the boundary file comes behind all tets.
  void add(std::span<const VertexRecord> records, VertexIdentity identity);

  /// @brief Notes that vertices are on a seam. @note Collective. @pre they were added.
  void mark_seam(std::span<const VertexKey> keys);

  /// @brief What is known of some vertices. @note Collective. @pre they were added.
  [[nodiscard]] std::vector<VertexFlags> flags(std::span<const VertexKey> keys) const;

  /// @brief Compares the positions of different vertices and counts.
  /// @note Collective; once, at the end.
  /// @param[in] has_splits Whether some points are double on purpose. Then those of one piece are
  /// looked at, too: nobody could tell before what patches they are on.
  [[nodiscard]] VertexTotals finish(bool has_splits);

 private:
  [[nodiscard]] std::uint64_t owner_of(const VertexKey& key) const;
  [[nodiscard]] std::size_t slot_of(const VertexKey& key) const;
  void grow();
  [[nodiscard]] std::size_t size() const { return vertices_.size(); }
  [[nodiscard]] VertexRecord record(std::size_t row) const;
  void set(std::size_t row, const VertexRecord& record);
  void take(std::span<const VertexRecord> records, std::span<const std::size_t> rows);
  void take(VertexRecord& first, const VertexRecord& other);
  void match_positions(bool has_splits);

  // A VertexRecord without its flags, which are in a byte of their own: padding would cost a sixth.
  struct Vertex {
    Vec3 position{};
    GlobalIndex id = kNoId;
    LocalIndex piece = 0;
    LocalIndex point = 0;
  };

  const comm::Communicator& comm_;
  Findings& findings_;
  VertexIdentity identity_ = VertexIdentity::ids;
  std::deque<Vertex> vertices_{};     // Grows without a second copy.
  std::deque<std::uint8_t> flags_{};  // Of each vertex, as of flags_of().
  std::vector<LocalIndex> slots_{};   // Hash table of rows of vertices_; kNoIndex where empty.
};

template <class Vertex>
[[nodiscard]] VertexKey key_of(const Vertex& record, VertexIdentity identity)
{
  return identity == VertexIdentity::ids ? key_of_id(record.id) : key_of_position(record.position);
}

}  // namespace tessera::check

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/skin.hpp"

namespace tessera::verify {

/// @brief What a piece shows on one inner skeleton triangle: the sum of the signed hashes of its
/// fine triangles there. Each hash is over the vertices' mesh::HostPoint and the bits of their
/// positions.
struct SeamHash {
  LocalIndex triangle = kNoIndex;  ///< Skeleton triangle.
  Hash128 hash{};                  ///< Seen from the other side it is the negative of this.

  static auto fields(auto& self) { return std::tie(self.triangle, self.hash); }
};

/// @brief Seam hashes of a piece, ascending by triangle. Local.
/// @param[in] skin The boundary of the piece's tets, as check_fill() has shown.
[[nodiscard]] std::vector<SeamHash> seam_hashes(const mesh::Skin& skin,
                                                const mesh::Skeleton& skeleton);

/// @brief The signed hashes of all faces of a piece's tets, summed: inner faces cancel by
/// themselves, so it is that of the piece's surface. Local; linear.
[[nodiscard]] Hash128 surface_hash(const mesh::Piece& piece);

/// @brief The same of a part of a piece. So the hashes of parts sum up to that of the piece.
/// @param[in] inner_names Shape (num_vertices): what the parts call vertices that no other piece
/// has. Local.
[[nodiscard]] Hash128 surface_hash(const mesh::Piece& part,
                                   std::span<const LocalIndex> inner_names);

/// @brief The same from a skin that is known to be the surface of a piece. Local.
[[nodiscard]] Hash128 surface_hash(const mesh::Skin& skin);

/// @brief The signed hashes of the skin's triangles on the outside of the model, summed. Over all
/// pieces that is what their surface_hash() must sum up to, whatever the pieces have exchanged.
/// Local.
[[nodiscard]] Hash128 outside_hash(const mesh::Skin& skin, const mesh::Skeleton& skeleton);

/// @brief The first skeleton triangle inside the model on which the two sides do not cancel, in
/// words; nothing if all do.
/// @param[in] sums Shape (num skeleton triangles): the sum of both sides' hashes.
/// @param[in] is_made Shape (num_subdomains): triangles beside a subdomain that is not are passed
/// over; empty: all are. Local.
[[nodiscard]] std::optional<std::string> first_open_seam(const std::vector<Hash128>& sums,
                                                         const mesh::Skeleton& skeleton,
                                                         const std::vector<char>& is_made = {});

}  // namespace tessera::verify

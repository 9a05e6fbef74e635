// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/formats/piece.hpp"

#include "formats/piece_source.hpp"

namespace tessera::formats {

/// @brief What a piece shares with others; rows are those of its file. Stays in memory while pieces
/// come and go, so it has nothing of the size of a piece but of its surface.
struct PieceLinks {
  std::vector<LocalIndex> shared_points{};  ///< Ascending.
  IndexLists sharers{};                     ///< Other pieces of each, ascending.
  /// Numbers in the whole mesh of the shared points; of the own ones kNoNumber.
  std::vector<GlobalIndex> shared_numbers{};
  std::vector<SeamFace> seams{};  ///< Ascending by side.
  /// Shape (num_seams): faces with both tets in the piece that tets up to this one own.
  std::vector<LocalIndex> inner_faces_up_to{};
  std::vector<LocalIndex> open_sides{};           ///< On no second tet anywhere; ascending.
  std::vector<std::uint8_t> is_inner_triangle{};  ///< Shape (num_triangles).
  std::vector<PatchPoint> patch_points{};         ///< As Piece::patch_points; empty unless wanted.
  std::vector<std::array<LocalIndex, 2>> shared_edges{};  ///< Empty unless wanted.
  IndexLists edge_sharers{};                              ///< Other pieces of each, ascending.
};
inline constexpr GlobalIndex kNoNumber = -1;
inline constexpr std::int32_t kNoPatch = 0;

/// @brief The other pieces that have something, ascending; an answer to the piece that asks.
struct OtherPieces {
  std::vector<LocalIndex> pieces{};

  static auto fields(auto& self) { return std::tie(self.pieces); }
};

/// @brief What is found beside shared points and faces.
struct LinkOptions {
  bool shared_edges = false;
  bool face_numbers = false;  ///< Of the faces between pieces.
  bool patch_points = false;  ///< And PieceCounts::points_of_patch.
};

/// @brief From the values in files to tags from 1 with names.
struct Tags {
  std::map<std::int32_t, std::int32_t> tag_of_material{};
  std::map<std::int32_t, std::int32_t> tag_of_patch{};
  std::map<std::int32_t, std::int32_t> tag_of_line{};
};

struct LinkedMesh {
  Outline outline{};
  Tags tags{};
  std::vector<PieceLinks> links{};  ///< Of this rank's pieces.
};

/// @brief Reads all pieces once and finds what they share, how many there are of everything, and
/// where the numbers of each begin.
/// @note Collective. @throws InputError on all ranks.
[[nodiscard]] LinkedMesh link_pieces(const PieceSource& source, const comm::Communicator& comm,
                                     const std::function<void()>& before_each,
                                     const LinkOptions& options = {});

/// @brief Joins what the files hold and what was found. Local.
[[nodiscard]] Piece build_piece(LoadedPiece loaded, LocalIndex number, const PieceLinks& links,
                                const LinkedMesh& mesh);

/// @brief Reads and builds the pieces of a rank in their order, one at a time. Local.
/// @param[in] visit Called with each, and with its row in `mesh.links`.
void for_each_piece(const PieceSource& source, const LinkedMesh& mesh, Rank rank,
                    const std::function<void()>& before_each,
                    const std::function<void(Piece piece, std::size_t row)>& visit);

}  // namespace tessera::formats

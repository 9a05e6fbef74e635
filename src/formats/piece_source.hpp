// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tessera/base/entity_key.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/io/options.hpp"

namespace tessera::formats {

/// @brief A piece as it stands in its files, with what is easily told of it. Of second order the
/// nodes on edges are points as well: the last ones.
struct LoadedPiece {
  std::vector<double> point_xyz{};       ///< Shape (num_points, 3).
  std::vector<VertexKey> point_keys{};   ///< Shape (num_points): the same in all pieces.
  std::vector<LocalIndex> tet_points{};  ///< Shape (num_tets, 4): corners; positive.
  std::vector<LocalIndex> tet_nodes{};   ///< Shape (num_tets, 6), kQuadraticTetEdges; or empty.
  LocalIndex num_nodes = 0;              ///< Points that are nodes.
  std::vector<std::int32_t> material{};  ///< Shape (num_tets), as in the file.
  std::vector<LocalIndex>
      tet_cell{};  ///< Shape (num_tets): as Piece::tet_cell; of second order a cell each.
  std::vector<LocalIndex> triangle_side{};  ///< Shape (num_triangles): 4 * tet + opposite corner.
  std::vector<std::int32_t> patch{};        ///< Shape (num_triangles), as in the file.
  std::vector<LocalIndex> line_points{};    ///< Shape (num_line_edges, 2); 3 of second order.
  std::vector<std::int32_t> line{};         ///< Shape (num_line_edges), as in the file.

  [[nodiscard]] LocalIndex num_points() const { return static_cast<LocalIndex>(point_keys.size()); }
  [[nodiscard]] LocalIndex num_tets() const { return static_cast<LocalIndex>(material.size()); }
  [[nodiscard]] int points_per_tet() const
  {
    if (material.empty()) return 0;
    return tet_nodes.empty() ? 4 : 10;
  }

  /// @brief Its three corners, seen from outside of its tet; then the nodes between the first and
  /// the second, the second and the third, the third and the first. Local.
  /// @param[in] side 4 * tet + opposite corner.
  [[nodiscard]] std::vector<LocalIndex> points_of_side(LocalIndex side) const;
};

/// @brief Names that stand in the files of a mesh, row by row; empty where there are none.
struct FileNames {
  std::vector<std::string> materials{};  ///< Of "attribute" 1, 2, …
  std::vector<std::string> patches{};    ///< Of "patch" 0, 1, …
  std::string length_unit{};
  std::vector<std::string> periodic{};  ///< As mesh::to_texts() has them.
  std::vector<std::string> lines{};     ///< Of "line" 0, 1, …
};

/// @brief The files of a mesh, and which rank reads which.
class PieceSource {
 public:
  /// @brief Finds the files, and how points of different pieces are recognised. @note Collective.
  /// @throws InputError on all ranks, naming the file.
  /// @param[in] layers What the tets of a prism are: one cell, or cells of their own.
  PieceSource(const std::filesystem::path& index, const comm::Communicator& comm,
              io::LayerCells layers = io::LayerCells::prisms);

  [[nodiscard]] LocalIndex num_pieces() const { return static_cast<LocalIndex>(tets_.size()); }
  /// @brief Whether files say which triangles are on the geometry.
  [[nodiscard]] bool has_boundary() const { return boundary_.has_value(); }
  [[nodiscard]] const FileNames& names() const { return names_; }

  /// @brief The pieces of a rank: first…last-1.
  [[nodiscard]] LocalIndex first_of(Rank rank) const;

  /// @brief Reads a piece. Local. @throws InputError naming the file.
  [[nodiscard]] LoadedPiece load(LocalIndex piece) const;

  /// @brief Its file, for messages.
  [[nodiscard]] const std::filesystem::path& file(LocalIndex piece) const
  {
    return tets_[at(piece)];
  }

 private:
  using OptionalFiles = std::optional<std::vector<std::filesystem::path>>;

  // By piece, of an index beside that of the mesh.
  [[nodiscard]] OptionalFiles files_beside(const std::filesystem::path& index,
                                           const std::string& name,
                                           const comm::Communicator& comm) const;

  int num_ranks_;
  io::LayerCells layers_;
  std::vector<std::filesystem::path> tets_;
  OptionalFiles boundary_{};  ///< Empty path: none.
  OptionalFiles lines_{};
  VertexIdentity identity_ = VertexIdentity::ids;
  FileNames names_{};
};

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief A face of a tet among those with the same lowest vertex.
struct FaceOfTet {
  std::uint64_t others = 0;  ///< Its middle and its highest vertex, in one word.
  std::uint32_t corner_and_side = 0;

  /// @brief 4 t + c: the corner of tet t that it is opposite to.
  [[nodiscard]] LocalIndex corner() const { return static_cast<LocalIndex>(corner_and_side >> 1); }
  /// @brief On which of its sides the tet lies.
  [[nodiscard]] bool side() const { return (corner_and_side & 1) != 0; }
  [[nodiscard]] std::array<LocalIndex, 2> other_vertices() const
  {
    return {static_cast<LocalIndex>(others >> 32), static_cast<LocalIndex>(others & 0xffffffffU)};
  }
};

/// @brief The faces of tets, one lowest vertex after the other, in linear time and with 16 bytes a
/// tet. Local.
class FacesByVertex {
 public:
  /// @param[in] tet_vertices Shape (num_tets, 4): each below `num_vertices`. It must live on.
  FacesByVertex(std::span<const LocalIndex> tet_vertices, LocalIndex num_vertices);

  /// @brief The faces whose lowest vertex is `v`, until the next call.
  [[nodiscard]] std::span<FaceOfTet> at_vertex(LocalIndex v);

 private:
  // Lists of tets, one a vertex.
  struct TetLists {
    std::vector<LocalIndex> first{};  // Shape (num_vertices).
    std::vector<LocalIndex> next{};   // Shape (num_tets).
  };

  void add_face(LocalIndex tet, std::size_t without);

  std::span<const LocalIndex> tet_vertices_;
  TetLists of_lowest_;  // The lowest vertex of a face is that of its tet,
  TetLists of_second_;  // but for the one opposite to it.
  std::vector<FaceOfTet> faces_{};
};

}  // namespace tessera::mesh

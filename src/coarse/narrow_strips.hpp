// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/size_points.hpp"

namespace tessera::coarse {

/// @brief Patches of the faces at each vertex; none inside the volume. Shape (num_vertices).
using VertexPatches = std::vector<std::set<LocalIndex>>;

/// @brief How short edges may be, and what the first mesh has, by which its growth is bounded.
struct StripLimits {
  double least_size = 0.0;
  LocalIndex num_first_tets = 0;
};

/// @brief Sizes along the narrow strips of a surface that `sharp` tets lie at: where two curves are
/// much nearer to each other than the edges of this mesh are long. Local.
///
/// Edges across such a strip are short, those along it long, so triangles are needles; and chords
/// of two curves that bend beside each other may cross once they are split. Edges along it shall be
/// a few times its width.
/// @param sharp Rows of tets.
/// @return None if there is no such strip, or if the finer mesh would be out of proportion.
[[nodiscard]] mesh::SizePoints sizes_of_narrow_strips(const mesh::CoarseMesh& mesh,
                                                      const VertexPatches& patches,
                                                      const std::vector<LocalIndex>& sharp,
                                                      const StripLimits& limits);

}  // namespace tessera::coarse

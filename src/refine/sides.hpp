// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/complex.hpp"
#include "tessera/refine/lattice_refiner.hpp"

namespace tessera::refine {

/// @brief Which ends of columns are refined. Without layers there are those of the tets only.
enum class Side { tets, walls };

/// @brief Whether an edge of a complex lies on a wall. Local, as all here.
[[nodiscard]] bool is_wall_edge(const mesh::Complex& complex, const RefineContext& context,
                                LocalIndex e);

/// @brief The same of a triangle.
[[nodiscard]] bool is_wall_triangle(const mesh::Complex& complex, const RefineContext& context,
                                    LocalIndex t);

/// @brief Where the column of a coarse vertex ends on one side. @pre Side::tets, or there are
/// layers.
[[nodiscard]] Vec3 end_of_column(const RefineContext& context, Side side, LocalIndex coarse_vertex);

[[nodiscard]] bool has_column(const RefineContext& context, LocalIndex coarse_vertex);

/// @brief Whether columns stand on an edge of the skeleton.
[[nodiscard]] bool has_columns(const RefineContext& context, LocalIndex edge);

/// @brief By which table an edge of the skeleton is refined as another one. On both sides of a
/// split or a joint all is alike but the columns.
[[nodiscard]] const mesh::OrbitTable& orbits_of_edge(const RefineContext& context, Side side,
                                                     LocalIndex edge);

}  // namespace tessera::refine

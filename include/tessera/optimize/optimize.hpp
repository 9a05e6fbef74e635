// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/optimize/instruction_set.hpp"
#include "tessera/optimize/schedule.hpp"
#include "tessera/optimize/tet_mesh.hpp"

namespace tessera::optimize {

/// @brief The least mean ratio of a tet that counts as positive. Below it rounding would decide
/// which side of its face a vertex lies on.
inline constexpr double kLeastMeanRatio = 1e-8;

/// @brief What an optimisation did.
struct Statistics {
  int num_passes = 0;
  GlobalIndex num_untangled = 0;   ///< Tets that began flat or inverted.
  GlobalIndex num_moves = 0;       ///< Steps of vertices by smoothing.
  GlobalIndex num_swaps = 0;       ///< Edges removed and faces exchanged.
  GlobalIndex num_collapses = 0;   ///< Vertices removed by collapses.
  GlobalIndex num_insertions = 0;  ///< Vertices put in.
  GlobalIndex num_divided = 0;     ///< Tets that Step::divide has divided.
};

/// @brief A better mesh with the same boundary.
struct OptimizeResult {
  std::vector<double> vertex_xyz{};         ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};   ///< Shape (num_tets, 4); positive, VTK's order.
  std::vector<LocalIndex> vertex_origin{};  ///< Shape (num_vertices): row of the input, ascending;
                                            ///< then kNoIndex for those put in.
  Statistics statistics{};
};

/// @brief How optimize() works, apart from what it does.
struct OptimizeOptions {
  /// Tets may begin flat or inverted: before the schedule free vertices are moved, swaps and
  /// collapses tried, until all are positive.
  bool untangle = false;
  std::optional<InstructionSet> instruction_set{};  ///< Default: the last of the available ones.
};

/// @brief Makes tets better inside a fixed boundary. Vertices are moved, merged and put in, edges
/// and faces are swapped, as the schedule says.
///
/// Promises, each for every valid input:
/// - Fixed vertices and boundary triangles are those of the input, bit by bit.
/// - Every tet is positive (kLeastMeanRatio), so the volume is that of the input to rounding.
/// - No step but Step::divide makes a tet that is worse than the worst of the input. So without it
///   the smallest mean ratio does not fall, but for rounding.
/// - Vertices of the input that are left keep their order; so fixed vertices that come first stay
///   first. Tets lie along a space-filling curve through the input.
/// - The result depends on the arguments alone: passes are counted, not timed, and every
///   instruction set gives the same bits.
///
/// The energy of a tet is f = eta^-3 = S^3 / (432 w^2). S is the sum of its squared edges, and w is
/// six times its volume. f needs no root, and is convex in each vertex while the tet is positive.
/// @cite freitag1997swapping  Swaps and smoothing together.
/// @cite knupp2001  Energies of this kind and Newton's method for them.
/// @cite klingner2008  Vertices put into cavities that grow.
/// @param[in] mesh Vertices that no tet has are kept. No tets at all are valid.
/// @throws MeshError naming the tet, if one has an index out of range or a corner that is not
/// finite, or is flat or inverted. Also if a triangle belongs to more than two tets, two tets lie
/// on the same side of one, the neighbours given are wrong, or there are 2^29 tets or more. With
/// OptimizeOptions::untangle tets may begin flat or inverted; it throws if one stays so, and names
/// the first that began so.
/// @note Local; linear in the tets: 1 to 2 microseconds each with AVX2.
[[nodiscard]] OptimizeResult optimize(const TetMesh& mesh, const Schedule& schedule,
                                      const OptimizeOptions& options = {});

}  // namespace tessera::optimize

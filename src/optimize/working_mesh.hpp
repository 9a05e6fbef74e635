// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/optimize/optimize.hpp"
#include "tessera/optimize/tet_mesh.hpp"

#include "optimize/corners.hpp"
#include "optimize/kernels/kernels.hpp"
#include "optimize/point.hpp"

namespace tessera::optimize {

// The mesh while it is optimised: flat arrays, vertices along a space curve, tets by their lowest
// vertex. A removed tet leaves a free slot, whose first vertex is kNoIndex.
//
// One array a property: a pass reads few of them, and a record of 64 bytes a tet was slower. Flags
// are bytes, so they are not set where positions are written: a compiler must take a byte for an
// alias of anything.
struct WorkingMesh {
  double scale = 1.0;  // Working position = the caller's * scale; a power of two, so exact.

  std::vector<Point> points{};
  // Row of the caller's mesh; vertices put in have the numbers behind its last one.
  std::vector<LocalIndex> vertex_origin{};
  std::vector<std::uint8_t> vertex_fixed{};
  std::vector<std::uint8_t> vertex_removed{};
  std::vector<std::uint8_t> vertex_to_smooth{};    // Something changed since it was smoothed.
  std::vector<std::uint8_t> vertex_to_collapse{};  // Something changed since a collapse was tried.

  std::vector<LocalIndex> tet_vertices{};    // Shape (num_slots, 4).
  std::vector<LocalIndex> tet_neighbours{};  // Shape (num_slots, 4): corner across the face, or
                                             // what stands for the boundary: see corners.hpp.
  std::vector<double> tet_energy{};          // As of the last refresh_energies().
  std::vector<double> tet_cost{};
  std::vector<std::uint8_t> tet_to_swap{};  // Its shape changed since swaps were tried.
  std::vector<LocalIndex> free_slots{};

  // Corners at each vertex; as of the last refresh_stars().
  std::vector<LocalIndex> star_offsets{};  // Shape (num_vertices + 1).
  std::vector<Corner> star_corners{};

  bool has_outer_faces = false;
  bool are_energies_stale = true;
  bool are_stars_stale = true;
  LocalIndex first_not_positive = kNoIndex;  // Of the caller's tets.
  double worst_energy = 0.0;                 // No step makes a tet with a higher one.

  const Kernels* kernels = nullptr;
  Statistics statistics{};

  [[nodiscard]] LocalIndex num_vertices() const { return static_cast<LocalIndex>(points.size()); }
  [[nodiscard]] LocalIndex num_slots() const { return static_cast<LocalIndex>(tet_energy.size()); }
  [[nodiscard]] bool is_free_slot(LocalIndex t) const { return tet_vertices[4 * at(t)] < 0; }
  [[nodiscard]] const Point& corner_point(Corner corner) const
  {
    return points[at(tet_vertices[at(corner)])];
  }
  [[nodiscard]] StarView stars() const
  {
    return {points.data(), tet_vertices.data(), star_offsets.data(), star_corners.data()};
  }
};

// Checks and orders a mesh. Throws MeshError as optimize() says.
[[nodiscard]] WorkingMesh make_working_mesh(const TetMesh& mesh, const Kernels& kernels,
                                            bool may_be_tangled);

// The same in the caller's order and without neighbours, for passes that only move vertices. The
// fixed vertices are the flagged ones alone.
[[nodiscard]] WorkingMesh make_smoothing_mesh(const TetMesh& mesh);

// Of a tet, by what lies across its faces: outer faces beside the first one of each group, 0 to 3.
[[nodiscard]] std::size_t num_doubled_faces(std::span<const Corner, 4> across);
[[nodiscard]] inline std::size_t num_doubled_faces(const WorkingMesh& mesh, LocalIndex tet)
{
  return num_doubled_faces(std::span(mesh.tet_neighbours).subspan(4 * at(tet)).first<4>());
}

// A free vertex of no tet.
[[nodiscard]] LocalIndex add_vertex(WorkingMesh& mesh, const Vec3& position);

// Tets that are flat or inverted, by their energies.
[[nodiscard]] LocalIndex count_not_positive(const WorkingMesh& mesh);

// Throws MeshError naming the caller's first tet that was not positive, if one is not.
void require_positive(const WorkingMesh& mesh);

// Back to the caller's order and units.
[[nodiscard]] OptimizeResult to_result(const WorkingMesh& mesh, const TetMesh& input);

// Positions of all vertices in the caller's units, those of fixed ones bit by bit. Of a smoothing
// mesh.
[[nodiscard]] std::vector<double> positions_of(const WorkingMesh& mesh, const TetMesh& input);

void refresh_energies(WorkingMesh& mesh);

// From now on no step makes a tet that is worse than the worst one of now.
void tighten_bound(WorkingMesh& mesh);

void refresh_stars(WorkingMesh& mesh);

}  // namespace tessera::optimize

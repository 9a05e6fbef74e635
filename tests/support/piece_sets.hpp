// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tessera/improve/improve_region.hpp"
#include "tessera/improve/seam_regions.hpp"
#include "tessera/mesh/piece.hpp"

#include "support/bodies.hpp"

namespace tessera::testing {

/// @brief The coarse tets of each subdomain as a piece: what refinement by no level leaves.
[[nodiscard]] std::vector<mesh::Piece> coarse_pieces(const Body& body);

/// @brief The bands of a region. @param[in] pieces Shape (num_subdomains).
[[nodiscard]] std::vector<improve::Band> bands_of_region(const std::vector<mesh::Piece>& pieces,
                                                         const improve::SeamRegions& regions,
                                                         LocalIndex region, int layers);

/// @brief Row of a value in an ascending list that has it.
[[nodiscard]] std::size_t row_in(LocalIndex value, std::span<const LocalIndex> ascending);

/// @brief Mean ratio and dihedral angle of some tets.
[[nodiscard]] improve::ShapeSummary measure_shapes(const improve::TetMesh& tets);

/// @brief How a set of pieces is improved, in this process.
struct ImproveSetup {
  const improve::Optimizer& optimizer;
  int rounds = 1;
  int layers = improve::kDefaultLayers;
  improve::MeasureShapes measure = measure_shapes;
};

/// @brief What a phase did.
struct PhaseCount {
  LocalIndex num_accepted = 0;
  LocalIndex num_splits = 0;            ///< In all regions.
  std::vector<std::string> refusals{};  ///< Of regions that keep their tets.
};

/// @brief Runs one phase over all pieces, as jobs and ranks of a run would: every region sees the
/// pieces as the phase before left them.
/// @param[in,out] pieces Shape (num_subdomains).
[[nodiscard]] PhaseCount improve_phase(const improve::SeamRegions& regions, int phase,
                                       const ImproveSetup& setup, std::vector<mesh::Piece>& pieces);

/// @brief The first way in which pieces do not make one mesh, in words; empty if they do: all tets
/// positive; a shared vertex has the same bits in all its pieces and stands once in each; each
/// triangle of a tet has its mirror in the same or another piece, or is in exactly one piece's list
/// of triangles on the geometry, with its tet behind it; every vertex is used.
[[nodiscard]] std::string first_flaw(const std::vector<mesh::Piece>& pieces);

/// @brief Sum of the tets' volumes.
[[nodiscard]] double volume_of(const std::vector<mesh::Piece>& pieces);

/// @brief By piece and vertex: whether pieces of the same material share the vertex.
[[nodiscard]] std::vector<std::vector<char>> vertices_on_seams(
    const std::vector<mesh::Piece>& pieces);

}  // namespace tessera::testing

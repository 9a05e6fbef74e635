// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/subdomain/refine_piece.hpp"

#include "subdomain/refine/split_surface.hpp"

namespace tessera::subdomain {

// Gives the tets of a piece their nodes of second order: points of a split by one level.
class PieceCurver {
 public:
  // All borrowed. @param[in] surface Of the piece, split by one level.
  PieceCurver(const mesh::Piece& piece, const PieceSurroundings& around,
              const SplitSurface& surface);

  // A piece with tets whose Jacobian is not certainly positive comes back without tets.
  [[nodiscard]] RefinedPiece run(const refine::RefineContext& refine,
                                 const PieceSummary& before) const;

 private:
  [[nodiscard]] mesh::Piece curved(const mesh::Skin& skin,
                                   const mesh::RefinedLattice& points) const;
  void place_nodes(const mesh::RefinedLattice& points, const mesh::LatticeNumbering& numbering,
                   mesh::Piece& curved) const;
  void add_tets(const mesh::LatticeNumbering& numbering, mesh::Piece& curved) const;
  void add_boundary(mesh::Piece& curved) const;
  void add_lines(const mesh::LatticeNumbering& numbering, mesh::Piece& curved) const;
  [[nodiscard]] FillResult measure(const mesh::Piece& curved, const mesh::Skin& skin,
                                   const PieceSummary& before) const;

  const mesh::Piece& piece_;
  const PieceSurroundings& around_;
  const SplitSurface& surface_;
  const PieceComplex& all_;  // Of the surface.
};

}  // namespace tessera::subdomain

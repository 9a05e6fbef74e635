// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/number/surface_simplices.hpp"

namespace tessera::subdomain {

// A piece and tets of its neighbours, in the form in which subdivision knows the coarse mesh. The
// surface of the piece takes the place of the skeleton. Named vertices come first, by ascending
// names: so lattices of what pieces share read the same in all of them.
struct PieceComplex {
  mesh::CoarseMesh mesh{};               // Vertices and tets only.
  std::vector<mesh::HostPoint> names{};  // Of the first vertices.
  mesh::Skeleton surface{};              // Vertices, edges and triangles; without their geometry.
  mesh::TetComplex complex{};            // Of all tets, in the order of the mesh.
  LocalIndex first_tet = 0;              // Of the piece itself.
  LocalIndex last_tet = 0;
};

// Tets are in the order of their subdomains, and of each piece in its own order: around a shared
// vertex they come in the same order in all pieces.
// @param[in] halos Tets of other pieces; ascending by subdomain.
// Throws MeshError if a vertex belongs to no tet.
[[nodiscard]] PieceComplex make_piece_complex(const mesh::Piece& piece,
                                              std::span<const mesh::Piece> halos,
                                              const number::SurfaceSimplices& surface);

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/piece.hpp"

namespace tessera::mesh {

Bytes to_bytes(const Piece& piece)
{
  ByteWriter out;
  out.put(piece.subdomain);
  out.put(piece.material);
  out.put(piece.vertex_xyz);
  out.put(piece.skin_host);
  out.put(piece.skin_index);
  out.put(piece.tet_vertices);
  out.put(piece.boundary_vertices);
  out.put(piece.boundary_patch);
  out.put(piece.boundary_tet);
  return std::move(out).take();
}

Piece piece_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  Piece piece;
  piece.subdomain = in.get<LocalIndex>();
  piece.material = in.get<LocalIndex>();
  piece.vertex_xyz = in.get_vector<double>();
  piece.skin_host = in.get_vector<HostEntity>();
  piece.skin_index = in.get_vector<LocalIndex>();
  piece.tet_vertices = in.get_vector<LocalIndex>();
  piece.boundary_vertices = in.get_vector<LocalIndex>();
  piece.boundary_patch = in.get_vector<LocalIndex>();
  piece.boundary_tet = in.get_vector<LocalIndex>();
  return piece;
}

}  // namespace tessera::mesh

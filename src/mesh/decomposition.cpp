// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/decomposition.hpp"

namespace tessera::mesh {

Bytes to_bytes(const Decomposition& decomposition)
{
  ByteWriter out;
  out.put(decomposition.tet_subdomain);
  out.put(decomposition.subdomain_material);
  out.put(decomposition.subdomain_weight);
  out.put(decomposition.part_offsets);
  out.put(decomposition.neighbour_offsets);
  out.put(decomposition.neighbours);
  out.put(decomposition.neighbour_triangles);
  out.put(decomposition.neighbour_area);
  return std::move(out).take();
}

Decomposition decomposition_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  Decomposition decomposition;
  decomposition.tet_subdomain = in.get_vector<LocalIndex>();
  decomposition.subdomain_material = in.get_vector<LocalIndex>();
  decomposition.subdomain_weight = in.get_vector<double>();
  decomposition.part_offsets = in.get_vector<LocalIndex>();
  decomposition.neighbour_offsets = in.get_vector<LocalIndex>();
  decomposition.neighbours = in.get_vector<LocalIndex>();
  decomposition.neighbour_triangles = in.get_vector<LocalIndex>();
  decomposition.neighbour_area = in.get_vector<double>();
  return decomposition;
}

}  // namespace tessera::mesh

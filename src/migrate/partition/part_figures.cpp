// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/part_figures.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>

#include "tessera/base/tet.hpp"
#include "tessera/base/union_find.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::migrate {
namespace {

void count_tets(const DistributedMesh& mesh, std::vector<PartFigures>& parts)
{
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    PartFigures& part = parts[at(mesh.tet_part[at(t)])];
    ++part.num_tets;
    part.volume += tet_volume(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t));
  }
  for (const LocalIndex t : mesh.boundary_tet) ++parts[at(mesh.tet_part[at(t)])].num_boundary;
}

void count_neighbours(const DistributedMesh& mesh, const TetNeighbours& neighbours,
                      const std::vector<GlobalIndex>& remote_parts, std::vector<PartFigures>& parts)
{
  UnionFind components(mesh.num_tets());
  for (std::size_t side = 0; side < neighbours.behind.size(); ++side) {
    const LocalIndex behind = neighbours.behind[side];
    if (behind == kNoIndex) continue;
    const auto tet = static_cast<LocalIndex>(side / 4);
    const LocalIndex part = mesh.tet_part[at(tet)];
    const bool is_remote = behind >= mesh.num_tets();
    const GlobalIndex other = is_remote ? remote_parts[at(behind - mesh.num_tets())]
                                        : GlobalIndex{mesh.tet_part[at(behind)]};
    if (other != part)
      ++parts[at(part)].num_cut_triangles;
    else if (!is_remote)
      components.join(tet, behind);
  }
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (components.find(t) == t) ++parts[at(mesh.tet_part[at(t)])].num_components;
  }
}

}  // namespace

std::vector<PartFigures> measure_parts(const comm::Communicator& comm, const DistributedMesh& mesh,
                                       const TetNeighbours& neighbours, LocalIndex num_parts)
{
  std::vector<PartFigures> parts(at(num_parts));
  const std::vector<GlobalIndex> tet_parts(mesh.tet_part.begin(), mesh.tet_part.end());
  count_tets(mesh, parts);
  count_neighbours(mesh, neighbours, values_behind(comm, neighbours, tet_parts), parts);

  // Of each part all ranks but one have zeros, so that the sum of the bits is that rank's value.
  std::vector<std::uint64_t> bits;
  for (const PartFigures& part : parts) bits.push_back(std::bit_cast<std::uint64_t>(part.volume));
  comm.sum_in_place(bits);
  std::vector<GlobalIndex> counts;
  for (const PartFigures& part : parts) {
    counts.insert(counts.end(),
                  {part.num_tets, part.num_boundary, part.num_components, part.num_cut_triangles});
  }
  comm.sum_in_place(counts);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const GlobalIndex* const count = &counts[4 * p];
    parts[p] = {count[0], count[1], count[2], count[3], std::bit_cast<double>(bits[p])};
  }
  return parts;
}

}  // namespace tessera::migrate

// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/tet_changes.hpp"

#include <utility>

namespace tessera::coarse {

void TetChanges::add(const Tet& tet, LocalIndex old)
{
  new_tets_.push_back(tet);
  old_.push_back(old);
}

std::vector<LocalIndex> TetChanges::apply(mesh::CoarseMesh& mesh) const
{
  std::vector<LocalIndex> rows;
  FlatArray<LocalIndex> tets;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (is_gone(t)) continue;
    rows.push_back(t);
    const auto tet = mesh.tet(t);
    tets.insert(tets.end(), tet.begin(), tet.end());
  }
  rows.insert(rows.end(), old_.begin(), old_.end());
  for (const Tet& tet : new_tets_) tets.insert(tets.end(), tet.begin(), tet.end());
  FlatArray<LocalIndex> materials;
  for (const LocalIndex t : rows) materials.push_back(mesh.tet_material[at(t)]);
  mesh.tet_vertices = std::move(tets);
  mesh.tet_material = std::move(materials);
  return rows;
}

}  // namespace tessera::coarse

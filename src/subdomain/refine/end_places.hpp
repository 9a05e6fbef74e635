// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/number/surface_simplices.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/refine_piece.hpp"

namespace tessera::subdomain {

// Who numbers the points of surfaces across joints, by the triangles of this piece in front of
// them.
class EndPlaces {
 public:
  // Borrowed.
  EndPlaces(const PieceSurroundings& around, const LayerTables& tables);

  // Of point `p` of a triangle with these corners, which has n intervals; no owner if its column
  // does not end at tets there.
  [[nodiscard]] number::SimplexPlace of(const std::array<mesh::HostPoint, 3>& corners, LocalIndex n,
                                        const mesh::lattice::TrianglePoint& p) const;

 private:
  [[nodiscard]] mesh::HostPoint end(const mesh::HostPoint& name) const
  {
    return tables_.end_at_tets(name);
  }

  const number::SurfacePlaces& places_;
  const LayerTables& tables_;
  number::SurfaceSimplices ends_{};
};

}  // namespace tessera::subdomain

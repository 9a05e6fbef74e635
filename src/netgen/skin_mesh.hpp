// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <meshing.hpp>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/fill/kernel.hpp"

namespace tessera::netgen {

// A point of ours as NETGEN's.
[[nodiscard]] ::netgen::Point3d to_netgen(const Vec3& p);

// Order in which NETGEN gets the skin's vertices: entry i is the vertex that comes as number i.
// Seed 0: as given; else another fixed order.
[[nodiscard]] std::vector<LocalIndex> point_order(LocalIndex num_vertices, unsigned seed);

// Makes the skin the surface of an empty NETGEN mesh, with domain 1 inside.
void add_skin(::netgen::Mesh& mesh, const fill::FillInput& input,
              const std::vector<LocalIndex>& order);

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/box.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/surface/coarse_surface.hpp"

namespace tessera::netgen {

// A point of ours as NETGEN's.
[[nodiscard]] ::netgen::Point3d to_point3d(const Vec3& p);

// Order in which NETGEN gets the skin's vertices: entry i is the vertex that comes as number i.
// Seed 0: as given; else another fixed order.
[[nodiscard]] std::vector<LocalIndex> point_order(LocalIndex num_vertices, unsigned seed);

// Makes a closed triangle surface that of an empty NETGEN mesh, with domain 1 inside. The vertices
// are the rows of `vertex_xyz` that `order` names; shape of the triangles (n, 3).
void add_surface(::netgen::Mesh& mesh, const std::vector<double>& vertex_xyz,
                 const std::vector<LocalIndex>& triangle_vertices,
                 const std::vector<LocalIndex>& order);

// Makes the skin of a domain of a coarse mesh that of an empty NETGEN mesh, with patches and
// curves: NETGEN wants no tet with two faces on one patch.
void add_skin(::netgen::Mesh& mesh, const surface::DomainSkin& skin);

// The sizes that NETGEN would want inside of the skin. They are kept in a grid through `box`, and
// so tets inside depend on where that lies.
void set_sizes(::netgen::Mesh& mesh, const Box& box, const ::netgen::MeshingParameters& parameters);

// Vertices and tets of a NETGEN mesh, as ours: number i of NETGEN's is order[i] where there is one.
struct OrderedTets {
  std::vector<double> vertex_xyz{};
  std::vector<LocalIndex> tet_vertices{};
};

// Throws NetgenError if the mesh has fewer vertices than `order`.
[[nodiscard]] OrderedTets tets_of(const ::netgen::Mesh& mesh, const std::vector<LocalIndex>& order);

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/wake_triangle.hpp"
#include "tessera/model/model.hpp"
#include "tessera/topology/options.hpp"

/// Cracks, baffles and contacts: triangles between two materials along which a mesh is opened. Both
/// sides have points of their own there, at the same places. At the rim, where one can go around,
/// points stay single.
namespace tessera::topology {

/// @brief Whether the rim is too near somewhere: divide_at_rims() has something to do. Local.
/// @throws ConfigError if an entry fits no patch, or one that is not between two materials, or no
/// solid.
[[nodiscard]] bool are_rims_near(const mesh::CoarseMesh& mesh, const SplitOptions& options);

/// @brief Puts vertices into edges and triangles between the rim and the rim. Nothing could open
/// there, as a coarse edge is told by its ends. The vertices are on the geometry, or, where a tet
/// would not be positive, on the way there. Local.
/// @post !are_rims_near(). @throws as are_rims_near(); GeometryError if a projection fails.
void divide_at_rims(mesh::CoarseMesh& mesh, const SplitOptions& options, const model::Model& model);

/// @brief Opens a mesh. What is opened of a patch becomes two: the plus side on the material with
/// the lower number, and the minus side on the other one, which is its image: CoarseMesh::images.
/// Both keep its name: mesh::final_patch_names(). Of a joint the minus side is one with layers, and
/// both are one row; it stays closed where it has a rim all around. Copies of vertices stand right
/// behind each other, so on both sides all orders of vertices are the same: what is made of these
/// sides has the same bits. Local; O(n log n).
/// @pre !are_rims_near() without the joints; no layers. @post mesh::validate() accepts the mesh.
/// @throws as are_rims_near().
void split_patches(mesh::CoarseMesh& mesh, const SplitOptions& options);

/// @brief Opens a mesh along wakes as along joints: CoarseMesh::is_wake(). Local; O(n log n).
/// @pre Each triangle has a vertex whose tets all its triangles part in two. No face of a split, a
/// joint or another wake has such a vertex; periodic sides are opened alike.
/// @post mesh::validate() accepts the mesh.
void open_wakes(mesh::CoarseMesh& mesh, std::span<const mesh::WakeTriangle> wakes);

/// @brief Closes joints where no layers have grown: copies of a vertex that have no column become
/// one, and so do sides all of whose vertices do. Local; does nothing without joints.
/// @post mesh::validate() accepts the mesh. No two copies of a vertex at a joint lack a column.
void close_joints(mesh::CoarseMesh& mesh);

}  // namespace tessera::topology

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "tessera/comm/communicator.hpp"
#include "tessera/io/options.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

/// Which point is the image of which, in files of boundary triangles: for the k-th of the different
/// transforms of `periodic_patches` the point array `periodic_partner_k`. A point that a triangle
/// of an image has in the file has the id of the point whose image it is; all others have -1, and
/// so have those that match none.
namespace tessera::subdomain {

/// @brief Puts the arrays into files that are written. Each rank reads some of them twice.
/// @note Collective.
/// @param[in] files Of boundary triangles; the same on all ranks. Files without the field text are
/// left as they are.
/// @param[in] before_each Called before each file; may throw.
/// @return How many points of images match none, counted in each file.
/// @throws InputError, OutputError on all ranks if a file cannot be read or written.
GlobalIndex add_periodic_partners(std::span<const std::filesystem::path> files,
                                  io::Compression compression, const comm::Communicator& comm,
                                  const std::function<void()>& before_each);

/// @brief Adds the names of the arrays to what an index says of such files. Local.
void name_periodic_partners(mesh::MeshArrays& schema);

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/sizing/size_field.hpp"

namespace tessera::subdomain {

/// @brief The wanted sizes, with the file `options.field` if it is given. Local.
/// @throws ConfigError as SizeField; InputError as SizeField and io::read_point_field().
[[nodiscard]] sizing::SizeField read_size_field(const sizing::SizeOptions& options,
                                                const mesh::CoarseMesh& coarse);

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/hash.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/sizing/size_field.hpp"

namespace tessera::subdomain {

/// @brief The wanted sizes, with the file `options.field` if it is given. Local.
/// @throws ConfigError as SizeField; InputError as SizeField and io::read_point_field().
[[nodiscard]] sizing::SizeField read_size_field(const sizing::SizeOptions& options,
                                                const mesh::CoarseMesh& coarse);

/// @brief Hash of all values, points and cells of the field in the file `options.field`, whatever
/// files they stand in; zero if none is given. Local. @throws InputError as io::read_point_field().
[[nodiscard]] Hash128 size_field_content(const sizing::SizeOptions& options);

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"

#include "netgen/netgen_session.hpp"
#include "netgen/skin_mesh.hpp"

namespace tessera::netgen {

// Tets that fill a closed surface, made better by NETGEN's steps of the session's parameters. The
// vertices of the triangles come first and stay as they are, `num_fixed` of them.
//
// NETGEN gets no background size: its optimiser goes by shape alone, the result is the same with
// one.
[[nodiscard]] OrderedTets optimize_tets(const std::vector<double>& vertex_xyz,
                                        const std::vector<LocalIndex>& tet_vertices,
                                        const std::vector<LocalIndex>& triangle_vertices,
                                        LocalIndex num_fixed, NetgenSession& session);

}  // namespace tessera::netgen

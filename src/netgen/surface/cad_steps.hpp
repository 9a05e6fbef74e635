// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <mystdlib.h>
#include <occgeom.hpp>

namespace tessera::netgen {

/// @brief The surface of a triangulated geometry, by NETGEN. Local.
///
/// It takes NETGEN's steps one by one, as NETGEN takes no notice of size points here: they must be
/// set after the first step, which makes the sizes, and before the second, which follows them.
/// @return Nothing if NETGEN gave up.
[[nodiscard]] std::shared_ptr<::netgen::Mesh> mesh_occ_surface(
    ::netgen::OCCGeometry& geometry, ::netgen::MeshingParameters& parameters);

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/skin.hpp"
#include "tessera/model/model.hpp"
#include "tessera/refine/lattice_refiner.hpp"

namespace tessera::testing {

/// @brief A coarse mesh cut into subdomains, with its skeleton.
struct Body {
  mesh::CoarseMesh coarse{};
  mesh::Decomposition decomposition{};
  mesh::Skeleton skeleton{};

  Body(mesh::CoarseMesh given, mesh::Decomposition cut);

  [[nodiscard]] LocalIndex num_subdomains() const { return decomposition.num_subdomains(); }
};

/// @brief A complex and its refined lattice.
struct RefinedComplex {
  mesh::Complex complex{};
  mesh::RefinedLattice lattice{};
};

/// @brief Refines the skin of one subdomain.
[[nodiscard]] RefinedComplex refine_skin(const Body& body, const model::Model& model,
                                         const mesh::EdgeLevels& levels, LocalIndex subdomain,
                                         const mesh::ProjectionLimiter& limiter = {},
                                         bool measure_distance = false);

/// @brief The refined skin of one subdomain.
[[nodiscard]] mesh::Skin skin_of(const Body& body, const model::Model& model,
                                 const mesh::EdgeLevels& levels, LocalIndex subdomain,
                                 const mesh::ProjectionLimiter& limiter = {});

/// @brief The bits of a position, for comparisons that a rounding error or a sign of zero fails.
[[nodiscard]] inline std::array<std::uint64_t, 3> bits(const Vec3& p)
{
  return std::bit_cast<std::array<std::uint64_t, 3>>(p);
}

}  // namespace tessera::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "support/bodies.hpp"

#include <utility>

#include "tessera/refine/skin.hpp"

namespace tessera::testing {

Body::Body(mesh::CoarseMesh given, mesh::Decomposition cut)
    : coarse(std::move(given)),
      decomposition(std::move(cut)),
      skeleton(mesh::build_skeleton(coarse, decomposition))
{
}

RefinedComplex refine_skin(const Body& body, const model::Model& model,
                           const mesh::EdgeLevels& levels, LocalIndex subdomain,
                           const mesh::ProjectionLimiter& limiter, bool measure_distance)
{
  RefinedComplex refined{mesh::skin_complex(body.skeleton, subdomain), {}};
  refined.lattice = refine::refine_lattice(
      refined.complex, {body.coarse, body.skeleton, model, limiter, levels, measure_distance});
  return refined;
}

mesh::Skin skin_of(const Body& body, const model::Model& model, const mesh::EdgeLevels& levels,
                   LocalIndex subdomain, const mesh::ProjectionLimiter& limiter)
{
  const RefinedComplex refined = refine_skin(body, model, levels, subdomain, limiter);
  return refine::extract_skin(refined.complex, refined.lattice, body.skeleton, subdomain);
}

}  // namespace tessera::testing

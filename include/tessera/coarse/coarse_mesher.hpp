// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/coarse/options.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::coarse {

/// @brief Makes the coarse mesh of one loaded model.
class CoarseMesher {
 public:
  virtual ~CoarseMesher() = default;

  /// @brief One try with these options; the caller has the sequence of fallbacks.
  /// @note Local; may crash, exit or hang inside third-party code: run it in a job.
  /// @throws NetgenError with NETGEN's own words if it gives up or the result is not a valid mesh.
  /// @throws GeometryError if the model has no closed solid.
  [[nodiscard]] virtual mesh::CoarseMesh generate(const CoarseOptions& options) const = 0;
};

}  // namespace tessera::coarse

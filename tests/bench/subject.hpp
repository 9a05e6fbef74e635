// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/model/model.hpp"

namespace tessera::testing {

/// @brief A loaded model with its coarse mesh as one subdomain, for a benchmark.
struct Subject {
  std::string file;
  std::unique_ptr<model::Model> model;
  mesh::CoarseMesh coarse;
  mesh::Decomposition decomposition;
  mesh::Skeleton skeleton;

  /// @param[in] argument "MODEL=MAX_SIZE". @throws ConfigError if it has no such form.
  explicit Subject(const std::string& argument);
};

}  // namespace tessera::testing

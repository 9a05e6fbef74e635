// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>

#include "tessera/improve/improve_region.hpp"

namespace tessera::testing {

/// @brief Changes tets as an optimiser may, without making them better: faces between two tets are
/// exchanged for an edge wherever the three new tets are positive, and every seventh tet left gets
/// a vertex in its middle. Fixed vertices of different pieces become neighbours.
class FlippingOptimizer final : public improve::Optimizer {
 public:
  [[nodiscard]] improve::TetMesh optimize(const improve::OptimizeInput& input,
                                          int /*rounds*/) const override;
};

/// @brief Gives the old tets back after some change.
class ChangingOptimizer final : public improve::Optimizer {
 public:
  using Change = std::function<void(improve::TetMesh&)>;

  explicit ChangingOptimizer(Change change) : change_(std::move(change)) {}

  [[nodiscard]] improve::TetMesh optimize(const improve::OptimizeInput& input,
                                          int /*rounds*/) const override
  {
    improve::TetMesh tets = input.tets;
    change_(tets);
    return tets;
  }

 private:
  Change change_;
};

/// @brief A measure after which every new set of tets is better than the one before.
[[nodiscard]] improve::MeasureShapes always_better();

}  // namespace tessera::testing

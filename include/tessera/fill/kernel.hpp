// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/fill/options.hpp"

namespace tessera::fill {

/// @brief A closed, outward oriented triangle surface, and the wanted edge length inside it.
struct FillInput {
  std::vector<double> vertex_xyz{};  ///< Shape (num_vertices, 3).
  std::vector<LocalIndex>
      triangle_vertices{};         ///< Shape (num_triangles, 3); normals point outwards.
  std::vector<double> size_xyz{};  ///< Shape (num_samples, 3): where size_h holds.
  std::vector<double> size_h{};    ///< Shape (num_samples): wanted edge length there.
};

/// @brief Settings of one try; the ladder of tries is made of these.
struct FillTry {
  KernelKind kernel = KernelKind::netgen;  ///< The others are settings of NETGEN.
  double grading = 0.3;                    ///< Growth of the size away from the skin, in (0, 1].
  int optimize_steps = 2;                  ///< Optimisation rounds after the fill.
  unsigned point_order_seed = 0;           ///< 0: points as given; else another fixed order.
};

/// @brief Tets that fill a skin. Vertices [0, num skin vertices) are the skin's, in its order.
struct FillOutput {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.
};

/// @brief Fills a skin with tets without touching it.
class Kernel {
 public:
  virtual ~Kernel() = default;

  /// @note Local; may crash, exit or hang inside third-party code: run it in a job. A pure function
  /// of its arguments. The caller checks the result: nothing is promised about it.
  /// @throws NetgenError if the kernel gives up.
  [[nodiscard]] virtual FillOutput fill(const FillInput& input, const FillTry& settings) const = 0;
};

}  // namespace tessera::fill

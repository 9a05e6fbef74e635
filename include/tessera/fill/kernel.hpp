// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::fill {

/// @brief Tets that fill a skin. Vertices [0, num skin vertices) are the skin's, in its order.
struct FillOutput {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.
};

/// @brief What a fill gets: a closed, outward oriented triangle surface, and either tets that fill
/// it already or the wanted edge length inside it.
struct FillInput {
  std::vector<double> vertex_xyz{};  ///< Shape (num_vertices, 3).
  std::vector<LocalIndex>
      triangle_vertices{};         ///< Shape (num_triangles, 3); normals point outwards.
  std::vector<double> size_xyz{};  ///< Shape (num_samples, 3): where size_h holds.
  std::vector<double> size_h{};    ///< Shape (num_samples): wanted edge length there.
  FillOutput start{};              ///< Tets to be made better; empty: there are none yet.

  [[nodiscard]] bool has_start() const { return !start.tet_vertices.empty(); }
};

/// @brief Settings of a Kernel.
struct KernelSettings {
  double grading = 0.3;           ///< Growth of the size away from the skin, in (0, 1].
  int optimize_steps = 1;         ///< Optimisation rounds, >= 0.
  unsigned point_order_seed = 0;  ///< 0: points as given; else another fixed order.

  static auto fields(auto& self)
  {
    return std::tie(self.grading, self.optimize_steps, self.point_order_seed);
  }
};

/// @brief Fills a skin with tets without touching it.
class Kernel {
 public:
  virtual ~Kernel() = default;

  /// @brief Makes the tets of `input.start` better or, if there are none, meshes the skin alone.
  ///
  /// - With a start it reads the skin and the start, and of the settings `optimize_steps` only.
  /// With
  ///   0 steps it gives the start back.
  /// - Without a start it reads the skin, the size samples and all settings. Meshing a skin alone
  /// is
  ///   for tries after the first: it takes three to four times as long and may fail.
  ///
  /// subdomain::fill_subdomain() sets up both.
  /// @note Local; may crash, exit or hang inside third-party code: run it in a job. A pure function
  /// of its arguments. The caller checks the result: nothing is promised about it.
  /// @throws NetgenError if the kernel gives up.
  [[nodiscard]] virtual FillOutput fill(const FillInput& input,
                                        const KernelSettings& settings) const = 0;
};

}  // namespace tessera::fill

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/fill/options.hpp"

namespace tessera::fill {

/// @brief Tets that fill a skin. Vertices [0, num skin vertices) are the skin's, in its order.
struct FillOutput {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.
};

/// @brief A closed, outward oriented triangle surface, and what a fill of it begins with: tets that
/// fill it, or the wanted edge length inside it.
struct FillInput {
  std::vector<double> vertex_xyz{};  ///< Shape (num_vertices, 3).
  std::vector<LocalIndex>
      triangle_vertices{};         ///< Shape (num_triangles, 3); normals point outwards.
  std::vector<double> size_xyz{};  ///< Shape (num_samples, 3): where size_h holds.
  std::vector<double> size_h{};    ///< Shape (num_samples): wanted edge length there.
  FillOutput start{};              ///< Tets to be made better; empty: there are none yet.
};

/// @brief What NETGEN begins a fill with.
///
/// The children of the coarse tets fill the skin already and have the same points however the mesh
/// is cut, so the fill does not depend on the cut either, and there is nothing that could fail.
/// Measured on shaft (L = 2, 1 / 64 subdomains, seams improved): 157.6 / 156.2 k tets, mean of the
/// mean ratio 0.870 / 0.865, 6.6 / 6.4 s of CPU time to fill; from the skin alone 158.1 / 135.8 k,
/// 0.866 / 0.846, 26.1 / 17.5 s.
enum class FillStart : int { children, skin };
[[nodiscard]] constexpr FillStart last_value(FillStart /*type*/) { return FillStart::skin; }

/// @brief Settings of one try; a fallback_sequence() is made of these.
struct FillTry {
  KernelKind kernel = KernelKind::netgen;  ///< The others are settings of NETGEN.
  FillStart start = FillStart::children;
  double grading = 0.3;           ///< Growth of the size away from the skin, in (0, 1].
  int optimize_steps = 1;         ///< Optimisation rounds, >= 0.
  unsigned point_order_seed = 0;  ///< 0: points as given; else another fixed order.

  static auto fields(auto& self)
  {
    return std::tie(self.kernel, self.start, self.grading, self.optimize_steps,
                    self.point_order_seed);
  }
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

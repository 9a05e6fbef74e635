// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <vector>

namespace tessera::layers {

/// @brief Layers on some patches; table `[[layer]]` of a case file. Lengths in output length units.
struct LayerOptions {
  std::string patch{};     ///< Name of the patches, or a pattern as of the shell.
  std::string side{};      ///< Name or number of the solids that have the layers, or a pattern;
                           ///< empty: all that have no other one on the other side.
  double first = 0.0;      ///< Height of the layer at the wall, > 0.
  double growth = 1.2;     ///< Height of a layer by that of the one before it, in [1, 3].
  int count = 0;           ///< Number of layers, >= 1; 0: as many as `thickness` takes.
  double thickness = 0.0;  ///< Of all layers, > 0; 0: as `count` layers have.
                           ///< Both 0: count_up_to() the size inside.

  static auto fields(auto& self)
  {
    return std::tie(self.patch, self.side, self.first, self.growth, self.count, self.thickness);
  }

  friend bool operator==(const LayerOptions&, const LayerOptions&) = default;
};

/// @brief The most layers there may be.
inline constexpr int kMostLayers = 100;

/// @brief What is wrong with an entry, or empty. Local.
[[nodiscard]] std::string defect_of(const LayerOptions& options);

/// @brief Whether it has count or thickness. Local.
[[nodiscard]] bool is_complete(const LayerOptions& options);

/// @brief The number of layers that lead up to tets of edge length `size`: these are about as high
/// as one more layer would be. 0 if layers do not grow, and so never get there; above kMostLayers
/// if it takes too many. Local.
[[nodiscard]] int count_up_to(const LayerOptions& options, double size);

/// @brief Height of tets of edge length `size`. Local.
[[nodiscard]] double height_of_tets(double size);

/// @brief Number of layers: `count`, or what comes nearest to `thickness`, at least one and
/// at most one more than kMostLayers. Local. @pre is_complete(), here and below.
[[nodiscard]] int num_layers(const LayerOptions& options);

/// @brief Thickness of all num_layers() together, output length unit. Local.
[[nodiscard]] double thickness(const LayerOptions& options);

/// @brief Height of the layer beside the tets, output length unit. Local.
[[nodiscard]] double last_height(const LayerOptions& options);

/// @brief Where the layers of an entry end, as parts of its thickness from the tets to the wall:
/// mesh::WallLayers::ends. Local.
[[nodiscard]] std::vector<double> layer_ends(const LayerOptions& options);

}  // namespace tessera::layers

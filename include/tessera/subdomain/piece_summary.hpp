// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/base/types.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/quality/statistics.hpp"
#include "tessera/quality/worst_tets.hpp"
#include "tessera/verify/seams.hpp"

namespace tessera::subdomain {

/// @brief The boundary triangles that a piece has of one patch.
struct PatchArea {
  LocalIndex patch = 0;
  GlobalIndex num_triangles = 0;
  double area = 0.0;  ///< Output length unit squared; of second order, of four triangles a face.

  static auto fields(auto& self) { return std::tie(self.patch, self.num_triangles, self.area); }
};

/// @brief The edges that a piece has on one line inside of solids.
struct LineLength {
  LocalIndex line = 0;
  GlobalIndex num_edges = 0;
  double length = 0.0;  ///< Output length unit; of second order, of two parts an edge.

  static auto fields(auto& self) { return std::tie(self.line, self.num_edges, self.length); }
};

/// @brief What the layers of a piece add to it; the other figures are without them, but for areas
/// of patches.
struct LayerSummary {
  GlobalIndex num_tets = 0;
  GlobalIndex num_cells = 0;           ///< Prisms; pyramids and tets where a column is missing.
  GlobalIndex num_side_triangles = 0;  ///< On patches without layers.
  double volume = 0.0;                 ///< Output length unit cubed.

  static auto fields(auto& self)
  {
    return std::tie(self.num_tets, self.num_cells, self.num_side_triangles, self.volume);
  }
};

/// @brief The scalars that a run keeps of every finished piece: O(subdomains) on every rank.
struct PieceSummary {
  LocalIndex subdomain = kNoIndex;
  LocalIndex material = 0;
  fill::KernelKind kernel = fill::KernelKind::netgen;  ///< What made the piece.
  LocalIndex tries = 0;                                ///< Tries that were needed, from 1.
  LocalIndex num_held_back = 0;  ///< Skin points that the plan left off the geometry.
  GlobalIndex num_tets = 0;
  GlobalIndex num_interior_vertices = 0;  ///< Of no other piece.
  GlobalIndex num_owned_vertices = 0;     ///< Interior ones and those that no lower piece shares;
                                          ///< 0 unless seams were improved.
  GlobalIndex num_boundary = 0;           ///< Triangles on the geometry that this piece owns.
  GlobalIndex euler_characteristic = 0;   ///< V - E + F - T of the piece; 1 for a ball.
  double volume = 0.0;                    ///< Output length unit cubed.
  double boundary_area = 0.0;        ///< Outside of the model only; output length unit squared.
  std::vector<PatchArea> patches{};  ///< Of num_boundary; ascending, none without triangles.
  std::vector<LineLength> lines{};   ///< Ascending, none without edges.
  LayerSummary layers{};
  double model_distance = 0.0;      ///< Largest, of the points not held back; output length unit.
  double held_back_distance = 0.0;  ///< Largest, of the held-back points; output length unit.
  double cpu_s = 0.0;               ///< Of the try that succeeded.
  bool was_limited = false;         ///< A try ended for time or memory: not reproducible.
  bool is_folded = false;  ///< A coarse tet has children that are not positive: there is no piece.
  double min_scaled_jacobian = 1.0;  ///< Bound below that of every tet; 1 if all are straight.
  quality::TetStatistics tets{};
  quality::TetStatistics
      seam_tets{};    ///< Tets with a vertex between two subdomains of one material.
  Hash128 outside{};  ///< verify::outside_hash() of its skin.
  Hash128 surface{};  ///< verify::surface_hash() of the improved piece.
  Hash128 content{};  ///< Of the piece as filled, where it waits in the store.
  Hash128 digest{};   ///< Sum of hash_tet(); known when the piece is written.

  static auto fields(auto& self)
  {
    return std::tie(self.subdomain, self.material, self.kernel, self.tries, self.num_held_back,
                    self.num_tets, self.num_interior_vertices, self.num_owned_vertices,
                    self.num_boundary, self.euler_characteristic, self.volume, self.boundary_area,
                    self.patches, self.lines, self.layers, self.model_distance,
                    self.held_back_distance, self.cpu_s, self.was_limited, self.is_folded,
                    self.min_scaled_jacobian, self.tets, self.seam_tets, self.outside, self.surface,
                    self.content, self.digest);
  }

  // With its layers.
  [[nodiscard]] GlobalIndex num_all_tets() const { return num_tets + layers.num_tets; }
  // Prisms count, and not their tets.
  [[nodiscard]] GlobalIndex num_cells() const { return num_tets + layers.num_cells; }
  [[nodiscard]] GlobalIndex num_all_boundary() const
  {
    return num_boundary + layers.num_side_triangles;
  }
  [[nodiscard]] double whole_volume() const { return volume + layers.volume; }
};

/// @brief What is kept of one piece besides its tets.
struct FillResult {
  PieceSummary summary{};
  std::vector<std::string> failures{};  ///< What the tries before said, in their order.
  quality::QualityHistograms histograms{};
  quality::WorstTets worst{};
  std::vector<verify::SeamHash> seams{};

  static auto fields(auto& self)
  {
    return std::tie(self.summary, self.failures, self.histograms, self.worst, self.seams);
  }
};

/// @brief What the tries said that did not fill a subdomain.
struct FailedTries {
  LocalIndex subdomain = kNoIndex;
  std::vector<std::string> messages{};  ///< One a try, in their order.

  static auto fields(auto& self) { return std::tie(self.subdomain, self.messages); }
};

}  // namespace tessera::subdomain

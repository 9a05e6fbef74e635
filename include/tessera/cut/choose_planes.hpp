// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/cut/options.hpp"
#include "tessera/model/description.hpp"

namespace tessera::cut {

/// @brief One plane of a tree, and how it meets the part that it cuts.
struct PlaneJudgement {
  LocalIndex node = kNoIndex;   ///< Row of CutTree::nodes.
  LocalIndex solid = kNoIndex;  ///< Row of CutTree::solid_root.
  bool is_given = false;        ///< By the user.
  double fraction_below = 0.0;  ///< Of the part's volume.
  double area = 0.0;            ///< Of the cut, file length unit squared.
  /// Smallest distance from a feature, in its size: the coarse size, or less for smaller features.
  /// Features are corners, and points where the plane would touch a curve or a face.
  double clearance = 0.0;
  double shortest_edge = 0.0;  ///< Of the cut's border, between curves of the model; coarse sizes.
  double angle_deg = 0.0;      ///< Smallest angle at which the plane crosses a face or a curve.

  static auto fields(auto& self)
  {
    return std::tie(self.node, self.solid, self.is_given, self.fraction_below, self.area,
                    self.clearance, self.shortest_edge, self.angle_deg);
  }
};

/// @brief One part of a tree.
struct CutPart {
  LocalIndex solid = kNoIndex;  ///< Row of CutTree::solid_root.
  double volume = 0.0;          ///< File length unit cubed.
  LocalIndex num_wanted = 1;    ///< How many parts it should have become.
  std::string whole_because{};  ///< Why it is one part; empty if one was wanted.

  static auto fields(auto& self)
  {
    return std::tie(self.solid, self.volume, self.num_wanted, self.whole_because);
  }
};

/// @brief What became of the wish for parts.
struct CutReport {
  LocalIndex num_wanted = 0;
  double balance = 1.0;                  ///< Largest part's volume over the mean one's, >= 1.
  std::vector<CutPart> parts{};          ///< Shape (num_parts).
  std::vector<PlaneJudgement> planes{};  ///< Of the nodes that are no leaves, by row.

  static auto fields(auto& self)
  {
    return std::tie(self.num_wanted, self.balance, self.parts, self.planes);
  }
};

/// @brief Planes, and what they make of the model.
struct CutChoice {
  CutTree tree{};
  CutReport report{};

  static auto fields(auto& self) { return std::tie(self.tree, self.report); }
};

/// @brief Chooses planes that divide the solids of a model into parts.
///
/// Solids get parts by volume, each at least one. A part that should become k is cut where k/2 of
/// it are below the plane, and so on. All is judged on the triangles of the model, before anything
/// is cut; the result does not depend on their order. Rule `clear` leaves a part whole if no plane
/// cuts it well, so there may be fewer parts than wanted. Local.
///
/// @throws ConfigError if parts < 1, coarse_size is not positive, or a given normal has no length.
/// @throws InputError if the model is damaged, or a given plane meets no solid (names the plane and
/// the model's extent along its normal).
[[nodiscard]] CutChoice choose_planes(const model::ModelDescription& model,
                                      const CutOptions& options);

}  // namespace tessera::cut

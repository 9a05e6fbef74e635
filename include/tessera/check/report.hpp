// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/base/types.hpp"

namespace tessera::check {

/// @brief One kind of defect: how often it occurs and its first places.
struct Defect {
  std::string kind{};                    ///< E.g. "non_positive_volume"; stable, for scripts.
  GlobalIndex count = 0;                 ///< All occurrences, also those without a line below.
  std::vector<std::string> offenders{};  ///< The first 10 by piece and cell: where, ids, positions.
};

/// @brief Shape of a set of tets. Angles in degrees; mean ratio eta = 12 (3V)^(2/3) / sum l^2, 1
/// for the regular tet, 0 for a flat or inverted one. All values are 0 for an empty set.
struct QualityFigures {
  GlobalIndex num_tets = 0;
  double min_dihedral_deg = 0.0;
  double max_dihedral_deg = 0.0;
  double mean_ratio_min = 0.0;
  double mean_ratio_p01 = 0.0;  ///< Middle of its bin of 1/2000.
  double mean_ratio_mean = 0.0;
  std::array<GlobalIndex, 20> mean_ratio_histogram{};  ///< Equal bins over [0, 1].
};

/// @brief Percentiles of the edge length, in the mesh's unit; an edge counts once in each
/// subdomain that has it. Middles of bins 1/128 octave wide, so within 0.4 %.
struct EdgeLengthFigures {
  double p01 = 0.0;
  double median = 0.0;
  double p99 = 0.0;
};

/// @brief What one subdomain adds to the sums.
struct SubdomainFigures {
  std::int32_t id = 0;
  std::int32_t material = 0;  ///< "attribute" of its first tet, or 0.
  GlobalIndex num_tets = 0;
  double volume = 0.0;  ///< Of its finite tets, signed.
  Hash128 digest{};

  static auto fields(auto& self)
  {
    return std::tie(self.id, self.material, self.num_tets, self.volume, self.digest);
  }
};

/// @brief What check_mesh found. The same bits on every rank and for every number of ranks.
struct CheckReport {
  bool conforms = false;             ///< No defect.
  std::vector<Defect> defects{};     ///< Only kinds that occur.
  std::vector<std::string> notes{};  ///< Remarks that are no defects, e.g. that ids are absent.

  bool is_partial = false;      ///< Checked as a mesh of which only some pieces were made.
  bool has_global_ids = false;  ///< Every point and every cell of every piece has an id.
  bool matched_by_ids = false;  ///< Points of different pieces were matched by id, not by position.
  bool has_digest = false;      ///< Every piece has point ids.
  Hash128 digest{};  ///< Sum of hash_tet over the tets; the material is "attribute", or 0.

  GlobalIndex num_tets = 0;
  GlobalIndex num_vertices = 0;  ///< Different points that a tet uses, nodes of edges included.
  GlobalIndex num_edges = 0;
  GlobalIndex num_triangles = 0;
  GlobalIndex num_boundary_triangles = 0;   ///< On one tet; without open seams if is_partial.
  GlobalIndex num_interface_triangles = 0;  ///< On two tets of different "attribute".
  GlobalIndex num_seam_triangles = 0;       ///< Between two subdomains of the same "attribute".
  GlobalIndex num_open_seam_triangles = 0;  ///< On one tet, but not in the boundary file.
  GlobalIndex num_nonmanifold_edges = 0;    ///< Boundary edges with 4, 6, … boundary triangles.
  GlobalIndex euler_characteristic = 0;     ///< V - E + F - T; of second order, V are the corners.
  GlobalIndex num_components = 0;           ///< Sets of tets joined through triangles.
  GlobalIndex num_boundary_components = 0;  ///< Sets of triangles on one tet joined through edges.

  int order = 1;                     ///< Of the tets; 2: they have nodes on their edges.
  double scaled_jacobian_min = 1.0;  ///< Bound below smallest over largest Jacobian of each tet.
  double volume = 0.0;
  double boundary_area = 0.0;  ///< Of the triangles between corners.
  EdgeLengthFigures edge_length{};
  QualityFigures quality{};
  QualityFigures seam_quality{};  ///< Of tets with a vertex on a seam, open or not.
  double seam_ks_distance = 0.0;  ///< Kolmogorov-Smirnov, mean ratios of these and the other tets.
  std::vector<SubdomainFigures> subdomains{};  ///< Ascending ids.
};

/// @brief The report as JSON text, with the keys of report.json where they apply. Local.
[[nodiscard]] std::string to_json(const CheckReport& report);

}  // namespace tessera::check

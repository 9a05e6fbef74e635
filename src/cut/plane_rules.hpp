// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tessera/cut/options.hpp"

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// What a rule says about one part.
struct Proposal {
  std::optional<Plane> plane{};
  LocalIndex num_below = 1;     ///< Parts that what is below the plane should become.
  std::string whole_because{};  ///< Where there is no plane.
};

/// A plane that cuts what is on the other side of a cap, or of a face between two solids.
struct ForeignPlane {
  LocalIndex node = kNoIndex;  ///< FeatureEdge::foreign of its lines.
  Plane plane{};
};

/// What a rule is asked about.
struct Question {
  const PartSurface& part;                   ///< With the lines of foreign planes.
  LocalIndex num_parts = 2;                  ///< That the part should become, >= 2.
  const std::vector<ForeignPlane>& foreign;  ///< Those that draw lines.
};

/// A way to choose the plane that cuts a part.
class Rule {
 public:
  Rule() = default;
  Rule(const Rule&) = delete;
  Rule& operator=(const Rule&) = delete;
  virtual ~Rule() = default;

  [[nodiscard]] virtual Proposal propose(const Question& question) = 0;
};

[[nodiscard]] std::unique_ptr<Rule> make_rule(const CutOptions& options);

/// @brief The rule `clear`.
[[nodiscard]] std::unique_ptr<Rule> make_clear_rule(double coarse_size);

}  // namespace tessera::cut

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tessera/cut/options.hpp"

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// What a rule says about one part.
struct Proposal {
  std::optional<Plane> plane{};
  LocalIndex num_below = 1;     ///< Parts that what is below the plane should become.
  std::string whole_because{};  ///< Where there is no plane.
};

/// A way to choose the plane that cuts a part.
class Rule {
 public:
  Rule() = default;
  Rule(const Rule&) = delete;
  Rule& operator=(const Rule&) = delete;
  virtual ~Rule() = default;

  /// @param num_parts That the part should become, >= 2.
  [[nodiscard]] virtual Proposal propose(const PartSurface& part, LocalIndex num_parts) = 0;
};

[[nodiscard]] std::unique_ptr<Rule> make_rule(const CutOptions& options);

/// @brief The rule `clear`.
[[nodiscard]] std::unique_ptr<Rule> make_clear_rule(double coarse_size);

}  // namespace tessera::cut

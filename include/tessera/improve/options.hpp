// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

namespace tessera::improve {

/// @brief Options of the improvement; table `[improve]` of a case file.
struct ImproveOptions {
  bool seams = true;  ///< Optimise the tets around the seams between subdomains.
  int rounds = 1;     ///< Rounds of optimisation there, >= 1.

  static auto fields(auto& self) { return std::tie(self.seams, self.rounds); }

  friend bool operator==(const ImproveOptions&, const ImproveOptions&) = default;
};

}  // namespace tessera::improve

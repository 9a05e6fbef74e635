// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <vector>

namespace tessera::topology {

/// @brief Patches along which the mesh is opened; table `[[split]]` of a case file.
struct SplitPatch {
  std::string patch{};  ///< Name of the patches, or a pattern as of the shell.

  static auto fields(auto& self) { return std::tie(self.patch); }
  friend bool operator==(const SplitPatch&, const SplitPatch&) = default;
};

/// @brief Solids that are kept apart where they touch; table `[[geometry.contact]]` of a case file.
/// Both are a number of `tessera info`, or a name of the solid, or a pattern of these, see
/// matches_pattern().
struct Contact {
  std::string body{};
  std::string other{};

  static auto fields(auto& self) { return std::tie(self.body, self.other); }
  friend bool operator==(const Contact&, const Contact&) = default;
};

/// @brief All along which the mesh is opened.
struct SplitOptions {
  std::vector<SplitPatch> patches{};
  std::vector<Contact> contacts{};

  static auto fields(auto& self) { return std::tie(self.patches, self.contacts); }
  friend bool operator==(const SplitOptions&, const SplitOptions&) = default;

  [[nodiscard]] bool are_none() const { return patches.empty() && contacts.empty(); }
};

}  // namespace tessera::topology

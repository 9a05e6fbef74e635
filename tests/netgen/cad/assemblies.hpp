// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

namespace tessera::testing {

struct Body {
  std::string name{};
  TopoDS_Shape solid{};
  double volume = 0.0;
};

/// @brief Area that two bodies have in common, or volume if they overlap.
struct Meeting {
  std::array<int, 2> bodies{};  ///< From 1.
  double measure = 0.0;
};

/// @brief Solids that touch or overlap, with what is known of them in closed form.
struct AssemblyModel {
  std::string name{};
  std::vector<Body> bodies{};
  std::vector<Meeting> touches{};   ///< By faces.
  std::vector<Meeting> overlaps{};  ///< Without them, touches are all that there is.
};

/// @brief Boxes and round bodies in sixteen ways; in the last five they overlap.
[[nodiscard]] std::vector<AssemblyModel> assemblies();

/// @brief The one of that name.
[[nodiscard]] AssemblyModel assembly(const std::string& name);

/// @brief Two boxes of size 1 above each other, set off sideways, with a gap between them.
[[nodiscard]] AssemblyModel boxes_with_gap(double gap);

/// @brief All bodies, without names.
[[nodiscard]] TopoDS_Shape compound_of(const AssemblyModel& model);

/// @brief Writes an assembly as STEP, with the names of the bodies and a colour for each.
void write_step(const AssemblyModel& model, const std::filesystem::path& file);

}  // namespace tessera::testing

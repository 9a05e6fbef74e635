// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/vec3.hpp"

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

/// @brief Patches between two solids that are opened for layers on the side of one of them, until
/// close_joints(). Both are names or patterns, as above.
struct JointSide {
  std::string patch{};
  std::string solid{};

  static auto fields(auto& self) { return std::tie(self.patch, self.solid); }
  friend bool operator==(const JointSide&, const JointSide&) = default;
};

/// @brief All along which the mesh is opened.
struct SplitOptions {
  std::vector<SplitPatch> patches{};
  std::vector<Contact> contacts{};
  std::vector<JointSide> joints{};  ///< Where nothing else opens it.

  static auto fields(auto& self) { return std::tie(self.patches, self.contacts, self.joints); }
  friend bool operator==(const SplitOptions&, const SplitOptions&) = default;

  [[nodiscard]] bool are_none() const
  {
    return patches.empty() && contacts.empty() && joints.empty();
  }
};

/// @brief Patches that are the image of others, so that the mesh can be put side by side with
/// itself; table `[[periodic]]` of a case file. Lengths are output length units.
struct PeriodicSide {
  static constexpr double kNoAngle = 360.0;  ///< Not given.

  std::string from{};           ///< Name of the patches, or a pattern as of the shell.
  std::string to{};             ///< Of their images.
  Vec3 translation = kNoPoint;  ///< kNoPoint: not given.
  Vec3 axis_point = kNoPoint;   ///< Of a rotation: a point of its axis; kNoPoint: not given.
  Vec3 axis = kNoPoint;         ///< Its direction, of any length.
  double angle_deg = kNoAngle;  ///< By the right-hand rule.

  static auto fields(auto& self)
  {
    return std::tie(self.from, self.to, self.translation, self.axis_point, self.axis,
                    self.angle_deg);
  }
  friend bool operator==(const PeriodicSide&, const PeriodicSide&) = default;

  [[nodiscard]] bool has_translation() const { return translation != kNoPoint; }
  [[nodiscard]] bool has_rotation() const { return axis_point != kNoPoint || axis != kNoPoint; }
};

/// @brief What an entry must not be, as a sentence's end; empty: it is sound. Local.
[[nodiscard]] std::string defect_of(const PeriodicSide& side);

/// @brief What leads from one side to the other. Local.
/// @param[in] shift From the centroid of the one to that of the other: the translation if the entry
/// gives neither that nor a rotation.
/// @pre defect_of() finds nothing.
[[nodiscard]] Affine transform_of(const PeriodicSide& side, const Vec3& shift);

}  // namespace tessera::topology

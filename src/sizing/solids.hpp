// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/sizing/options.hpp"

namespace tessera::sizing {

/// @brief Nearest point of a solid: the point itself if it is inside.
[[nodiscard]] Vec3 nearest_point(const Box& box, const Vec3& point) noexcept;
[[nodiscard]] Vec3 nearest_point(const Ball& ball, const Vec3& point) noexcept;
[[nodiscard]] Vec3 nearest_point(const Cylinder& cylinder, const Vec3& point) noexcept;
[[nodiscard]] Vec3 nearest_point(const HalfSpace& half_space, const Vec3& point) noexcept;

/// @brief Whether a solid is near enough to a tet of the mesh. Curved geometry bulges out of coarse
/// tets, so a fifth of a tet's longest edge is near enough.
template <class Solid>
[[nodiscard]] bool meets(const Solid& solid, const mesh::CoarseMesh& coarse);

extern template bool meets(const Box&, const mesh::CoarseMesh&);
extern template bool meets(const Ball&, const mesh::CoarseMesh&);
extern template bool meets(const Cylinder&, const mesh::CoarseMesh&);
extern template bool meets(const HalfSpace&, const mesh::CoarseMesh&);

}  // namespace tessera::sizing

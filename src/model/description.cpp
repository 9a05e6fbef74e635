// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/description.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::model {
namespace {

template <class Numbers>
bool are_below(const Numbers& numbers, std::size_t size)
{
  return std::ranges::all_of(
      numbers, [&](LocalIndex i) { return i >= 0 && static_cast<std::size_t>(i) < size; });
}

bool are_finite(const std::vector<double>& values)
{
  return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

bool is_finite(const Vec3& point)
{
  return std::ranges::all_of(point, [](double x) { return std::isfinite(x); });
}

bool is_sound(const ModelDescription& model)
{
  const bool fits = model.triangle_vertices.size() == 3 * model.triangle_face.size()
                    && model.vertex_xyz.size() % 3 == 0;
  if (!fits || !are_below(model.triangle_vertices, model.vertex_xyz.size() / 3)
      || !are_below(model.triangle_face, model.faces.size()) || !are_finite(model.vertex_xyz)) {
    return false;
  }
  const auto bounds_solids = [&](const FaceDescription& face) {
    return std::ranges::all_of(face.solids, [&](LocalIndex solid) {
      return solid >= 1 && static_cast<std::size_t>(solid) <= model.solids.size();
    });
  };
  const auto is_whole = [&](const EdgeDescription& edge) {
    return std::isfinite(edge.length) && is_finite(edge.low) && is_finite(edge.high)
           && are_below(edge.faces, model.faces.size()) && edge.line_xyz.size() % 6 == 0
           && are_finite(edge.line_xyz);
  };
  return !model.triangle_face.empty() && std::ranges::all_of(model.edges, is_whole)
         && std::ranges::all_of(model.faces, bounds_solids);
}

}  // namespace

std::string FaceDescription::patch_name() const
{
  if (!name.empty()) return name;
  return mesh::default_patch_name(patch == kNoIndex ? number - 1 : patch);
}

void EdgeDescription::add_line(const Vec3& a, const Vec3& b)
{
  if (length == 0.0) low = high = a;
  for (const Vec3& point : {a, b}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  length += norm(b - a);
  draw_line(a, b);
}

void EdgeDescription::draw_line(const Vec3& a, const Vec3& b)
{
  for (const Vec3& point : {a, b}) line_xyz.insert(line_xyz.end(), point.begin(), point.end());
}

void ModelDescription::require_sound() const
{
  if (!is_sound(*this)) throw InputError("the description of the model is damaged");
}

}  // namespace tessera::model

// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/region_sizes.hpp"

#include <array>
#include <set>
#include <string>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/name_patterns.hpp"

#include "sizing/box_text.hpp"
#include "sizing/solids.hpp"

namespace tessera::sizing {
namespace {

// Corners of those rows of an index array whose label matches, and the box around them.
template <std::size_t N>
struct Selected {
  std::vector<std::array<Vec3, N>> parts{};
  tessera::Box box{};

  void add(const mesh::CoarseMesh& coarse, std::span<const LocalIndex> vertices)
  {
    std::array<Vec3, N>& part = parts.emplace_back();
    for (std::size_t i = 0; i < N; ++i) part[i] = coarse.position(vertices[i]);
    box.include(box_of(part));
  }
};

// By number or name.
std::set<LocalIndex> matching_curves(const std::string& pattern,
                                     const std::vector<mesh::NamedCurve>& curves)
{
  std::set<LocalIndex> matches;
  std::vector<std::string> known;
  for (const mesh::NamedCurve& curve : curves) {
    const bool is_meant = matches_pattern(pattern, curve.number)
                          || (!curve.name.empty() && matches_pattern(pattern, curve.name));
    if (is_meant) matches.insert(curve.curve);
    known.push_back(curve.name.empty() ? curve.number : curve.name);
  }
  if (!matches.empty()) return matches;
  if (known.empty()) {
    throw ConfigError(
        fmt::format("curve = \"{}\": the model has no curves; choose another shape", pattern));
  }
  throw ConfigError(
      fmt::format("curve = \"{}\": the model has no such curve; it has {}; `tessera info MODEL` "
                  "lists them",
                  pattern, nearest_first(pattern, known)));
}

template <class Solid>
double distance_to(const Solid& solid, const Vec3& point)
{
  return norm(point - nearest_point(solid, point));
}

}  // namespace

template <class Solid>
RegionSizes::Where RegionSizes::find(const Solid& solid, const mesh::CoarseMesh& coarse)
{
  if (meets(solid, coarse)) return solid;
  throw ConfigError(
      fmt::format("it meets nothing of the model, whose box is {}; move the region or leave it out "
                  "(lengths are output units, so geometry.scale counts)",
                  box_text(bounding_box(coarse.vertex_xyz))));
}

RegionSizes::Where RegionSizes::find(const PatchPattern& patch, const mesh::CoarseMesh& coarse)
{
  const std::vector<bool> matches = matching_names("patch", patch.pattern, coarse.patch_names);
  Selected<3> selected;
  for (LocalIndex f = 0; f < coarse.num_faces(); ++f) {
    const LocalIndex patch_of_face = coarse.face_patch[at(f)];
    if (!matches[at(patch_of_face)] || coarse.is_wake(patch_of_face)) continue;
    selected.add(coarse, std::span(coarse.face_vertices).subspan(3 * at(f), 3));
  }
  if (selected.parts.empty()) {
    throw ConfigError(fmt::format(
        "patch = \"{}\": the coarse mesh has no triangle on it; leave it out", patch.pattern));
  }
  return Triangles{model::TriangleSearch(selected.parts), selected.box};
}

RegionSizes::Where RegionSizes::find(const MaterialPattern& material,
                                     const mesh::CoarseMesh& coarse)
{
  const std::vector<bool> matches =
      matching_names("material", material.pattern, coarse.material_names);
  Selected<4> selected;
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    if (matches[at(coarse.tet_material[at(t)] - 1)]) selected.add(coarse, coarse.tet(t));
  }
  if (selected.parts.empty()) {
    throw ConfigError(fmt::format(
        "material = \"{}\": the coarse mesh has no tet of it; leave it out", material.pattern));
  }
  return Tets{model::TetSearch(selected.parts), selected.box};
}

RegionSizes::Where RegionSizes::find(const CurvePattern& curve, const mesh::CoarseMesh& coarse)
{
  const std::set<LocalIndex> matches = matching_curves(curve.pattern, coarse.curves);
  Selected<2> selected;
  for (LocalIndex s = 0; s < coarse.num_segments(); ++s) {
    if (!matches.contains(coarse.segment_curve[at(s)])) continue;
    selected.add(coarse, std::span(coarse.segment_vertices).subspan(2 * at(s), 2));
  }
  if (selected.parts.empty()) {
    throw ConfigError(fmt::format(
        "curve = \"{}\": the coarse mesh has no segment on it; leave it out", curve.pattern));
  }
  return Segments{model::SegmentSearch(selected.parts), selected.box};
}

RegionSizes::RegionSizes(const SizeRegion& region, double grading, const mesh::CoarseMesh& coarse)
    : size_(region.size),
      growth_(region.growth > 0.0 ? region.growth : grading),
      where_(std::visit([&](const auto& shape) { return find(shape, coarse); }, region.shape))
{
}

void RegionSizes::lower(std::span<const double> xyz, std::span<double> sizes) const
{
  const auto size_at = [this](double distance) { return size_ + growth_ * distance; };
  const auto visit_where = [&]<class Place>(const Place& place) {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const Vec3 point = point_at(xyz, i);
      if constexpr (requires { place.search; }) {
        if (size_at(std::sqrt(place.box.squared_distance(point))) >= sizes[i])
          continue;  // Spares the search.
        const double squared = place.search.nearest(point).squared_distance;
        sizes[i] = std::min(sizes[i], size_at(std::sqrt(squared)));
      } else {
        sizes[i] = std::min(sizes[i], size_at(distance_to(place, point)));
      }
    }
  };
  std::visit(visit_where, where_);
}

}  // namespace tessera::sizing

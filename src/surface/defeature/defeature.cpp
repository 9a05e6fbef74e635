// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/defeature.hpp"

#include <map>
#include <set>
#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/reference.hpp"

#include "surface/defeature/defeaturer.hpp"
#include "surface/groups.hpp"
#include "surface/model_curve.hpp"

namespace tessera::surface {
namespace {

using Parts = std::map<LocalIndex, MergedPart>;

void add_part(LocalIndex number, double measure, const Vec3& centre, Parts& parts)
{
  MergedPart& part = parts[number];
  part.number = number;
  part.measure += measure;
  part.centre = part.centre + measure * centre;
}

Parts curves_of(const PatchSurface& surface)
{
  Parts parts;
  for (std::size_t e = 0; e < surface.edges.size(); ++e) {
    const Vec3& a = surface.vertex_xyz[at(surface.edges[e][0])];
    const Vec3& b = surface.vertex_xyz[at(surface.edges[e][1])];
    add_part(surface.edge_curve[e], norm(b - a), midpoint(a, b), parts);
  }
  return parts;
}

Parts patches_of(const PatchSurface& surface)
{
  Parts parts;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    add_part(surface.triangle_patch[t], triangle_area(a, b, c), middle_of({a, b, c}), parts);
  }
  return parts;
}

Parts curves_of(const mesh::CoarseMesh& mesh)
{
  Parts parts;
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const LocalIndex curve = mesh.segment_curve[at(s)];
    if (curve == kNoIndex) continue;
    const Vec3 a = mesh.position(mesh.segment_vertices[2 * at(s)]);
    const Vec3 b = mesh.position(mesh.segment_vertices[2 * at(s) + 1]);
    add_part(curve, norm(b - a), midpoint(a, b), parts);
  }
  return parts;
}

Parts patches_of(const mesh::CoarseMesh& mesh)
{
  Parts parts;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex patch = mesh.face_patch[at(f)];
    if (patch == kNoIndex) continue;
    const auto corners = corners_at<3>(mesh.vertex_xyz, mesh.face_vertices, f);
    add_part(mesh.patch_surface[at(patch)], triangle_area(corners), middle_of(corners), parts);
  }
  return parts;
}

// In the numbers of groups.
KeptParts kept_groups(const KeptParts& kept, const SurfaceGroups& groups)
{
  std::set<LocalIndex> patches;
  for (const LocalIndex group : groups.surface().triangle_patch) {
    if (kept.has_patch(groups.model_surface(group))) patches.insert(group);
  }
  std::set<LocalIndex> curves;
  for (const LocalIndex curve : groups.surface().edge_curve) {
    if (kept.has_curve(groups.model_curve(curve))) curves.insert(curve);
  }
  return {{patches.begin(), patches.end()}, {curves.begin(), curves.end()}};
}

// `after`: parts, or their numbers alone.
template <class After>
std::vector<MergedPart> missing(const Parts& before, const After& after)
{
  std::vector<MergedPart> gone;
  for (const auto& [number, part] : before) {
    if (after.contains(number)) continue;
    gone.push_back(part);
    if (part.measure > 0.0) gone.back().centre = (1.0 / part.measure) * part.centre;
  }
  return gone;
}

}  // namespace

Defeatured Defeatured::scaled(double factor) const
{
  Defeatured result = *this;
  result.tolerance *= factor;
  for (MergedPart& part : result.curves) {
    part.centre = factor * part.centre;
    part.measure *= factor;
  }
  for (MergedPart& part : result.patches) {
    part.centre = factor * part.centre;
    part.measure *= factor * factor;
  }
  for (Vec3& place : result.places) place = factor * place;
  return result;
}

std::vector<MergedPart> renumbered(const std::vector<MergedPart>& merged,
                                   const std::vector<LocalIndex>& new_number,
                                   const std::vector<LocalIndex>& left)
{
  Parts before;
  for (const MergedPart& part : merged)
    add_part(new_number[at(part.number)], part.measure, part.centre, before);
  std::set<LocalIndex> after{kNoIndex};
  for (const LocalIndex part : left) after.insert(new_number[at(part)]);
  return missing(before, after);
}

Defeatured defeature(PatchSurface& surface, const OnCurve& on_curve, const MergeLimits& limits)
{
  Defeatured done{.tolerance = limits.tolerance};
  Defeaturer defeaturer(surface, on_curve, limits);
  defeaturer.run();
  if (defeaturer.merges().empty()) return done;
  PatchSurface made = defeaturer.surface().take(surface);
  done.curves = missing(curves_of(surface), curves_of(made));
  done.patches = missing(patches_of(surface), patches_of(made));
  done.places = defeaturer.places();
  surface = std::move(made);
  return done;
}

Defeatured defeature(PatchSurface& surface, const SurfaceReference& reference,
                     const model::Model& model, const MergeLimits& limits)
{
  const OnCurve on_curve = [&](LocalIndex curve, LocalIndex /*near*/, const Vec3& point) {
    return on_model_curve(reference, model, curve, point);
  };
  return defeature(surface, on_curve, limits);
}

bool defeature(CoarseSurface& surface, const model::Model& model, const MergeLimits& limits)
{
  SurfaceGroups groups(surface, model);
  const OnCurve on_curve = [&](LocalIndex curve, LocalIndex near, const Vec3& point) {
    return groups.model_curve(curve) == kNoIndex ? kNoPoint : groups.on_curve(curve, near, point);
  };
  const MergeLimits of_groups{limits.tolerance, kept_groups(limits.kept, groups), {}};
  Defeaturer defeaturer(groups.surface(), on_curve, of_groups);
  defeaturer.run();
  if (defeaturer.merges().empty()) return false;
  const EditableSurface& edited = defeaturer.surface();
  for (const Merge& merge : defeaturer.merges()) {
    groups.merge(merge.gone, merge.kept, edited.xyz(merge.kept));
    if (merge.curve_end != kNoIndex)
      groups.merge(merge.curve_end, merge.kept, edited.xyz(merge.kept));
  }
  CoarseSurface made = groups.take(edited);
  made.defeatured = {.tolerance = limits.tolerance,
                     .curves = missing(curves_of(surface.mesh), curves_of(made.mesh)),
                     .patches = missing(patches_of(surface.mesh), patches_of(made.mesh)),
                     .places = defeaturer.places()};
  surface = std::move(made);
  return true;
}

}  // namespace tessera::surface

// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/stl_model.hpp"

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/model/stl_file.hpp"
#include "tessera/surface/on_geometry.hpp"

#include "geometry/named_surface.hpp"
#include "geometry/stl_triangles.hpp"

namespace tessera::geometry {

// ModelSource::content of an STL file.
struct StlContent {
  double feature_angle_deg = 0.0;
  Bytes surface{};  // Of a model::TriangleSurface.

  static auto fields(auto& self) { return std::tie(self.feature_angle_deg, self.surface); }
};

namespace {

constexpr double kTolerance = 1e-8;  // of the box diagonal, as Model promises

std::vector<model::TriangleSearch> searches_of_patches(const model::TriangleSurface& surface,
                                                       const model::SurfaceFeatures& features)
{
  std::vector<std::vector<std::array<Vec3, 3>>> patch_triangles(features.patch_names.size());
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const auto patch = features.triangle_patch[static_cast<std::size_t>(t)];
    patch_triangles[static_cast<std::size_t>(patch)].push_back(surface.corners(t));
  }
  return {patch_triangles.begin(), patch_triangles.end()};
}

std::vector<model::SegmentSearch> searches_of_curves(const model::TriangleSurface& surface,
                                                     const model::SurfaceFeatures& features)
{
  std::vector<model::SegmentSearch> searches;
  for (LocalIndex c = 0; c < features.num_curves(); ++c) {
    const auto vertices = features.curve_vertices[c];
    std::vector<std::array<Vec3, 2>> segments;
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      segments.push_back({surface.position(vertices[i - 1]), surface.position(vertices[i])});
    }
    searches.emplace_back(segments);
  }
  return searches;
}

surface::PatchSurface patches_of(const model::TriangleSurface& surface,
                                 const model::SurfaceFeatures& features)
{
  surface::PatchSurface patches = triangles_of(surface);
  patches.vertex_is_fixed.assign(patches.vertex_xyz.size(), 0);
  patches.patch_materials.resize(at(features.num_patches()));
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const LocalIndex patch = features.triangle_patch[at(t)];
    patches.triangle_patch.push_back(patch);
    patches.patch_materials[at(patch)] = {surface.triangle_material[at(t)], 0};
  }
  for (std::size_t e = 0; e < features.edge_curve.size(); ++e) {
    patches.edges.push_back({features.edge_vertices[2 * e], features.edge_vertices[2 * e + 1]});
  }
  patches.edge_curve = features.edge_curve;
  return patches;
}

}  // namespace

StlModel::StlModel(const StlContent& content, std::string name)
    : surface_(from_bytes<model::TriangleSurface>(content.surface)),
      features_(model::find_features(surface_, content.feature_angle_deg)),
      patch_search_(searches_of_patches(surface_, features_)),
      curve_search_(searches_of_curves(surface_, features_)),
      box_diagonal_(model::box_diagonal(surface_)),
      name_(std::move(name))
{
}

StlModel::StlModel(const model::ModelSource& source)
    : StlModel(from_bytes<StlContent>(source.content), source.file_name)
{
}

double StlModel::surface_tolerance(LocalIndex /*surface*/) const
{
  return kTolerance * box_diagonal_;
}

double StlModel::curve_tolerance(LocalIndex /*curve*/) const { return kTolerance * box_diagonal_; }

model::SurfacePoint StlModel::project_to_surface(LocalIndex surface, const Vec3& point,
                                                 const model::SurfaceParameters& /*guess*/) const
{
  const auto& search = patch_search_.at(static_cast<std::size_t>(surface));
  return {found(search.nearest(point)), {}};
}

model::CurvePoint StlModel::project_to_curve(LocalIndex curve, const Vec3& point,
                                             double /*guess*/) const
{
  const auto& search = curve_search_.at(static_cast<std::size_t>(curve));
  return {found(search.nearest(point)), 0.0};
}

// Nothing is near a point that is not finite.
Vec3 StlModel::found(const model::NearestPoint& nearest) const
{
  if (nearest.simplex == kNoIndex) throw GeometryError(name_ + ": no nearest point found");
  return nearest.xyz;
}

coarse::ModelFigures StlModel::figures() const
{
  coarse::ModelFigures figures{.num_faces = features_.num_patches(),
                               .num_triangles = surface_.num_triangles()};
  for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
    const auto [a, b, c] = surface_.corners(t);
    figures.area += triangle_area(a, b, c);
    figures.volume += tet_volume(surface_.position(0), a, b, c);
  }
  return figures;
}

coarse::CadSurface StlModel::triangles_for_fit(double size) const
{
  coarse::CadSurface cad{.triangles = patches_of(surface_, features_),
                         .size = size,
                         .patch_names = features_.patch_names,
                         .solid_names = surface_.material_names};
  for (LocalIndex p = 0; p < features_.num_patches(); ++p) cad.patch_surface.push_back(p);
  for (LocalIndex c = 0; c < features_.num_curves(); ++c) cad.curve_number.push_back(c);
  return cad;
}

surface::CoarseSurface StlModel::mesh_whole(const surface::CoarseOptions& options) const
{
  const surface::SurfaceReference reference(patches_of(surface_, features_));
  const SurfaceNames names{
      [this](LocalIndex patch) { return features_.patch_names[at(patch)]; },
      [this](LocalIndex material) { return surface_.material_names[at(material - 1)]; }};
  surface::RemeshedSurface remeshed = surface::remesh_on_geometry(reference, *this, options);
  const surface::PatchSurface& surface = remeshed.surface;
  require_no_overlaps(surface::find_overlaps(surface), surface, names, name_);
  surface::CoarseSurface coarse = to_coarse_surface(surface, options.max_size, names);
  coarse.defeatured = std::move(remeshed.defeatured);
  return coarse;
}

void StlModel::add_faces_of_edges(model::ModelDescription& to) const
{
  for (std::size_t side = 0; side < surface_.triangle_vertices.size(); ++side) {
    const std::size_t next = side % 3 == 2 ? side - 2 : side + 1;
    const LocalIndex curve =
        features_.curve_of_edge(surface_.triangle_vertices[side], surface_.triangle_vertices[next]);
    if (curve == kNoIndex) continue;
    to.edges[at(curve)].faces.push_back(features_.triangle_patch[side / 3]);
  }
  for (model::EdgeDescription& edge : to.edges) sort_unique(edge.faces);
}

model::ModelDescription StlModel::describe(surface::SurfaceMesher /*mesher*/) const
{
  model::ModelDescription described{.vertex_xyz = surface_.vertex_xyz,
                                    .triangle_vertices = surface_.triangle_vertices,
                                    .triangle_face = features_.triangle_patch};
  for (LocalIndex c = 0; c < features_.num_curves(); ++c) {
    model::EdgeDescription& edge = described.edges.emplace_back();
    edge.number = named_curve(c).number;
    const auto vertices = features_.curve_vertices[c];
    for (std::size_t v = 1; v < vertices.size(); ++v) {
      edge.add_line(surface_.position(vertices[v - 1]), surface_.position(vertices[v]));
    }
  }
  for (const std::string& name : surface_.material_names)
    described.solids.push_back({.name = name});
  for (const std::string& name : features_.patch_names) {
    const auto number = static_cast<LocalIndex>(described.faces.size()) + 1;
    described.faces.push_back({.number = number, .name = name});
  }
  const Vec3 origin = surface_.position(0);
  for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
    const auto [a, b, c] = surface_.corners(t);
    const LocalIndex material = surface_.triangle_material[at(t)];
    model::FaceDescription& face = described.faces[at(features_.triangle_patch[at(t)])];
    face.area += triangle_area(a, b, c);
    face.solids = {material};
    described.solids[at(material - 1)].volume += tet_volume(origin, a, b, c);
  }
  add_faces_of_edges(described);
  return described;
}

model::ModelSource import_stl(const std::filesystem::path& file,
                              const model::ImportOptions& options, const ShellUniter& unite)
{
  const model::TriangleSoup soup = model::read_stl(file);
  auto [checked, wrap] = checked_or_wrapped(soup, options.stl, unite, file.string());
  note_repairs(checked.counted_repairs);
  return {.format = model::Format::stl,
          .file_name = file.string(),
          .length_unit = {},
          .content = to_bytes(StlContent{options.feature_angle_deg, to_bytes(checked.surface)}),
          .repairs = std::move(checked.repairs),
          .wrap = std::move(wrap)};
}

}  // namespace tessera::geometry

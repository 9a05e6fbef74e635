// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/own_mesh_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/coarse/own_mesh.hpp"
#include "tessera/coarse/smooth_surface.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/model/options.hpp"
#include "tessera/model/tet_mesh_file.hpp"

#include "geometry/gmsh_mesher.hpp"

namespace tessera::geometry {
namespace {

constexpr double kTolerance = 1e-8;  // of the box diagonal, as Model promises

// ModelSource::content of a mesh file.
struct OwnMeshContent {
  coarse::OwnMesh own{};
  std::optional<model::ModelSource> cad{};
  bool is_smooth = false;
  double feature_angle_deg = 0.0;

  static auto fields(auto& self)
  {
    return std::tie(self.own, self.cad, self.is_smooth, self.feature_angle_deg);
  }
};

// The model is the mesh's own surface.
class OwnSurfaceModel : public LoadedModel {
 public:
  explicit OwnSurfaceModel(mesh::CoarseMesh mesh)
      : mesh_(std::move(mesh)), box_diagonal_(tessera::box_diagonal(mesh_.vertex_xyz))
  {
  }

  [[nodiscard]] double surface_tolerance(LocalIndex) const override
  {
    return kTolerance * box_diagonal_;
  }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override
  {
    return kTolerance * box_diagonal_;
  }
  [[nodiscard]] double box_diagonal() const override { return box_diagonal_; }
  [[nodiscard]] model::ModelDescription describe(surface::SurfaceMesher mesher) const override;
  [[nodiscard]] coarse::CadSurface triangles_for_fit(double) const override
  {
    throw ConfigError("a mesh is no CAD model that another mesh could be fitted to");
  }

  [[nodiscard]] surface::CoarseSurface mesh_whole(const surface::CoarseOptions&) const override
  {
    return {.mesh = mesh_};
  }

 protected:
  [[nodiscard]] mesh::CoarseMesh& mesh() { return mesh_; }

 private:
  mesh::CoarseMesh mesh_;
  double box_diagonal_;
};

// Every new point lies on the surface already.
class FlatOwnModel final : public OwnSurfaceModel {
 public:
  using OwnSurfaceModel::OwnSurfaceModel;

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex, const Vec3& point, const model::SurfaceParameters&) const override
  {
    return {point, {}};
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex, const Vec3& point,
                                                   double) const override
  {
    return {point, 0.0};
  }
};

// New points follow from their parameters alone, which are midpoints of those beside them.
class SmoothOwnModel final : public OwnSurfaceModel {
 public:
  SmoothOwnModel(mesh::CoarseMesh flat, double feature_angle_deg)
      : OwnSurfaceModel(std::move(flat)), surface_(mesh(), feature_angle_deg)
  {
    surface_.add_parameters(mesh());
  }

  [[nodiscard]] bool has_parameters() const override { return true; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex, const Vec3&, const model::SurfaceParameters& guess) const override
  {
    return {surface_.on_face(guess), guess};
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex, const Vec3&,
                                                   double guess) const override
  {
    return {surface_.on_segment(guess), guess};
  }

 private:
  coarse::SmoothSurface surface_;
};

model::ModelDescription describe_mesh(const mesh::CoarseMesh& mesh)
{
  model::ModelDescription described{.vertex_xyz = mesh.vertex_xyz.to_vector(),
                                    .triangle_vertices = mesh.face_vertices.to_vector(),
                                    .triangle_face = mesh.face_patch.to_vector()};
  for (const std::string& name : mesh.material_names) described.solids.push_back({.name = name});
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    described.solids[at(mesh.tet_material[at(t)] - 1)].volume +=
        tet_volume(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t));
  }
  for (const std::string& name : mesh.patch_names) {
    const auto number = static_cast<LocalIndex>(described.faces.size()) + 1;
    described.faces.push_back({.number = number, .name = name});
  }
  std::map<std::array<LocalIndex, 3>, LocalIndex> patch_of;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    const auto corners = corners_at<3>(mesh.vertex_xyz, mesh.face_vertices, f);
    model::FaceDescription& face = described.faces[at(mesh.face_patch[at(f)])];
    face.area += triangle_area(corners[0], corners[1], corners[2]);
    patch_of[mesh::sorted_triangle(v[0], v[1], v[2])] = mesh.face_patch[at(f)];
  }
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
    const auto patch = patch_of.find(triangle.vertices);
    if (patch == patch_of.end()) continue;
    std::vector<LocalIndex>& solids = described.faces[at(patch->second)].solids;
    for (const LocalIndex tet : triangle.tets) {
      if (tet == kNoIndex) continue;
      const LocalIndex material = mesh.tet_material[at(tet)];
      const auto place = std::ranges::lower_bound(solids, material);
      if (place == solids.end() || *place != material) solids.insert(place, material);
    }
  }
  return described;
}

model::ModelDescription OwnSurfaceModel::describe(surface::SurfaceMesher /*mesher*/) const
{
  return describe_mesh(mesh_);
}

// A mesh and the CAD model that it is of. Projection is the CAD's.
class CadOwnModel final : public LoadedModel {
 public:
  CadOwnModel(coarse::OwnMesh own, std::unique_ptr<LoadedModel> cad, std::string name)
      : own_(std::move(own)), cad_(std::move(cad)), name_(std::move(name))
  {
  }

  [[nodiscard]] bool has_parameters() const override { return cad_->has_parameters(); }
  [[nodiscard]] double surface_tolerance(LocalIndex surface) const override
  {
    return cad_->surface_tolerance(surface);
  }
  [[nodiscard]] double curve_tolerance(LocalIndex curve) const override
  {
    return cad_->curve_tolerance(curve);
  }
  [[nodiscard]] double end_tolerance(LocalIndex curve, const Vec3& point) const override
  {
    return cad_->end_tolerance(curve, point);
  }
  [[nodiscard]] double box_diagonal() const override { return cad_->box_diagonal(); }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override
  {
    return cad_->project_to_surface(surface, point, guess);
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override
  {
    return cad_->project_to_curve(curve, point, guess);
  }
  [[nodiscard]] mesh::NamedCurve named_curve(LocalIndex curve) const override
  {
    return cad_->named_curve(curve);
  }
  [[nodiscard]] model::ModelDescription describe(surface::SurfaceMesher mesher) const override;
  [[nodiscard]] coarse::CadSurface triangles_for_fit(double size) const override
  {
    return cad_->triangles_for_fit(size);
  }

  [[nodiscard]] surface::CoarseSurface mesh_whole(const surface::CoarseOptions&) const override
  {
    return {.mesh = fitted_mesh(own_, *cad_, name_)};
  }

 private:
  coarse::OwnMesh own_;
  std::unique_ptr<LoadedModel> cad_;
  std::string name_;
};

// Faces are the CAD's, since they have its numbers; solids are the mesh's materials.
model::ModelDescription CadOwnModel::describe(surface::SurfaceMesher mesher) const
{
  model::ModelDescription described = cad_->describe(mesher);
  const mesh::CoarseMesh mesh = fitted_mesh(own_, *cad_, name_);
  const model::ModelDescription of_mesh = describe_mesh(mesh);
  described.solids = of_mesh.solids;
  for (model::FaceDescription& face : described.faces) face.solids.clear();
  for (LocalIndex p = 0; p < mesh.num_patches(); ++p) {
    for (model::FaceDescription& face : described.faces) {
      if (face.number != mesh.patch_surface[at(p)] + 1) continue;
      face.name = mesh.patch_names[at(p)];
      std::vector<LocalIndex> both;
      std::ranges::set_union(face.solids, of_mesh.faces[at(p)].solids, std::back_inserter(both));
      face.solids = std::move(both);
    }
  }
  return described;
}

// The first of these arrays that the cells have; zeros if they have none.
std::vector<std::int32_t> tags_of(const mesh::MeshArrays& cells,
                                  std::initializer_list<const char*> names)
{
  for (const char* name : names) {
    if (const auto found = cells.cell_ints.find(name); found != cells.cell_ints.end()) {
      return found->second;
    }
    const auto wide = cells.cell_longs.find(name);
    if (wide == cells.cell_longs.end()) continue;
    std::vector<std::int32_t> tags;
    for (const GlobalIndex tag : wide->second) tags.push_back(static_cast<std::int32_t>(tag));
    return tags;
  }
  return std::vector<std::int32_t>(static_cast<std::size_t>(cells.num_cells()), 0);
}

model::FileCells cells_of(const mesh::MeshArrays& cells, std::vector<std::int32_t> tags)
{
  model::FileCells to{.points = cells.cell_points, .group = std::move(tags)};
  for (GlobalIndex c = 0; c < cells.num_cells(); ++c) to.number.push_back(c);
  to.entity.assign(to.number.size(), 0);
  return to;
}

// Names by number, the first one having number `first`.
std::map<std::int32_t, std::string> names_in(const mesh::MeshArrays& cells, const char* array,
                                             std::int32_t first)
{
  std::map<std::int32_t, std::string> names;
  const auto texts = cells.field_texts.find(array);
  if (texts == cells.field_texts.end()) return names;
  for (const std::string& text : texts->second) names.emplace(first++, text);
  return names;
}

// Tags are "material" and "patch", or what other programs call them. Patches with names count from
// 0, as ours do; elsewhere that means none, so they become groups from 1.
model::TetMeshFile read_vtu_mesh(const std::filesystem::path& file)
{
  const mesh::MeshArrays tets = io::read_vtu(file);
  const mesh::MeshArrays triangles = io::read_vtu(file, io::CellOrder::triangles);
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", file.string(), what));
  };
  if (tets.vertices_per_cell != 4 || tets.num_cells() == 0) {
    refuse("it has no linear tets; a coarse mesh is one of linear tets");
  }
  if (const GlobalIndex num = tets.num_other_cells - triangles.num_cells(); num != 0) {
    refuse(
        fmt::format("it has {} cells that are neither linear tets nor linear triangles; leave "
                    "out lines and points, and split other cells into tets",
                    num));
  }
  if (tets.point_xyz != triangles.point_xyz) refuse("it has ghosts; save it without them");
  model::TetMeshFile mesh{.point_xyz = tets.point_xyz};
  for (GlobalIndex p = 0; p < tets.num_points(); ++p) {
    mesh.point_number.push_back(p);
    for (const double x : point_at(std::span(tets.point_xyz), p)) {
      if (!std::isfinite(x)) refuse(fmt::format("point {} is no finite number", p));
    }
  }
  mesh.tets =
      cells_of(tets, tags_of(tets, {"material", "attribute", "gmsh:physical", "CellEntityIds"}));
  mesh.tet_group_names = names_in(tets, "material_names", 1);
  std::vector<std::int32_t> patches =
      tags_of(triangles, {"patch", "gmsh:physical", "CellEntityIds"});
  if (tets.field_texts.contains("patch_names")) {
    for (std::int32_t& patch : patches) ++patch;
  }
  mesh.triangles = cells_of(triangles, std::move(patches));
  mesh.triangle_group_names = names_in(tets, "patch_names", 1);
  return mesh;
}

model::TetMeshFile read_mesh_file(const std::filesystem::path& file)
{
  const std::string extension = model::lower_case_extension(file);
  if (extension == ".vtu") return read_vtu_mesh(file);
  return extension == ".vol" ? model::read_vol(file) : model::read_msh(file);
}

}  // namespace

model::ModelSource import_own_mesh(const std::filesystem::path& file,
                                   const model::ImportOptions& options,
                                   const CadImporter& import_cad)
{
  OwnMeshContent content{.is_smooth = options.smooth,
                         .feature_angle_deg = options.feature_angle_deg};
  content.own =
      coarse::make_own_mesh(read_mesh_file(file), file.string(), options.feature_angle_deg);
  if (!options.cad.empty()) {
    model::ImportOptions of_cad{.feature_angle_deg = options.feature_angle_deg,
                                .assembly = options.assembly};
    of_cad.assembly.loose_curves = model::LooseParts::drop;
    of_cad.assembly.loose_faces = model::LooseParts::drop;  // The mesh need not have them.
    content.cad = import_cad(options.cad, of_cad);
  }
  model::ModelSource source{.format = model::Format::own, .file_name = file.string()};
  source.repairs = content.own.repairs;
  if (content.cad) {
    source.length_unit = content.cad->length_unit;
    source.assembly = content.cad->assembly;
    source.repairs.insert(source.repairs.end(), content.cad->repairs.begin(),
                          content.cad->repairs.end());
  }
  source.content = to_bytes(content);
  return source;
}

std::unique_ptr<LoadedModel> load_own_mesh(const model::ModelSource& source,
                                           const CadLoader& load_cad)
{
  auto content = from_bytes<OwnMeshContent>(source.content);
  if (content.is_smooth) {
    return std::make_unique<SmoothOwnModel>(std::move(content.own.mesh), content.feature_angle_deg);
  }
  if (!content.cad) return std::make_unique<FlatOwnModel>(std::move(content.own.mesh));
  return std::make_unique<CadOwnModel>(std::move(content.own), load_cad(*content.cad),
                                       source.file_name);
}

}  // namespace tessera::geometry

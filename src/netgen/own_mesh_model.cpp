// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/coarse/own_mesh.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/model/tet_mesh_file.hpp"

#include "netgen/loaded_model.hpp"

namespace tessera::netgen {
namespace {

constexpr double kTolerance = 1e-8;  // of the box diagonal, as Model promises

// ModelSource::content of a mesh file.
struct OwnMeshContent {
  coarse::OwnMesh own{};

  static auto fields(auto& self) { return std::tie(self.own); }
};

double box_diagonal_of(const mesh::CoarseMesh& mesh)
{
  Vec3 low = mesh.position(0);
  Vec3 high = low;
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], mesh.position(v)[axis]);
      high[axis] = std::max(high[axis], mesh.position(v)[axis]);
    }
  }
  return norm(high - low);
}

// The model is the mesh's own surface, so every new point lies on it already.
class FlatOwnModel final : public LoadedModel {
 public:
  explicit FlatOwnModel(coarse::OwnMesh own)
      : own_(std::move(own)), box_diagonal_(box_diagonal_of(own_.mesh))
  {
  }

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override
  {
    return kTolerance * box_diagonal_;
  }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override
  {
    return kTolerance * box_diagonal_;
  }
  [[nodiscard]] double box_diagonal() const override { return box_diagonal_; }
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
  [[nodiscard]] model::ModelDescription describe() const override;

  using LoadedModel::generate;
  [[nodiscard]] mesh::CoarseMesh generate(const coarse::CoarseOptions&,
                                          const NetgenMeshUser&) const override
  {
    return own_.mesh;
  }

 private:
  coarse::OwnMesh own_;
  double box_diagonal_;
};

model::ModelDescription describe_mesh(const mesh::CoarseMesh& mesh)
{
  model::ModelDescription described{.vertex_xyz = mesh.vertex_xyz,
                                    .triangle_vertices = mesh.face_vertices,
                                    .triangle_face = mesh.face_patch};
  for (const std::string& name : mesh.material_names) described.solids.push_back({.name = name});
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto v = mesh.tet(t);
    described.solids[at(mesh.tet_material[at(t)] - 1)].volume += tet_volume(
        mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]), mesh.position(v[3]));
  }
  for (const std::string& name : mesh.patch_names) {
    const auto number = static_cast<LocalIndex>(described.faces.size()) + 1;
    described.faces.push_back({.number = number, .name = name});
  }
  std::map<std::array<LocalIndex, 3>, LocalIndex> patch_of;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    const Vec3 a = mesh.position(v[0]);
    model::FaceDescription& face = described.faces[at(mesh.face_patch[at(f)])];
    face.area += 0.5 * norm(cross(mesh.position(v[1]) - a, mesh.position(v[2]) - a));
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

model::ModelDescription FlatOwnModel::describe() const { return describe_mesh(own_.mesh); }

model::TetMeshFile read_mesh_file(const std::filesystem::path& file)
{
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".vol" ? model::read_vol(file) : model::read_msh(file);
}

}  // namespace

model::ModelSource import_own_mesh(const std::filesystem::path& file,
                                   const model::ImportOptions& options)
{
  OwnMeshContent content;
  content.own =
      coarse::make_own_mesh(read_mesh_file(file), file.string(), options.feature_angle_deg);
  model::ModelSource source{.format = model::Format::own, .file_name = file.string()};
  source.repairs = content.own.repairs;
  source.content = to_bytes(content);
  return source;
}

std::unique_ptr<LoadedModel> load_own_mesh(const model::ModelSource& source)
{
  auto content = from_bytes<OwnMeshContent>(source.content);
  return std::make_unique<FlatOwnModel>(std::move(content.own));
}

}  // namespace tessera::netgen

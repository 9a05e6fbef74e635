// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/mesh_conversion.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

// Builds the coarse mesh array by array; each step needs the ones before it.
class Conversion {
  using Ends = std::array<LocalIndex, 2>;  // Of a segment, lower one first.

 public:
  Conversion(const ::netgen::Mesh& from, const GeometryNumbers& numbers)
      : from_(from), numbers_(numbers)
  {
  }

  DomainMesh run()
  {
    keep_vertices_of_tets();
    add_tets();
    add_patches();
    add_faces();
    if (numbers_.curve) add_segments();
    if (numbers_.material) require_all_curves();
    return {std::move(to_), std::move(tet_domain_)};
  }

 private:
  void keep_vertices_of_tets()
  {
    new_vertex_.assign(from_.GetNP(), kNoIndex);
    for (const auto& element : from_.VolumeElements()) {
      if (element.IsDeleted()) continue;
      if (element.GetType() != ::netgen::TET) throw NetgenError("a volume element is no tet");
      for (int c = 0; c < 4; ++c) new_vertex_.at(place(element[c])) = 0;
    }
    LocalIndex next = 0;
    for (std::size_t v = 0; v < new_vertex_.size(); ++v) {
      if (new_vertex_[v] == kNoIndex) continue;
      new_vertex_[v] = next++;
      const auto& point = from_[PointIndex(static_cast<int>(v) + PointIndex::BASE)];
      for (int axis = 0; axis < 3; ++axis) to_.vertex_xyz.push_back(point(axis));
    }
    if (next == 0) throw NetgenError("NETGEN made no tets");
  }

  void add_tets()
  {
    LocalIndex num_materials = 0;
    for (const auto& element : from_.VolumeElements()) {
      if (element.IsDeleted()) continue;
      for (const int c : kNetgenTetOrder) to_.tet_vertices.push_back(vertex(element[c]));
      tet_domain_.push_back(element.GetIndex());
      to_.tet_material.push_back(material(element.GetIndex()));
      num_materials = std::max(num_materials, to_.tet_material.back());
    }
    for (LocalIndex m = 1; m <= num_materials; ++m) {
      const std::string name = numbers_.material_name ? numbers_.material_name(m) : "";
      to_.material_names.push_back(name.empty() ? fmt::format("material_{}", m) : name);
    }
  }

  // Face descriptors without triangles (edges that NETGEN removed) become no patch.
  void add_patches()
  {
    patch_of_descriptor_.assign(static_cast<std::size_t>(from_.GetNFD()) + 1, kNoIndex);
    std::map<LocalIndex, std::vector<int>> descriptors;  // By what they have in common.
    for (const auto& element : from_.SurfaceElements()) {
      if (element.IsDeleted() || patch_of_descriptor_.at(descriptor(element)) == 0) continue;
      const auto& face = from_.GetFaceDescriptor(element.GetIndex());
      if (is_inside(face)) continue;
      patch_of_descriptor_[descriptor(element)] = 0;
      descriptors[numbers_.patch ? numbers_.patch(face) : element.GetIndex()].push_back(
          element.GetIndex());
    }
    for (const auto& [order, of_patch] : descriptors) {
      for (const int d : of_patch) {
        patch_of_descriptor_[static_cast<std::size_t>(d)] = to_.num_patches();
      }
      const auto& face = from_.GetFaceDescriptor(of_patch.front());
      const std::string name = numbers_.patch_name ? numbers_.patch_name(face) : "";
      to_.patch_surface.push_back(numbers_.surface(face));
      to_.patch_names.push_back(name.empty() ? default_patch_name(to_.num_patches()) : name);
    }
  }

  void add_faces()
  {
    for (const auto& element : from_.SurfaceElements()) {
      if (element.IsDeleted()) continue;
      if (element.GetType() != ::netgen::TRIG)
        throw NetgenError("a surface element is no triangle");
      if (patch_of_descriptor_.at(descriptor(element)) == kNoIndex) continue;
      to_.face_patch.push_back(patch_of_descriptor_.at(descriptor(element)));
      for (int c = 0; c < 3; ++c) {
        to_.face_vertices.push_back(vertex(element[c]));
        if (!numbers_.uv) continue;
        const model::SurfaceParameters uv = numbers_.uv(element, c);
        to_.face_uv.insert(to_.face_uv.end(), uv.begin(), uv.end());
      }
    }
  }

  void add_segments()
  {
    for (const ::netgen::Segment& segment : from_.LineSegments()) {
      if (!segment[0].IsValid()) continue;  // Deleted.
      const LocalIndex curve = numbers_.curve(segment);
      const Ends ends{vertex(segment[0]), vertex(segment[1])};
      if (ends[0] == kNoIndex || ends[1] == kNoIndex) continue;
      const auto [low, high] = std::minmax(ends[0], ends[1]);
      (curve == kNoIndex ? left_out_ : kept_).insert({low, high});
      if (curve == kNoIndex) continue;
      to_.segment_vertices.insert(to_.segment_vertices.end(), ends.begin(), ends.end());
      to_.segment_curve.push_back(curve);
      if (!numbers_.t) continue;
      for (int end = 0; end < 2; ++end) to_.segment_t.push_back(numbers_.t(segment, end));
    }
  }

  // Where a cut follows an edge of the model, NETGEN may have told it by the plane.
  void require_all_curves() const
  {
    std::map<Ends, LocalIndex> surface_beside;
    for (std::size_t corner = 0; corner < to_.face_vertices.size(); ++corner) {
      const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
      const auto [low, high] = std::minmax(to_.face_vertices[corner], to_.face_vertices[next]);
      const Ends ends{low, high};
      if (!left_out_.contains(ends) || kept_.contains(ends)) continue;
      const LocalIndex surface = to_.patch_surface[at(to_.face_patch[corner / 3])];
      if (surface_beside.emplace(ends, surface).first->second == surface) continue;
      throw NetgenError("a cut follows an edge of the model");
    }
  }

  [[nodiscard]] LocalIndex material(int domain) const
  {
    return numbers_.material ? numbers_.material(domain) : domain;
  }

  // Between two parts of one material.
  [[nodiscard]] bool is_inside(const ::netgen::FaceDescriptor& face) const
  {
    return numbers_.material && face.DomainIn() > 0 && face.DomainOut() > 0
           && material(face.DomainIn()) == material(face.DomainOut());
  }

  static std::size_t place(PointIndex p) { return static_cast<std::size_t>(p - PointIndex::BASE); }
  static std::size_t descriptor(const ::netgen::Element2d& element)
  {
    return static_cast<std::size_t>(element.GetIndex());
  }
  [[nodiscard]] LocalIndex vertex(PointIndex p) const { return new_vertex_.at(place(p)); }

  const ::netgen::Mesh& from_;
  const GeometryNumbers& numbers_;
  std::vector<LocalIndex> new_vertex_{};           // kNoIndex: no vertex of a tet.
  std::vector<LocalIndex> patch_of_descriptor_{};  // Descriptors count from 1.
  std::set<Ends> kept_{};
  std::set<Ends> left_out_{};  // Of no curve.
  mesh::CoarseMesh to_{};
  std::vector<LocalIndex> tet_domain_{};
};

}  // namespace

std::string default_patch_name(LocalIndex patch) { return fmt::format("patch_{}", patch + 1); }

DomainMesh to_domain_mesh(const ::netgen::Mesh& from, const GeometryNumbers& numbers,
                          const std::string& what)
{
  try {
    DomainMesh made = Conversion(from, numbers).run();
    mesh::validate(made.mesh);
    return made;
  } catch (const MeshError& error) {
    throw NetgenError(fmt::format("{}: {}", what, error.what()));
  }
}

mesh::CoarseMesh to_coarse_mesh(const ::netgen::Mesh& from, const GeometryNumbers& numbers,
                                const std::string& what)
{
  return to_domain_mesh(from, numbers, what).mesh;
}

}  // namespace tessera::netgen

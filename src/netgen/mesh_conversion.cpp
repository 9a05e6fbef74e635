// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/mesh_conversion.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

// Builds the coarse mesh array by array; each step needs the ones before it.
class Conversion {
 public:
  Conversion(const ::netgen::Mesh& from, const GeometryNumbers& numbers)
      : from_(from), numbers_(numbers)
  {
  }

  mesh::CoarseMesh run()
  {
    keep_vertices_of_tets();
    add_tets();
    add_patches();
    add_faces();
    if (numbers_.curve) add_segments();
    return std::move(to_);
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
      to_.tet_material.push_back(element.GetIndex());
      num_materials = std::max(num_materials, element.GetIndex());
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
    for (const auto& element : from_.SurfaceElements()) {
      if (!element.IsDeleted()) patch_of_descriptor_.at(descriptor(element)) = 0;
    }
    for (std::size_t d = 1; d < patch_of_descriptor_.size(); ++d) {
      if (patch_of_descriptor_[d] == kNoIndex) continue;
      patch_of_descriptor_[d] = to_.num_patches();
      const auto& face = from_.GetFaceDescriptor(static_cast<int>(d));
      const std::string name = numbers_.patch_name ? numbers_.patch_name(face) : "";
      to_.patch_surface.push_back(numbers_.surface(face));
      to_.patch_names.push_back(name.empty() ? fmt::format("patch_{}", to_.num_patches() + 1)
                                             : name);
    }
  }

  void add_faces()
  {
    for (const auto& element : from_.SurfaceElements()) {
      if (element.IsDeleted()) continue;
      if (element.GetType() != ::netgen::TRIG)
        throw NetgenError("a surface element is no triangle");
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
      const std::array<LocalIndex, 2> ends{vertex(segment[0]), vertex(segment[1])};
      if (curve == kNoIndex || ends[0] == kNoIndex || ends[1] == kNoIndex) continue;
      to_.segment_vertices.insert(to_.segment_vertices.end(), ends.begin(), ends.end());
      to_.segment_curve.push_back(curve);
      if (!numbers_.t) continue;
      for (int end = 0; end < 2; ++end) to_.segment_t.push_back(numbers_.t(segment, end));
    }
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
  mesh::CoarseMesh to_{};
};

class SurfaceConversion {
 public:
  SurfaceConversion(const ::netgen::Mesh& from, const GeometryNumbers& numbers)
      : from_(from), numbers_(numbers)
  {
  }

  coarse::CadSurface run()
  {
    for (int p = 1; p <= static_cast<int>(from_.GetNP()); ++p) {
      const auto& point = from_.Point(p);
      to_.triangles.vertex_xyz.push_back({point(0), point(1), point(2)});
    }
    to_.triangles.vertex_is_fixed.assign(to_.triangles.vertex_xyz.size(), 0);
    for (const auto& element : from_.SurfaceElements()) {
      if (!element.IsDeleted()) add(element);
    }
    add_edges();
    return std::move(to_);
  }

 private:
  // NETGEN's point out of DomainIn.
  void add(const ::netgen::Element2d& element)
  {
    const auto [entry, is_new] =
        patch_of_.try_emplace(element.GetIndex(), to_.triangles.num_patches());
    if (is_new) {
      const ::netgen::FaceDescriptor& face = from_.GetFaceDescriptor(element.GetIndex());
      to_.triangles.patch_materials.push_back(
          {std::max(face.DomainIn(), 0), std::max(face.DomainOut(), 0)});
      to_.patch_surface.push_back(numbers_.surface(face));
      to_.patch_names.push_back(numbers_.patch_name ? numbers_.patch_name(face) : "");
    }
    to_.triangles.triangles.push_back({number(element[0]), number(element[1]), number(element[2])});
    to_.triangles.triangle_patch.push_back(entry->second);
  }

  void add_edges()
  {
    std::map<std::array<LocalIndex, 2>, LocalIndex> curve_of_edge;
    for (const ::netgen::Segment& segment : from_.LineSegments()) {
      const LocalIndex curve = numbers_.curve(segment);
      if (!segment[0].IsValid() || curve == kNoIndex) continue;
      const LocalIndex a = number(segment[0]);
      const LocalIndex b = number(segment[1]);
      const auto next = static_cast<LocalIndex>(row_of_curve_.size());
      const auto [row, is_new] = row_of_curve_.try_emplace(curve, next);
      if (is_new) to_.curve_number.push_back(curve);
      curve_of_edge.emplace(std::array{std::min(a, b), std::max(a, b)}, row->second);
    }
    for (const auto& [edge, curve] : curve_of_edge) {
      to_.triangles.edges.push_back(edge);
      to_.triangles.edge_curve.push_back(curve);
    }
  }

  static LocalIndex number(PointIndex p) { return p - PointIndex::BASE; }

  const ::netgen::Mesh& from_;
  const GeometryNumbers& numbers_;
  std::map<int, LocalIndex> patch_of_{};             // By descriptor.
  std::map<LocalIndex, LocalIndex> row_of_curve_{};  // By the model's number.
  coarse::CadSurface to_{};
};

}  // namespace

coarse::CadSurface surface_of_mesh(const ::netgen::Mesh& from, const GeometryNumbers& numbers)
{
  return SurfaceConversion(from, numbers).run();
}

mesh::CoarseMesh to_coarse_mesh(const ::netgen::Mesh& from, const GeometryNumbers& numbers,
                                const std::string& what)
{
  try {
    mesh::CoarseMesh mesh = Conversion(from, numbers).run();
    mesh::validate(mesh);
    return mesh;
  } catch (const MeshError& error) {
    throw NetgenError(fmt::format("{}: {}", what, error.what()));
  }
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/mesh_conversion.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "geometry/named_surface.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

// Builds the coarse surface array by array; faces need the patches.
class Conversion {
  using Ends = std::array<LocalIndex, 2>;  // Of a segment, lower one first.

 public:
  Conversion(const ::netgen::Mesh& from, const GeometryNumbers& numbers)
      : from_(from), numbers_(numbers)
  {
  }

  surface::CoarseSurface run(double max_size)
  {
    add_vertices();
    add_patches();
    add_faces();
    if (numbers_.curve) add_segments();
    if (numbers_.material) require_all_curves();
    add_domains(max_size);
    return std::move(to_);
  }

 private:
  void add_vertices()
  {
    for (const auto& point : from_.Points()) {
      for (int axis = 0; axis < 3; ++axis) mesh_.vertex_xyz.push_back(point(axis));
    }
  }

  // Face descriptors without triangles (edges that NETGEN removed) become no patch.
  void add_patches()
  {
    patch_of_descriptor_.assign(static_cast<std::size_t>(from_.GetNFD()) + 1, kNoIndex);
    std::map<PatchKey, std::set<int>> descriptors;  // By what they have in common.
    for (const auto& element : from_.SurfaceElements()) {
      if (element.IsDeleted()) continue;
      const auto& face = from_.GetFaceDescriptor(element.GetIndex());
      if (is_cut(face)) continue;
      const PatchKey key = numbers_.patch ? numbers_.patch(face) : PatchKey{element.GetIndex()};
      descriptors[key].insert(element.GetIndex());
    }
    for (const auto& [key, of_patch] : descriptors) {
      for (const int d : of_patch) {
        patch_of_descriptor_[static_cast<std::size_t>(d)] = mesh_.num_patches();
      }
      const auto& face = from_.GetFaceDescriptor(*of_patch.begin());
      const std::string name = numbers_.patch_name ? numbers_.patch_name(face) : "";
      mesh_.patch_surface.push_back(numbers_.surface(face));
      mesh_.patch_names.push_back(name.empty() ? mesh::default_patch_name(mesh_.num_patches())
                                               : name);
    }
  }

  void add_faces()
  {
    for (const auto& element : from_.SurfaceElements()) {
      if (element.IsDeleted()) continue;
      if (element.GetType() != ::netgen::TRIG)
        throw NetgenError("a surface element is no triangle");
      const auto& face = from_.GetFaceDescriptor(element.GetIndex());
      mesh_.face_patch.push_back(patch_of_descriptor_.at(descriptor(element)));
      to_.face_domains.push_back({face.DomainIn(), face.DomainOut()});
      for (int c = 0; c < 3; ++c) {
        mesh_.face_vertices.push_back(vertex(element[c]));
        if (!numbers_.uv) continue;
        const model::SurfaceParameters uv = numbers_.uv(element, c);
        mesh_.face_uv.insert(mesh_.face_uv.end(), uv.begin(), uv.end());
      }
    }
  }

  void add_segments()
  {
    for (const ::netgen::Segment& segment : from_.LineSegments()) {
      if (!segment[0].IsValid()) continue;  // Deleted.
      const LocalIndex curve = numbers_.curve(segment);
      const Ends ends{vertex(segment[0]), vertex(segment[1])};
      const auto [low, high] = std::minmax(ends[0], ends[1]);
      (curve == kNoIndex ? off_curves_ : on_curves_).insert({low, high});
      mesh_.segment_vertices.insert(mesh_.segment_vertices.end(), ends.begin(), ends.end());
      mesh_.segment_curve.push_back(curve);
      if (!numbers_.t) continue;
      for (int end = 0; end < 2; ++end) mesh_.segment_t.push_back(numbers_.t(segment, end));
    }
  }

  void add_domains(double max_size)
  {
    geometry::add_domains(
        to_, max_size, [this](LocalIndex domain) { return material(domain); },
        numbers_.material_name);
    if (to_.domain_material.empty()) throw NetgenError("NETGEN's surface encloses nothing");
    for (LocalIndex domain = 1; domain <= to_.num_domains(); ++domain) {
      if (numbers_.part) to_.domain_part.push_back(numbers_.part(domain));
      if (!numbers_.max_size) continue;
      to_.domain_max_size[at(domain - 1)] = std::min(max_size, numbers_.max_size(domain));
    }
  }

  // Where a cut follows an edge of the model, NETGEN may have told it by the plane.
  void require_all_curves() const
  {
    std::map<Ends, LocalIndex> surface_beside;
    for (std::size_t corner = 0; corner < mesh_.face_vertices.size(); ++corner) {
      const LocalIndex patch = mesh_.face_patch[corner / 3];
      if (patch == kNoIndex) continue;  // Of a cut.
      const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
      const auto [low, high] = std::minmax(mesh_.face_vertices[corner], mesh_.face_vertices[next]);
      const Ends ends{low, high};
      if (!off_curves_.contains(ends) || on_curves_.contains(ends)) continue;
      const LocalIndex surface = mesh_.patch_surface[at(patch)];
      if (surface_beside.emplace(ends, surface).first->second == surface) continue;
      throw NetgenError("a cut follows an edge of the model");
    }
  }

  [[nodiscard]] LocalIndex material(int domain) const
  {
    return numbers_.material ? numbers_.material(domain) : domain;
  }

  [[nodiscard]] bool is_cut(const ::netgen::FaceDescriptor& face) const
  {
    return numbers_.material && face.DomainIn() > 0 && face.DomainOut() > 0
           && material(face.DomainIn()) == material(face.DomainOut());
  }

  static std::size_t descriptor(const ::netgen::Element2d& element)
  {
    return static_cast<std::size_t>(element.GetIndex());
  }
  static LocalIndex vertex(PointIndex p) { return p - PointIndex::BASE; }

  const ::netgen::Mesh& from_;
  const GeometryNumbers& numbers_;
  std::vector<LocalIndex> patch_of_descriptor_{};  // Descriptors count from 1.
  std::set<Ends> on_curves_{};
  std::set<Ends> off_curves_{};
  surface::CoarseSurface to_{};
  mesh::CoarseMesh& mesh_ = to_.mesh;
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

surface::CoarseSurface to_coarse_surface(const ::netgen::Mesh& from, const GeometryNumbers& numbers,
                                         double max_size, const std::string& what)
{
  try {
    return Conversion(from, numbers).run(max_size);
  } catch (const MeshError& error) {
    throw NetgenError(fmt::format("{}: {}", what, error.what()));
  }
}

void add_tets(::netgen::Mesh& mesh, const std::vector<LocalIndex>& tet_vertices, int domain)
{
  for (std::size_t t = 0; t < tet_vertices.size(); t += 4) {
    ::netgen::Element tet(4);
    for (std::size_t c = 0; c < 4; ++c) {
      const int place = kNetgenTetOrder[c];
      tet[place] = tet_vertices[t + c] + PointIndex::BASE;
    }
    tet.SetIndex(domain);
    mesh.AddVolumeElement(tet);
  }
}

}  // namespace tessera::netgen

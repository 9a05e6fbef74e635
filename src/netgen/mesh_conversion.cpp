// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/mesh_conversion.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

// Builds the coarse surface array by array; faces need the patches.
class Conversion {
 public:
  Conversion(const ::netgen::Mesh& from, const GeometryNumbers& numbers)
      : from_(from), numbers_(numbers)
  {
  }

  coarse::CoarseSurface run(double max_size)
  {
    add_vertices();
    add_patches();
    add_faces();
    if (numbers_.curve) add_segments();
    add_materials(to_, max_size, numbers_.material_name);
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
    for (const auto& element : from_.SurfaceElements()) {
      if (!element.IsDeleted()) patch_of_descriptor_.at(descriptor(element)) = 0;
    }
    for (std::size_t d = 1; d < patch_of_descriptor_.size(); ++d) {
      if (patch_of_descriptor_[d] == kNoIndex) continue;
      patch_of_descriptor_[d] = mesh_.num_patches();
      const auto& face = from_.GetFaceDescriptor(static_cast<int>(d));
      mesh_.patch_surface.push_back(numbers_.surface(face));
      mesh_.patch_names.push_back(patch_name(numbers_.patch_name ? numbers_.patch_name(face) : "",
                                             mesh_.num_patches() + 1));
      to_.patch_domains.push_back({face.DomainIn(), face.DomainOut()});
    }
  }

  void add_faces()
  {
    for (const auto& element : from_.SurfaceElements()) {
      if (element.IsDeleted()) continue;
      if (element.GetType() != ::netgen::TRIG)
        throw NetgenError("a surface element is no triangle");
      mesh_.face_patch.push_back(patch_of_descriptor_.at(descriptor(element)));
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
      if (curve == kNoIndex) continue;
      mesh_.segment_vertices.insert(mesh_.segment_vertices.end(),
                                    {vertex(segment[0]), vertex(segment[1])});
      mesh_.segment_curve.push_back(curve);
      if (!numbers_.t) continue;
      for (int end = 0; end < 2; ++end) mesh_.segment_t.push_back(numbers_.t(segment, end));
    }
  }

  static std::size_t descriptor(const ::netgen::Element2d& element)
  {
    return static_cast<std::size_t>(element.GetIndex());
  }
  static LocalIndex vertex(PointIndex p) { return p - PointIndex::BASE; }

  const ::netgen::Mesh& from_;
  const GeometryNumbers& numbers_;
  std::vector<LocalIndex> patch_of_descriptor_{};  // Descriptors count from 1.
  coarse::CoarseSurface to_{};
  mesh::CoarseMesh& mesh_ = to_.mesh;
};

}  // namespace

std::string patch_name(const std::string& name_in_file, LocalIndex number)
{
  return name_in_file.empty() ? fmt::format("patch_{}", number) : name_in_file;
}

void add_materials(coarse::CoarseSurface& surface, double max_size,
                   const std::function<std::string(LocalIndex)>& name)
{
  LocalIndex num_materials = 0;
  for (const auto& domains : surface.patch_domains) {
    num_materials = std::max({num_materials, domains[0], domains[1]});
  }
  for (LocalIndex m = 1; m <= num_materials; ++m) {
    const std::string given = name ? name(m) : "";
    surface.mesh.material_names.push_back(given.empty() ? fmt::format("material_{}", m) : given);
  }
  surface.domain_max_size.assign(at(num_materials), max_size);
}

coarse::CoarseSurface to_coarse_surface(const ::netgen::Mesh& from, const GeometryNumbers& numbers,
                                        double max_size, const std::string& what)
{
  try {
    coarse::CoarseSurface surface = Conversion(from, numbers).run(max_size);
    if (surface.domain_max_size.empty()) throw NetgenError("NETGEN's surface encloses nothing");
    if (!numbers.max_size) return surface;
    for (std::size_t d = 0; d < surface.domain_max_size.size(); ++d) {
      double& size = surface.domain_max_size[d];
      size = std::min(size, numbers.max_size(static_cast<int>(d) + 1));
    }
    return surface;
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

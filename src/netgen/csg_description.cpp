// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg_description.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "tessera/base/error.hpp"

#include "netgen/csg_access.hpp"

namespace tessera::netgen {
namespace {

class Describer {
 public:
  Describer(const ::netgen::CSGeometry& geometry, const ::netgen::Mesh& mesh)
      : geometry_(geometry), mesh_(mesh)
  {
  }

  model::ModelDescription run()
  {
    for (int solid = 0; solid < geometry_.GetNTopLevelObjects(); ++solid) {
      described_.solids.push_back({.name = name_of_solid(geometry_, solid)});
    }
    for (int p = 1; p <= static_cast<int>(mesh_.GetNP()); ++p) {
      const Vec3 point = from_netgen(mesh_.Point(p));
      described_.vertex_xyz.insert(described_.vertex_xyz.end(), point.begin(), point.end());
    }
    for (const auto& element : mesh_.SurfaceElements()) {
      if (!element.IsDeleted() && element.GetType() == ::netgen::TRIG) add(element);
    }
    number_faces();
    return std::move(described_);
  }

 private:
  void add(const ::netgen::Element2d& element)
  {
    const ::netgen::FaceDescriptor& from = mesh_.GetFaceDescriptor(element.GetIndex());
    std::array<Vec3, 3> p{};
    std::array<LocalIndex, 3> vertices{};
    for (std::size_t c = 0; c < 3; ++c) {
      const int point = element[static_cast<int>(c)];
      p[c] = from_netgen(mesh_.Point(point));
      vertices[c] = point - 1;
    }
    // NETGEN's point out of DomainIn.
    const bool is_in_lower =
        from.DomainIn() > 0 && (from.DomainOut() <= 0 || from.DomainIn() < from.DomainOut());
    if (!is_in_lower) std::swap(vertices[1], vertices[2]);
    described_.triangle_vertices.insert(described_.triangle_vertices.end(), vertices.begin(),
                                        vertices.end());
    model::FaceDescription& face = faces_[from.SurfNr()];
    face.name = name_unless_default(from.GetBCName());
    face.area += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
    described_.triangle_face.push_back(from.SurfNr());
    const double volume = tet_volume(from_netgen(mesh_.Point(1)), p[0], p[1], p[2]);
    add_side(from.DomainIn(), volume, face);
    add_side(from.DomainOut(), -volume, face);
  }

  void add_side(int domain, double volume, model::FaceDescription& face)
  {
    if (domain <= 0) return;
    described_.solids.at(static_cast<std::size_t>(domain) - 1).volume += volume;
    const auto place = std::ranges::lower_bound(face.solids, domain);
    if (place == face.solids.end() || *place != domain) face.solids.insert(place, domain);
  }

  // Surfaces that bound nothing are no faces.
  void number_faces()
  {
    std::map<LocalIndex, LocalIndex> rows;
    for (auto& [surface, face] : faces_) {
      rows[surface] = static_cast<LocalIndex>(described_.faces.size());
      face.number = surface + 1;
      described_.faces.push_back(std::move(face));
    }
    for (LocalIndex& face : described_.triangle_face) face = rows.at(face);
  }

  const ::netgen::CSGeometry& geometry_;
  const ::netgen::Mesh& mesh_;
  std::map<LocalIndex, model::FaceDescription> faces_{};  // By surface.
  model::ModelDescription described_{};
};

}  // namespace

model::ModelDescription describe_csg(const ::netgen::CSGeometry& geometry,
                                     const ::netgen::Mesh& surface_mesh)
{
  return Describer(geometry, surface_mesh).run();
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/description.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "netgen/csg/access.hpp"

namespace tessera::netgen {
namespace {

class Describer {
 public:
  Describer(const ::netgen::CSGeometry& geometry, const surface::CoarseSurface& surface)
      : geometry_(geometry), surface_(surface)
  {
  }

  model::ModelDescription run()
  {
    for (int solid = 0; solid < geometry_.GetNTopLevelObjects(); ++solid) {
      described_.solids.push_back({.name = name_of_solid(geometry_, solid)});
    }
    described_.vertex_xyz = mesh_.vertex_xyz.to_vector();
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) add(f);
    number_faces();
    return std::move(described_);
  }

 private:
  void add(LocalIndex f)
  {
    const LocalIndex* const v = &mesh_.face_vertices[3 * at(f)];
    std::array<LocalIndex, 3> vertices{v[0], v[1], v[2]};
    const auto [a, b, c] =
        std::array{mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
    const LocalIndex out_of = solid_of(surface_.face_domains[at(f)][0]);
    const LocalIndex into = solid_of(surface_.face_domains[at(f)][1]);
    const bool is_out_of_lower = out_of > 0 && (into == 0 || out_of < into);
    if (!is_out_of_lower) std::swap(vertices[1], vertices[2]);
    described_.triangle_vertices.insert(described_.triangle_vertices.end(), vertices.begin(),
                                        vertices.end());
    const LocalIndex number = mesh_.patch_surface[at(mesh_.face_patch[at(f)])];
    described_.triangle_face.push_back(number);
    model::FaceDescription& face = faces_[number];
    face.area += triangle_area(a, b, c);
    const double volume = tet_volume(mesh_.position(0), a, b, c);
    add_side(out_of, volume, face);
    add_side(into, -volume, face);
  }

  // 0: none.
  [[nodiscard]] LocalIndex solid_of(LocalIndex domain) const
  {
    return domain == 0 ? 0 : surface_.domain_material[at(domain - 1)];
  }

  void add_side(LocalIndex solid, double volume, model::FaceDescription& face)
  {
    if (solid == 0) return;
    described_.solids.at(at(solid - 1)).volume += volume;
    const auto place = std::ranges::lower_bound(face.solids, solid);
    if (place == face.solids.end() || *place != solid) face.solids.insert(place, solid);
  }

  // Surfaces that bound nothing are no faces.
  void number_faces()
  {
    std::map<LocalIndex, LocalIndex> rows;
    for (auto& [number, face] : faces_) {
      rows[number] = static_cast<LocalIndex>(described_.faces.size());
      face.number = number + 1;
      face.name = name_unless_default(geometry_.GetSurface(number)->GetBCName());
      described_.faces.push_back(std::move(face));
    }
    for (LocalIndex& face : described_.triangle_face) face = rows.at(face);
  }

  const ::netgen::CSGeometry& geometry_;
  const surface::CoarseSurface& surface_;
  const mesh::CoarseMesh& mesh_ = surface_.mesh;
  std::map<LocalIndex, model::FaceDescription> faces_{};  // By the model's surface number.
  model::ModelDescription described_{};
};

}  // namespace

model::ModelDescription describe_csg(const ::netgen::CSGeometry& geometry,
                                     const surface::CoarseSurface& surface)
{
  return Describer(geometry, surface).run();
}

}  // namespace tessera::netgen

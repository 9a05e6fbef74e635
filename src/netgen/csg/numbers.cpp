// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/numbers.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/named_surface.hpp"
#include "netgen/csg/access.hpp"
#include "netgen/csg/patches.hpp"
#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;

class Numbering {
 public:
  Numbering(surface::CoarseSurface surface, const CsgTriangles& triangles, const Geometry& geometry)
      : surface_(std::move(surface)),
        mesh_(surface_.mesh),
        triangles_(triangles),
        geometry_(geometry)
  {
  }

  surface::CoarseSurface run()
  {
    number_curves();
    number_solids();
    number_patches();
    separate_patches(mesh_);
    return std::move(surface_);
  }

 private:
  // Between two bodies on one surface there is none.
  void number_curves()
  {
    FlatArray<LocalIndex> vertices;
    FlatArray<LocalIndex> curves;
    for (LocalIndex s = 0; s < mesh_.num_segments(); ++s) {
      const LocalIndex curve = triangles_.cad.curve_number[at(mesh_.segment_curve[at(s)])];
      if (curve == kNoIndex) continue;
      const LocalIndex* const ends = &mesh_.segment_vertices[2 * at(s)];
      vertices.insert(vertices.end(), ends, ends + 2);
      curves.push_back(curve);
    }
    mesh_.segment_vertices = std::move(vertices);
    mesh_.segment_curve = std::move(curves);
  }

  void number_solids()
  {
    for (std::size_t domain = 0; domain < triangles_.body_object.size(); ++domain) {
      const LocalIndex solid = triangles_.body_object[domain];
      surface_.domain_material[domain] = solid + 1;
      double& max_size = surface_.domain_max_size[domain];
      max_size = std::min(max_size, max_size_of_solid(geometry_, solid));
    }
    mesh_.material_names = triangles_.cad.solid_names;
  }

  [[nodiscard]] LocalIndex material_of(LocalIndex domain) const
  {
    return domain == 0 ? 0 : surface_.domain_material[at(domain - 1)];
  }

  void number_patches()
  {
    std::map<PatchKey, LocalIndex> patches;
    std::vector<PatchKey> keys;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      const LocalIndex row = mesh_.patch_surface[at(mesh_.face_patch[at(f)])];
      const auto [out_of, into] = surface_.face_domains[at(f)];
      keys.push_back(key_of_patch(triangles_.cad.patch_surface[at(row)], material_of(out_of),
                                  material_of(into)));
      patches[keys.back()] = 0;
    }
    mesh_.patch_names.clear();
    mesh_.patch_surface.clear();
    for (auto& [key, patch] : patches) {
      patch = mesh_.num_patches();
      const std::string name = name_of_patch(key[0], key[1], key[2]);
      mesh_.patch_surface.push_back(key[0]);
      mesh_.patch_names.push_back(name.empty() ? mesh::default_patch_name(patch) : name);
    }
    for (std::size_t f = 0; f < keys.size(); ++f) mesh_.face_patch[f] = patches[keys[f]];
  }

  // The last statement counts that names the surface where it bounds one of the solids.
  [[nodiscard]] std::string name_of_patch(LocalIndex surface, LocalIndex low, LocalIndex high) const
  {
    std::string name = geometry_.GetSurface(surface)->GetBCName();
    for (const Geometry::BCModification& one : geometry_.bcmodifications) {
      const bool is_here = geometry_.GetSurfaceClassRepresentant(one.si) == surface
                           && (one.tlonr + 1 == low || one.tlonr + 1 == high);
      if (is_here && one.bcname != nullptr) name = *one.bcname;
    }
    return name_unless_default(name);
  }

  surface::CoarseSurface surface_;
  mesh::CoarseMesh& mesh_;
  const CsgTriangles& triangles_;
  const Geometry& geometry_;
};

}  // namespace

surface::CoarseSurface in_numbers_of_csg(const surface::PatchSurface& surface,
                                         const CsgTriangles& triangles, const Geometry& geometry,
                                         double max_size)
{
  const geometry::SurfaceNames later{[](LocalIndex) { return std::string(); },
                                     [](LocalIndex) { return std::string(); }};
  return Numbering(geometry::to_coarse_surface(surface, max_size, later), triangles, geometry)
      .run();
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/description.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tessera/base/tet.hpp"

#include "netgen/csg/access.hpp"
#include "netgen/csg/patches.hpp"

namespace tessera::netgen {
namespace {

using Line = std::pair<LocalIndex, LocalIndex>;  // Vertices, ascending.

class Describer {
 public:
  Describer(const ::netgen::CSGeometry& geometry, const surface::CoarseSurface& surface)
      : geometry_(geometry), surface_(surface)
  {
  }

  model::ModelDescription run(const std::function<std::string(LocalIndex)>& number_of_curve)
  {
    for (int solid = 0; solid < geometry_.GetNTopLevelObjects(); ++solid) {
      described_.solids.push_back({.name = name_of_solid(geometry_, solid)});
    }
    described_.vertex_xyz = mesh_.vertex_xyz.to_vector();
    add_faces();
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) add(f);
    add_edges(number_of_curve);
    return std::move(described_);
  }

 private:
  // Pieces of a patch that are apart are one face.
  void add_faces()
  {
    std::map<PatchKey, LocalIndex> patches;  // One of each.
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) patches.emplace(key_of(f), patch_of(f));
    for (const auto& [key, patch] : patches) {
      const auto row = static_cast<LocalIndex>(described_.faces.size());
      const std::string& name = mesh_.patch_names[at(patch)];
      described_.faces.push_back(
          {.number = key[0] + 1,
           .patch = row,
           .name = name == mesh::default_patch_name(row) ? std::string() : name});
      row_of_.emplace(key, row);
    }
  }

  void add(LocalIndex f)
  {
    const LocalIndex* const v = &mesh_.face_vertices[3 * at(f)];
    std::array<LocalIndex, 3> vertices{v[0], v[1], v[2]};
    const auto [a, b, c] = corners_at<3>(mesh_.vertex_xyz, mesh_.face_vertices, f);
    const auto [out_of, into] = solids_of(f);
    const bool is_out_of_lower = out_of > 0 && (into == 0 || out_of < into);
    if (!is_out_of_lower) std::swap(vertices[1], vertices[2]);
    described_.triangle_vertices.insert(described_.triangle_vertices.end(), vertices.begin(),
                                        vertices.end());
    const LocalIndex row = row_of_.at(key_of(f));
    described_.triangle_face.push_back(row);
    model::FaceDescription& face = described_.faces[at(row)];
    face.area += triangle_area(a, b, c);
    const double volume = tet_volume(mesh_.position(0), a, b, c);
    add_side(out_of, volume, face);
    add_side(into, -volume, face);
  }

  [[nodiscard]] LocalIndex patch_of(LocalIndex f) const { return mesh_.face_patch[at(f)]; }

  [[nodiscard]] PatchKey key_of(LocalIndex f) const
  {
    const auto [out_of, into] = solids_of(f);
    return key_of_patch(mesh_.patch_surface[at(patch_of(f))], out_of, into);
  }

  [[nodiscard]] std::array<LocalIndex, 2> solids_of(LocalIndex f) const
  {
    const auto [out_of, into] = surface_.face_domains[at(f)];
    return {solid_of(out_of), solid_of(into)};
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

  // A segment stands once for each side.
  void add_edges(const std::function<std::string(LocalIndex)>& number_of_curve)
  {
    std::map<LocalIndex, std::set<Line>> lines;
    for (LocalIndex s = 0; s < mesh_.num_segments(); ++s) {
      const LocalIndex curve = mesh_.segment_curve[at(s)];
      const LocalIndex* const ends = &mesh_.segment_vertices[2 * at(s)];
      if (curve != kNoIndex) lines[curve].insert(std::minmax(ends[0], ends[1]));
    }
    const std::map<Line, std::set<LocalIndex>> faces = faces_at_lines();
    for (const auto& [curve, of_curve] : lines) {
      model::EdgeDescription& edge = described_.edges.emplace_back();
      edge.number = number_of_curve(curve);
      std::set<LocalIndex> beside;
      for (const Line& line : of_curve) {
        edge.add_line(mesh_.position(line.first), mesh_.position(line.second));
        if (const auto found = faces.find(line); found != faces.end()) {
          beside.insert(found->second.begin(), found->second.end());
        }
      }
      edge.faces.assign(beside.begin(), beside.end());
    }
  }

  // Rows of the faces that lines have triangles of.
  [[nodiscard]] std::map<Line, std::set<LocalIndex>> faces_at_lines() const
  {
    std::map<Line, std::set<LocalIndex>> faces;
    for (std::size_t t = 0; t < described_.triangle_face.size(); ++t) {
      const LocalIndex* const v = &described_.triangle_vertices[3 * t];
      for (std::size_t c = 0; c < 3; ++c) {
        faces[std::minmax(v[c], v[(c + 1) % 3])].insert(described_.triangle_face[t]);
      }
    }
    return faces;
  }

  const ::netgen::CSGeometry& geometry_;
  const surface::CoarseSurface& surface_;
  const mesh::CoarseMesh& mesh_ = surface_.mesh;
  std::map<PatchKey, LocalIndex> row_of_{};  // Of faces.
  model::ModelDescription described_{};
};

}  // namespace

model::ModelDescription describe_csg(const ::netgen::CSGeometry& geometry,
                                     const surface::CoarseSurface& surface,
                                     const std::function<std::string(LocalIndex)>& number_of_curve)
{
  return Describer(geometry, surface).run(number_of_curve);
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/fit_to_cad.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/model/nearest_point.hpp"

#include "coarse/own/cad_search.hpp"
#include "coarse/own/own_patches.hpp"

namespace tessera::coarse {
namespace {

// How far a vertex may be off the CAD, in parts of its shortest edge on the boundary. Programs that
// print six digits are off by far less; what is off by more is another model.
constexpr double kTolerance = 0.1;

// How far the CAD may bulge out of a triangle, in parts of its longest edge: 0.29 over 120 degrees.
constexpr double kMostBulge = 0.5;

std::string place_text(const Vec3& p) { return fmt::format("({:g})", fmt::join(p, ", ")); }

class Fitter {
 public:
  Fitter(const OwnMesh& own, const CadSurface& cad, const surface::SurfaceReference& reference,
         const model::Model& model, const std::string& name)
      : own_(own), cad_(cad), search_(cad, reference, model), name_(name), mesh_(own.mesh)
  {
  }

  mesh::CoarseMesh run()
  {
    find_shortest_edges();
    find_patches_of_vertices();
    put_faces_to_patches();
    require_coverage();
    find_segments();
    require_vertices_near();
    place_corners();
    name_patches();
    name_materials();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const
  {
    throw InputError(
        fmt::format("{}: does not fit the CAD model: {}; check that geometry.cad is the model that "
                    "was meshed, in the same length unit and place",
                    name_, what));
  }

  [[nodiscard]] std::array<Vec3, 3> corners_of(LocalIndex f) const
  {
    return corners_at<3>(mesh_.vertex_xyz, mesh_.face_vertices, f);
  }

  // What users see of a patch: `tessera info` counts from 1.
  [[nodiscard]] std::string face_text(LocalIndex patch) const
  {
    const std::string& name = cad_.patch_names[at(patch)];
    const LocalIndex number = cad_.patch_surface[at(patch)] + 1;
    return name.empty() ? fmt::format("face {}", number)
                        : fmt::format("face {} '{}'", number, name);
  }

  void find_shortest_edges()
  {
    shortest_.assign(at(mesh_.num_vertices()), 0.0);
    edges_ = faces_of_edges(mesh_.face_vertices);
    for (const auto& [edge, faces] : edges_) {
      const double length = norm(mesh_.position(edge[1]) - mesh_.position(edge[0]));
      for (const LocalIndex v : edge) {
        double& shortest = shortest_[at(v)];
        if (shortest == 0.0 || length < shortest) shortest = length;
      }
    }
  }

  void find_patches_of_vertices()
  {
    patches_of_vertex_.resize(at(mesh_.num_vertices()));
    for (LocalIndex v = 0; v < mesh_.num_vertices(); ++v) {
      if (shortest_[at(v)] == 0.0) continue;  // Inside.
      patches_of_vertex_[at(v)] =
          search_.patches_near(mesh_.position(v), kTolerance * shortest_[at(v)]);
    }
  }

  // The patches that have all three corners.
  [[nodiscard]] std::vector<LocalIndex> candidates(LocalIndex f) const
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    std::vector<LocalIndex> common = patches_of_vertex_[at(v[0])];
    for (std::size_t c = 1; c < 3; ++c) {
      std::erase_if(common, [&](LocalIndex patch) {
        return !std::ranges::binary_search(patches_of_vertex_[at(v[c])], patch);
      });
    }
    return common;
  }

  void put_faces_to_patches()
  {
    std::vector<std::vector<LocalIndex>> of_faces;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      of_faces.push_back(candidates(f));
      if (of_faces.back().empty()) refuse_face(f);
    }
    const auto tagged = patches_of_tags(of_faces);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      const LocalIndex hint = tagged[at(mesh_.face_patch[at(f)])];
      face_cad_.push_back(hint != kNoIndex ? hint : best_of(of_faces[at(f)], f));
    }
  }

  // The CAD patch that the number or the name of each patch of the file means; kNoIndex for all
  // unless all triangles with such a number lie there.
  [[nodiscard]] std::vector<LocalIndex> patches_of_tags(
      const std::vector<std::vector<LocalIndex>>& of_faces) const
  {
    std::vector<LocalIndex> meant(own_.patch_entity.size(), kNoIndex);
    for (std::size_t p = 0; p < meant.size(); ++p) {
      const auto surface = std::ranges::find(cad_.patch_surface, own_.patch_entity[p] - 1);
      if (own_.patch_entity[p] > 0 && surface != cad_.patch_surface.end()) {
        meant[p] = static_cast<LocalIndex>(surface - cad_.patch_surface.begin());
      }
    }
    for (std::size_t f = 0; f < of_faces.size(); ++f) {
      const LocalIndex patch = meant[at(mesh_.face_patch[f])];
      if (patch == kNoIndex || std::ranges::binary_search(of_faces[f], patch)) continue;
      std::ranges::fill(meant, kNoIndex);
      break;
    }
    return meant;
  }

  [[nodiscard]] LocalIndex best_of(const std::vector<LocalIndex>& patches, LocalIndex f) const
  {
    LocalIndex best = patches.front();
    if (patches.size() == 1) return best;
    double least = std::numeric_limits<double>::infinity();
    for (const LocalIndex patch : patches) {
      const double misfit = search_.misfit(patch, corners_of(f));
      if (misfit >= least) continue;
      least = misfit;
      best = patch;
    }
    return best;
  }

  // Says the largest distance that there is, so that one look tells another unit from a bad place.
  [[noreturn]] void refuse_face(LocalIndex f) const
  {
    double largest = 0.0;
    LocalIndex farthest = kNoIndex;
    for (LocalIndex v = 0; v < mesh_.num_vertices(); ++v) {
      if (shortest_[at(v)] == 0.0 || !patches_of_vertex_[at(v)].empty()) continue;
      const double distance = search_.nearest_patch(mesh_.position(v)).second.distance;
      if (distance < largest) continue;
      largest = distance;
      farthest = v;
    }
    const Vec3 middle = middle_of(corners_of(f));
    if (farthest == kNoIndex) {
      fail(fmt::format("no face has all corners of the boundary triangle at {}",
                       place_text(middle)));
    }
    fail(
        fmt::format("the boundary vertex at {} is off by {:g}, the largest distance; {} is nearest",
                    place_text(mesh_.position(farthest)), largest,
                    face_text(search_.nearest_patch(mesh_.position(farthest)).first)));
  }

  // Every triangle of the CAD has one of the mesh near it.
  void require_coverage() const
  {
    const auto num_patches = at(cad_.triangles.num_patches());
    std::vector<std::vector<std::array<Vec3, 3>>> of_patch(num_patches);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      of_patch[at(face_cad_[at(f)])].push_back(corners_of(f));
    }
    std::vector<std::optional<model::TriangleSearch>> searches(num_patches);
    for (std::size_t p = 0; p < num_patches; ++p) {
      if (!of_patch[p].empty()) searches[p].emplace(of_patch[p]);
    }
    for (std::size_t t = 0; t < cad_.triangles.triangles.size(); ++t) {
      const LocalIndex patch = cad_.triangles.triangle_patch[t];
      const Vec3 middle = middle_of(cad_.triangles.corners(t));
      if (!searches[at(patch)]) {
        fail(fmt::format("{}, at {}, has no triangle of the mesh", face_text(patch),
                         place_text(middle)));
      }
      const model::NearestPoint nearest = searches[at(patch)]->nearest(middle);
      const double longest = longest_side(of_patch[at(patch)][at(nearest.simplex)]);
      const double distance = norm(nearest.xyz - middle);
      if (distance <= kMostBulge * longest) continue;
      fail(fmt::format("{} is not covered at {}: the nearest triangle of the mesh is {:g} away",
                       face_text(patch), place_text(middle), distance));
    }
  }

  void find_segments()
  {
    for (const auto& [edge, faces] : edges_) {
      std::set<LocalIndex> patches;
      for (const LocalIndex f : faces) patches.insert(face_cad_[at(f)]);
      if (patches.size() < 2) continue;
      const LocalIndex curve = curve_of(edge, patches);
      mesh_.segment_vertices.insert(mesh_.segment_vertices.end(), edge.begin(), edge.end());
      mesh_.segment_curve.push_back(cad_.curve_number[at(curve)]);
      for (const LocalIndex v : edge) curves_of_vertex_[v].push_back(curve);
    }
  }

  // The nearest of those between any two of the patches.
  [[nodiscard]] LocalIndex curve_of(const std::array<LocalIndex, 2>& edge,
                                    const std::set<LocalIndex>& patches) const
  {
    const Vec3 a = mesh_.position(edge[0]);
    const Vec3 b = mesh_.position(edge[1]);
    LocalIndex best = kNoIndex;
    double least = std::numeric_limits<double>::infinity();
    for (const LocalIndex first : patches) {
      for (const LocalIndex second : patches) {
        if (first >= second) continue;
        for (const LocalIndex curve : search_.curves_between(first, second)) {
          const double distance =
              std::max(search_.on_curve(curve, a).distance, search_.on_curve(curve, b).distance)
              + search_.on_curve(curve, midpoint(a, b)).distance;
          if (distance >= least) continue;
          least = distance;
          best = curve;
        }
      }
    }
    if (best != kNoIndex && least <= kMostBulge * norm(b - a)) return best;
    fail(fmt::format("the edge from {} to {} lies between {} and {}, and on no curve of theirs",
                     place_text(a), place_text(b), face_text(*patches.begin()),
                     face_text(*patches.rbegin())));
  }

  // Corners are near a patch by their choice; what lies on a curve must be near that as well.
  void require_vertices_near() const
  {
    double largest = 0.0;
    LocalIndex farthest = kNoIndex;
    for (const auto& [v, curves] : curves_of_vertex_) {
      for (const LocalIndex curve : curves) {
        const double distance = search_.on_curve(curve, mesh_.position(v)).distance;
        if (distance <= kTolerance * shortest_[at(v)] || distance <= largest) continue;
        largest = distance;
        farthest = v;
      }
    }
    if (farthest == kNoIndex) return;
    fail(fmt::format("the vertex at {} is off its curve by {:g}, the largest distance",
                     place_text(mesh_.position(farthest)), largest));
  }

  // Others are moved later, along with those of other meshers.
  void place_corners()
  {
    std::vector<std::vector<LocalIndex>> tets(at(mesh_.num_vertices()));
    for (std::size_t c = 0; c < mesh_.tet_vertices.size(); ++c) {
      tets[at(mesh_.tet_vertices[c])].push_back(static_cast<LocalIndex>(c / 4));
    }
    for (const auto& [v, curves] : curves_of_vertex_) {
      if (curves.size() == 2 && curves[0] == curves[1]) continue;
      const Vec3 before = mesh_.position(v);
      const CadPlace corner = search_.nearest_corner(before);
      if (corner.distance > kTolerance * shortest_[at(v)]) continue;
      set_position(v, corner.xyz);
      const bool is_sound =
          std::ranges::all_of(tets[at(v)], [&](LocalIndex t) { return volume(t) > 0.0; });
      if (!is_sound) set_position(v, before);
    }
  }

  void set_position(LocalIndex v, const Vec3& point)
  {
    std::ranges::copy(point, mesh_.vertex_xyz.begin() + static_cast<std::ptrdiff_t>(3 * at(v)));
  }

  [[nodiscard]] double volume(LocalIndex t) const
  {
    return tet_volume(corners_at<4>(mesh_.vertex_xyz, mesh_.tet_vertices, t));
  }

  // One patch for each pair of a face and a tag. Named ones stay in the row of their name, the
  // others have a row a face.
  void name_patches()
  {
    std::map<std::pair<LocalIndex, LocalIndex>, LocalIndex> patch_of;
    for (std::size_t f = 0; f < face_cad_.size(); ++f) {
      patch_of.emplace(std::pair(face_cad_[f], own_.mesh.face_patch[f]), kNoIndex);
    }
    mesh_.patch_names.clear();
    mesh_.patch_surface.clear();
    mesh_.patch_row.clear();
    std::map<std::pair<bool, LocalIndex>, LocalIndex> row_of;
    for (auto& [key, patch] : patch_of) {
      const auto& [cad, own] = key;
      const bool is_named = own_.patch_is_named[at(own)] != 0;
      const auto known = std::pair(is_named, is_named ? own_.mesh.patch_row[at(own)] : cad);
      patch = mesh_.num_patches();
      const auto next = static_cast<LocalIndex>(row_of.size());
      mesh_.patch_row.push_back(row_of.emplace(known, next).first->second);
      mesh_.patch_surface.push_back(cad_.patch_surface[at(cad)]);
      mesh_.patch_names.push_back(is_named ? own_.mesh.patch_names[at(own)] : name_of_cad(cad));
    }
    for (std::size_t f = 0; f < face_cad_.size(); ++f) {
      mesh_.face_patch[f] = patch_of.at({face_cad_[f], own_.mesh.face_patch[f]});
    }
  }

  [[nodiscard]] std::string name_of_cad(LocalIndex patch) const
  {
    const std::string& name = cad_.patch_names[at(patch)];
    return name.empty() ? mesh::default_patch_name(cad_.patch_surface[at(patch)]) : name;
  }

  // A material without a name has that of the solid which the CAD has on the same side of a face.
  void name_materials()
  {
    std::vector<char> is_done = own_.material_is_named;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      const auto corners = corners_of(f);
      const Vec3 normal = normal_of(corners);
      const LocalIndex cad = face_cad_[at(f)];
      const bool is_alike = dot(normal, search_.normal(cad, middle_of(corners))) > 0.0;
      const auto& [below, above] = cad_.triangles.patch_materials[at(cad)];
      const auto& [inside, outside] = own_.face_materials[at(f)];
      name_material(inside, is_alike ? below : above, is_done);
      name_material(outside, is_alike ? above : below, is_done);
    }
  }

  void name_material(LocalIndex material, LocalIndex solid, std::vector<char>& is_done)
  {
    if (material <= 0 || solid <= 0 || is_done[at(material - 1)] != 0) return;
    is_done[at(material - 1)] = 1;
    const std::string& name = cad_.solid_names[at(solid - 1)];
    if (!name.empty()) mesh_.material_names[at(material - 1)] = name;
  }

  const OwnMesh& own_;
  const CadSurface& cad_;
  CadSearch search_;
  const std::string& name_;
  mesh::CoarseMesh mesh_;
  std::map<std::array<LocalIndex, 2>, std::vector<LocalIndex>> edges_{};  // Faces of each.
  std::vector<double> shortest_{};  // Boundary edge at each vertex; 0: it is inside.
  std::vector<std::vector<LocalIndex>> patches_of_vertex_{};
  std::vector<LocalIndex> face_cad_{};  // Patch of the CAD of each face.
  std::map<LocalIndex, std::vector<LocalIndex>> curves_of_vertex_{};
};

}  // namespace

double size_for_fit(const mesh::CoarseMesh& mesh)
{
  double sum = 0.0;
  const auto edges = faces_of_edges(mesh.face_vertices);
  for (const auto& [edge, faces] : edges) {
    sum += norm(mesh.position(edge[1]) - mesh.position(edge[0]));
  }
  return 0.5 * sum / static_cast<double>(edges.size());
}

mesh::CoarseMesh fit_to_cad(const OwnMesh& own, const CadSurface& cad,
                            const surface::SurfaceReference& reference, const model::Model& model,
                            const std::string& name)
{
  return Fitter(own, cad, reference, model, name).run();
}

}  // namespace tessera::coarse

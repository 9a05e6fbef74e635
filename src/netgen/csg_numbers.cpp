// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"

#include "netgen/csg_access.hpp"
#include "netgen/csg_cut.hpp"
#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;

// Parts of the box diagonal: rounding of OpenCASCADE's intersections, and their largest tolerance.
constexpr double kOnSurface = 1e-6;
constexpr double kMostOff = 1e-3;
// NETGEN's box is that of triangles for pictures.
constexpr double kMostOffBox = 0.05;
// Points on both sides of a triangle, in parts of its size. In narrow places, and where chords cut
// corners, some are in the wrong solid.
constexpr double kBeside = 1e-3;
constexpr double kLeastShare = 0.9;

constexpr const char* kNotTheSolids = "OpenCASCADE makes other solids of the file than NETGEN";

class Numbering {
 public:
  Numbering(coarse::CoarseSurface surface, const Geometry& geometry, const ::netgen::Box<3>& box)
      : surface_(std::move(surface)), mesh_(surface_.mesh), geometry_(geometry), box_(box)
  {
  }

  coarse::CoarseSurface run()
  {
    require_box();
    find_surfaces();
    number_curves();
    number_solids();
    number_patches();
    separate_patches(mesh_);
    mesh_.face_uv.clear();
    mesh_.segment_t.clear();
    return std::move(surface_);
  }

 private:
  struct Corners {
    Vec3 a{}, b{}, c{};
    [[nodiscard]] Vec3 centre() const { return (1.0 / 3.0) * (a + b + c); }
    [[nodiscard]] Vec3 normal() const { return unit(cross(b - a, c - a)); }
    [[nodiscard]] double size() const { return std::sqrt(triangle_area(a, b, c)); }
  };

  [[nodiscard]] Corners corners(LocalIndex face) const
  {
    const LocalIndex* const v = &mesh_.face_vertices[3 * at(face)];
    return {mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
  }

  void require_box() const
  {
    ::netgen::Box<3> found(::netgen::Box<3>::EMPTY_BOX);
    for (const LocalIndex v : mesh_.face_vertices) found.Add(to_netgen(mesh_.position(v)));
    const double most = kMostOffBox * box_.Diam();
    const bool is_same = ::netgen::Dist(found.PMin(), box_.PMin()) <= most
                         && ::netgen::Dist(found.PMax(), box_.PMax()) <= most;
    if (!is_same) throw NetgenError(kNotTheSolids);
  }

  // Largest distance of corners, and sum of those of centres: three corners of a disc lie on the
  // cylinder around it as well. Of a surface that is too far it is the distance that says so.
  struct Fit {
    double corners = 0.0;
    double centres = 0.0;
  };

  [[nodiscard]] Fit fit_of(const std::vector<LocalIndex>& faces, int surface) const
  {
    Fit fit;
    for (const LocalIndex f : faces) {
      const Corners triangle = corners(f);
      for (const Vec3& p : {triangle.a, triangle.b, triangle.c}) {
        fit.corners = std::max(fit.corners, distance_to(surface, p));
      }
      if (!(fit.corners <= kMostOff * box_.Diam())) return fit;
      fit.centres += distance_to(surface, triangle.centre());
    }
    return fit;
  }

  [[nodiscard]] double distance_to(int surface, const Vec3& point) const
  {
    const double off = netgen::distance(*geometry_.GetSurface(surface), to_netgen(point));
    return std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
  }

  [[nodiscard]] LocalIndex surface_of(const std::vector<LocalIndex>& faces) const
  {
    std::map<LocalIndex, Fit> fits;
    double nearest = std::numeric_limits<double>::infinity();
    for (int s = 0; s < geometry_.GetNSurf(); ++s) {
      if (geometry_.GetSurfaceClassRepresentant(s) != s) continue;
      const Fit& fit = fits[s] = fit_of(faces, s);
      nearest = std::min(nearest, fit.corners);
    }
    if (!(nearest <= kMostOff * box_.Diam())) throw NetgenError(kNotTheSolids);
    const double as_near = std::max(10.0 * nearest, kOnSurface * box_.Diam());
    std::erase_if(fits, [&](const auto& one) { return one.second.corners > as_near; });
    return std::ranges::min_element(fits, {}, [](const auto& one) { return one.second.centres; })
        ->first;
  }

  void find_surfaces()
  {
    std::vector<std::vector<LocalIndex>> faces(at(mesh_.num_patches()));
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      faces[at(mesh_.face_patch[at(f)])].push_back(f);
    }
    std::vector<LocalIndex> of_patch;
    for (const auto& patch : faces) of_patch.push_back(patch.empty() ? 0 : surface_of(patch));
    for (const LocalIndex patch : mesh_.face_patch) face_surface_.push_back(of_patch[at(patch)]);
  }

  using Ends = std::array<LocalIndex, 2>;
  static Ends ends_of(LocalIndex a, LocalIndex b) { return {std::min(a, b), std::max(a, b)}; }

  // Seams go: both sides of them lie on one surface.
  void number_curves()
  {
    std::map<Ends, std::set<LocalIndex>> surfaces;
    for (std::size_t corner = 0; corner < mesh_.face_vertices.size(); ++corner) {
      const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
      surfaces[ends_of(mesh_.face_vertices[corner], mesh_.face_vertices[next])].insert(
          face_surface_[corner / 3]);
    }
    FlatArray<LocalIndex> vertices;
    FlatArray<LocalIndex> curves;
    for (LocalIndex s = 0; s < mesh_.num_segments(); ++s) {
      const Ends ends{mesh_.segment_vertices[2 * at(s)], mesh_.segment_vertices[2 * at(s) + 1]};
      const auto& beside = surfaces[ends_of(ends[0], ends[1])];
      if (beside.size() < 2) continue;
      vertices.insert(vertices.end(), ends.begin(), ends.end());
      curves.push_back(
          curve_of(beside, midpoint(mesh_.position(ends[0]), mesh_.position(ends[1]))));
    }
    mesh_.segment_vertices = std::move(vertices);
    mesh_.segment_curve = std::move(curves);
  }

  // Where more than two surfaces meet, those that cross most steeply.
  [[nodiscard]] LocalIndex curve_of(const std::set<LocalIndex>& surfaces, const Vec3& point) const
  {
    LocalIndex curve = kNoIndex;
    double steepest = -1.0;
    for (auto a = surfaces.begin(); a != surfaces.end(); ++a) {
      for (auto b = std::next(a); b != surfaces.end(); ++b) {
        const double steep = norm(cross(normal_at(*a, point), normal_at(*b, point)));
        if (steep <= steepest) continue;
        steepest = steep;
        curve = *a * static_cast<LocalIndex>(geometry_.GetNSurf()) + *b;
      }
    }
    return curve;
  }

  [[nodiscard]] Vec3 normal_at(LocalIndex surface, const Vec3& point) const
  {
    ::netgen::Vec<3> gradient;
    geometry_.GetSurface(surface)->CalcGradient(to_netgen(point), gradient);
    return unit({gradient(0), gradient(1), gradient(2)});
  }

  // How many points of a domain, or of the outside, are in which solid; the last: in none.
  using Votes = std::vector<std::vector<int>>;

  [[nodiscard]] Votes votes() const
  {
    const auto num_objects = at(geometry_.GetNTopLevelObjects());
    Votes all(at(surface_.num_domains()) + 1, std::vector<int>(num_objects + 1, 0));
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      const Corners triangle = corners(f);
      ::netgen::Point<3> on = to_netgen(triangle.centre());
      geometry_.GetSurface(face_surface_[at(f)])->Project(on);
      const Vec3 step = kBeside * triangle.size() * triangle.normal();
      const auto [out_of, into] = surface_.face_domains[at(f)];
      ++all[at(out_of)][solid_at(from_netgen(on) - step)];
      ++all[at(into)][solid_at(from_netgen(on) + step)];
    }
    return all;
  }

  [[nodiscard]] std::size_t solid_at(const Vec3& point) const
  {
    const double tolerance = std::numeric_limits<double>::epsilon() * box_.Diam();
    const int num_objects = geometry_.GetNTopLevelObjects();
    for (int i = 0; i < num_objects; ++i) {
      const auto* const object = geometry_.GetTopLevelObject(i);
      const bool is_solid = object->GetSurface() == nullptr;
      if (is_solid && object->GetSolid()->IsIn(to_netgen(point), tolerance)) return at(i);
    }
    return at(num_objects);
  }

  void number_solids()
  {
    const Votes all = votes();
    std::set<LocalIndex> found;
    for (std::size_t domain = 0; domain < all.size(); ++domain) {
      const auto most = std::ranges::max_element(all[domain]);
      const int sum = std::accumulate(all[domain].begin(), all[domain].end(), 0);
      const auto solid = static_cast<LocalIndex>(most - all[domain].begin());
      const bool is_outside = solid == geometry_.GetNTopLevelObjects();
      if (sum == 0 || *most < kLeastShare * sum || is_outside != (domain == 0)) {
        throw NetgenError(kNotTheSolids);
      }
      if (domain > 0) take(static_cast<LocalIndex>(domain), solid);
      found.insert(solid);
    }
    mesh_.material_names.clear();
    for (int i = 0; i < geometry_.GetNTopLevelObjects(); ++i) {
      const bool is_solid = geometry_.GetTopLevelObject(i)->GetSurface() == nullptr;
      if (is_solid && !found.contains(i)) throw NetgenError(kNotTheSolids);
      mesh_.material_names.push_back(name_of_solid(geometry_, i));
    }
  }

  void take(LocalIndex domain, LocalIndex solid)
  {
    surface_.domain_material[at(domain - 1)] = solid + 1;
    const ::netgen::TopLevelObject& object = *geometry_.GetTopLevelObject(solid);
    double& max_size = surface_.domain_max_size[at(domain - 1)];
    max_size = std::min({max_size, object.GetMaxH(), object.GetSolid()->GetMaxH()});
  }

  [[nodiscard]] LocalIndex material_of(LocalIndex domain) const
  {
    return domain == 0 ? 0 : surface_.domain_material[at(domain - 1)];
  }

  // A patch is a surface between two solids, or outside of one.
  void number_patches()
  {
    std::map<std::array<LocalIndex, 3>, LocalIndex> patches;
    std::vector<std::array<LocalIndex, 3>> keys;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      const auto [low, high] = std::minmax({material_of(surface_.face_domains[at(f)][0]),
                                            material_of(surface_.face_domains[at(f)][1])});
      keys.push_back({face_surface_[at(f)], low, high});
      patches[keys.back()] = 0;
    }
    mesh_.patch_names.clear();
    mesh_.patch_surface.clear();
    for (auto& [key, patch] : patches) {
      patch = mesh_.num_patches();
      const std::string name = name_unless_default(geometry_.GetSurface(key[0])->GetBCName());
      mesh_.patch_surface.push_back(key[0]);
      mesh_.patch_names.push_back(name.empty() ? default_patch_name(patch) : name);
    }
    for (std::size_t f = 0; f < keys.size(); ++f) mesh_.face_patch[f] = patches[keys[f]];
  }

  coarse::CoarseSurface surface_;
  mesh::CoarseMesh& mesh_;
  const Geometry& geometry_;
  const ::netgen::Box<3>& box_;
  std::vector<LocalIndex> face_surface_{};
};

}  // namespace

coarse::CoarseSurface in_numbers_of_csg(coarse::CoarseSurface surface, const Geometry& geometry,
                                        const ::netgen::Box<3>& box)
{
  return Numbering(std::move(surface), geometry, box).run();
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tessera/surface/on_geometry.hpp"
#include "tessera/surface/overlap.hpp"
#include "tessera/surface/reference.hpp"

#include "cad/error.hpp"
#include "cad/triangles/tessellation.hpp"
#include "geometry/named_surface.hpp"
#include "netgen/csg/access.hpp"
#include "netgen/csg/numbers.hpp"
#include "netgen/csg/triangles.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;

// A CSG model whose surfaces and curves are asked for by patches and curves of its triangles.
class ByTriangles final : public model::Model {
 public:
  ByTriangles(const model::Model& csg, const coarse::CadSurface& cad) : csg_(csg), cad_(cad) {}

  [[nodiscard]] bool has_parameters() const override { return csg_.has_parameters(); }
  [[nodiscard]] double box_diagonal() const override { return csg_.box_diagonal(); }
  [[nodiscard]] double surface_tolerance(LocalIndex patch) const override
  {
    return csg_.surface_tolerance(cad_.patch_surface[at(patch)]);
  }
  [[nodiscard]] double curve_tolerance(LocalIndex curve) const override
  {
    return csg_.curve_tolerance(cad_.curve_number[at(curve)]);
  }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex patch, const Vec3& point, const model::SurfaceParameters& guess) const override
  {
    return csg_.project_to_surface(cad_.patch_surface[at(patch)], point, guess);
  }
  // Where bodies meet on one surface the file knows no curve: the point stays.
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override
  {
    const LocalIndex number = cad_.curve_number[at(curve)];
    if (number == kNoIndex) return {point, 0.0};
    return csg_.project_to_curve(number, point, guess);
  }

 private:
  const model::Model& csg_;
  const coarse::CadSurface& cad_;
};

// Below it, in radians, the angle of two normals is rounding.
constexpr double kLeastTurn = 1e-3;

// Of the largest size, as where curvature is that of triangles: smaller radii are not resolved,
// unless the surface goes round them.
constexpr double kLeastSize = 0.1;

// What the file and the curvature want at each triangle.
class Sizes {
 public:
  Sizes(const CsgTriangles& triangles, const Geometry& geometry,
        const surface::CoarseOptions& options)
      : triangles_(triangles), geometry_(geometry), options_(options)
  {
  }

  [[nodiscard]] std::vector<double> run() const
  {
    const surface::PatchSurface& surface = triangles_.cad.triangles;
    const std::vector<double> of_patch = sizes_of_file();
    std::vector<double> sizes;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const double bent =
          std::max(radius_at(t) / options_.curvature, kLeastSize * options_.max_size);
      sizes.push_back(std::min(bent, of_patch[at(surface.triangle_patch[t])]));
    }
    return sizes;
  }

 private:
  // On the surface of a patch, or in a solid beside it.
  [[nodiscard]] std::vector<double> sizes_of_file() const
  {
    std::vector<double> of_surface(at(geometry_.GetNSurf()), kNoLimit);
    for (int s = 0; s < geometry_.GetNSurf(); ++s) {
      double& size = of_surface[at(geometry_.GetSurfaceClassRepresentant(s))];
      size = std::min(size, geometry_.GetSurface(s)->GetMaxH());
    }
    std::vector<double> sizes;
    for (std::size_t p = 0; p < triangles_.cad.patch_surface.size(); ++p) {
      const auto [below, above] = triangles_.cad.triangles.patch_materials[p];
      const double on_it = of_surface[at(triangles_.cad.patch_surface[p])];
      sizes.push_back(std::min({on_it, size_in(below), size_in(above)}));
    }
    return sizes;
  }

  [[nodiscard]] double size_in(LocalIndex body) const
  {
    if (body == 0) return kNoLimit;
    return max_size_of_solid(geometry_, triangles_.body_object[at(body - 1)]);
  }

  // The smallest one along its edges, by the normals of the file's surface at its corners.
  [[nodiscard]] double radius_at(std::size_t t) const
  {
    const surface::PatchSurface& surface = triangles_.cad.triangles;
    const LocalIndex on = triangles_.cad.patch_surface[at(surface.triangle_patch[t])];
    const std::array<Vec3, 3> corners = surface.corners(t);
    std::array<Vec3, 3> normals{};
    for (std::size_t c = 0; c < 3; ++c) normals[c] = normal_of_surface(geometry_, on, corners[c]);
    double radius = kNoLimit;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      const double turn =
          std::atan2(norm(cross(normals[c], normals[next])), dot(normals[c], normals[next]));
      if (turn > kLeastTurn) radius = std::min(radius, norm(corners[next] - corners[c]) / turn);
    }
    return radius;
  }

  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  const CsgTriangles& triangles_;
  const Geometry& geometry_;
  const surface::CoarseOptions& options_;
};

// The smallest edge that is wanted all over a solid or surface of the file: triangles of
// OpenCASCADE must be nearer to the surfaces than such edges are long.
double least_size_of_file(const Geometry& geometry, double max_size)
{
  double least = max_size;
  for (int s = 0; s < geometry.GetNSurf(); ++s)
    least = std::min(least, geometry.GetSurface(s)->GetMaxH());
  for (int solid = 0; solid < geometry.GetNTopLevelObjects(); ++solid)
    least = std::min(least, max_size_of_solid(geometry, solid));
  return least;
}

// What the case names, in the numbers of the triangles.
surface::CoarseOptions in_numbers_of(const coarse::CadSurface& cad, surface::CoarseOptions options)
{
  const auto patches_on = [&](const std::vector<LocalIndex>& surfaces) {
    std::vector<LocalIndex> patches;
    for (std::size_t p = 0; p < cad.patch_surface.size(); ++p) {
      if (std::ranges::find(surfaces, cad.patch_surface[p]) != surfaces.end())
        patches.push_back(static_cast<LocalIndex>(p));
    }
    return patches;
  };
  surface::KeptParts kept{.patches = patches_on(options.kept.patches)};
  for (surface::PeriodicPatches& side : options.periodic) {
    side.from = patches_on(side.from);
    side.to = patches_on(side.to);
  }
  for (std::size_t c = 0; c < cad.curve_number.size(); ++c) {
    if (options.kept.has_curve(cad.curve_number[c]))
      kept.curves.push_back(static_cast<LocalIndex>(c));
  }
  options.kept = std::move(kept);
  return options;
}

surface::Defeatured in_numbers_of_file(surface::RemeshedSurface remeshed,
                                       const coarse::CadSurface& cad)
{
  surface::Defeatured merged = std::move(remeshed.defeatured);
  merged.patches =
      surface::renumbered(merged.patches, cad.patch_surface, remeshed.surface.triangle_patch);
  merged.curves = surface::renumbered(merged.curves, cad.curve_number, remeshed.surface.edge_curve);
  return merged;
}

}  // namespace

surface::CoarseSurface remesh_csg(const model::Model& csg, const Geometry& geometry,
                                  cad::CadFile solids, const ::netgen::Box<3>& box,
                                  const surface::CoarseOptions& options,
                                  const std::string& file_name)
{
  surface::PatchSurface tessellation = cad::with_occ_errors(file_name, [&] {
    cad::make_closed_solids(solids, {.overlap = model::Overlap::cut});
    return cad::tessellation_of(solids.shape, least_size_of_file(geometry, options.max_size));
  });
  CsgTriangles triangles = triangles_of_csg(std::move(tessellation), geometry, box);
  triangles.cad.triangles.triangle_max_size = Sizes(triangles, geometry, options).run();
  const surface::SurfaceReference reference(triangles.cad.triangles);
  const auto forbidden =
      solids.may_overlap ? surface::Forbidden::all_cuts : surface::Forbidden::cuts_within_bodies;
  surface::RemeshedSurface remeshed = surface::remesh_on_geometry(
      reference, ByTriangles(csg, triangles.cad), in_numbers_of(triangles.cad, options), forbidden);
  const surface::PatchSurface& surface = remeshed.surface;
  const geometry::SurfaceNames names{
      [&](LocalIndex patch) {
        const LocalIndex on = triangles.cad.patch_surface[at(patch)];
        return name_unless_default(geometry.GetSurface(on)->GetBCName());
      },
      [](LocalIndex) { return std::string(); }};
  geometry::require_no_overlaps(surface::forbidden_overlaps(surface, forbidden), surface, names,
                                file_name);
  surface::CoarseSurface coarse = in_numbers_of_csg(surface, triangles, geometry, options.max_size);
  coarse.defeatured = in_numbers_of_file(std::move(remeshed), triangles.cad);
  return coarse;
}

}  // namespace tessera::netgen

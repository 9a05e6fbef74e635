// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/wrap_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/model/winding.hpp"

#include "surface/wrap/caps.hpp"
#include "surface/wrap/corners.hpp"
#include "surface/wrap/lattice.hpp"
#include "surface/wrap/sheets.hpp"

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;

// They take some 200 bytes each, and 10 µs for winding numbers.
constexpr std::size_t kMostCells = 4'000'000;

// Cells that a triangle touches, of its area in squares of their sides.
constexpr double kCellsPerArea = 4.0;

// Where the lattice lies beside the box: faces along the axes must not go through its points.
constexpr Vec3 kOffset{2.37, 2.41, 2.43};

double area_of(const std::vector<Corners>& triangles)
{
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) area += triangle_area(a, b, c);
  return area;
}

[[noreturn]] void refuse_tolerance(double tolerance, double least, const std::string& name)
{
  throw GeometryError(
      fmt::format("{}: geometry.wrap_tolerance of {:.3g} needs a lattice of more than {} million "
                  "cells, in the file's length unit; give at least {:.2g}",
                  name, tolerance, kMostCells / 1'000'000, least));
}

// The least tolerance whose cells fit, rounded up.
double least_tolerance(const std::vector<Corners>& triangles, double diagonal)
{
  const double by_area =
      std::sqrt(kCellsPerArea * area_of(triangles) / static_cast<double>(kMostCells));
  constexpr double kMostPerAxis = 3e5;
  return 1.1 * std::max(by_area, diagonal / kMostPerAxis);
}

LatticeBoundary boundary_of(const std::vector<Corners>& triangles, double tolerance, double least,
                            const std::string& name)
{
  Box box;
  for (const Corners& triangle : triangles) box.include(box_of(triangle));
  const model::WindingNumbers numbers(triangles);
  WrapLattice lattice(
      box.low - tolerance * kOffset, tolerance, [&](const Vec3& p) { return numbers.at(p); },
      kMostCells);
  std::optional<LatticeBoundary> boundary = lattice.boundary(triangles);
  if (!boundary) refuse_tolerance(tolerance, std::max(least, 1.5 * tolerance), name);
  if (boundary->squares.empty()) {
    throw GeometryError(fmt::format(
        "{}: the triangles enclose nothing that a wrap with a tolerance of {:.3g} can hold: they "
        "are sheets, or what they bound is thinner",
        name, tolerance));
  }
  return std::move(*boundary);
}

model::TriangleSoup soup_of(const PatchSurface& surface, const model::TriangleSoup& file)
{
  model::TriangleSoup soup;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (const Vec3& p : surface.corners(t))
      soup.corner_xyz.insert(soup.corner_xyz.end(), p.begin(), p.end());
  }
  soup.triangle_solid.assign(surface.triangles.size(), 0);
  // Several solids of a file have become one surface.
  soup.solid_names = {file.solid_names.size() == 1 ? file.solid_names.front() : std::string()};
  return soup;
}

// Of points of triangles, no farther from each other than about twice the spacing.
double largest_distance(const std::vector<Corners>& from, const FileTriangles& to, double spacing)
{
  double largest = 0.0;
  std::vector<Corners> parts;
  for (const Corners& triangle : from) {
    for (const Vec3& p : triangle) largest = std::max(largest, to.distance(p));
    parts.push_back(triangle);
    while (!parts.empty()) {
      const Corners part = parts.back();
      parts.pop_back();
      largest = std::max(largest, to.distance(middle_of(part)));
      if (longest_side(part) <= 2.0 * spacing) continue;
      const auto& [a, b, c] = part;
      const Vec3 ab = midpoint(a, b);
      const Vec3 bc = midpoint(b, c);
      const Vec3 ca = midpoint(c, a);
      parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
  }
  return largest;
}

std::vector<Corners> corners_of(const PatchSurface& surface)
{
  std::vector<Corners> all;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) all.push_back(surface.corners(t));
  return all;
}

}  // namespace

WrappedSurface wrap_surface(const model::TriangleSoup& soup, double tolerance,
                            const std::string& name)
{
  const double diagonal = box_diagonal(soup.corner_xyz);
  if (!(tolerance > 0.0)) tolerance = kWrapTolerance * diagonal;
  std::vector<Corners> triangles = oriented_triangles(model::welded_surface(soup));
  if (triangles.empty()) throw GeometryError(name + ": holds no triangle with an area");
  const double least = least_tolerance(triangles, diagonal);
  if (tolerance < least) refuse_tolerance(tolerance, least, name);
  const FileTriangles file(std::move(triangles));
  std::vector<Corners> closed = file.triangles;
  std::ranges::copy(hole_caps(file, tolerance), std::back_inserter(closed));
  const LatticeBoundary boundary = boundary_of(closed, tolerance, least, name);
  const FileTriangles target(std::move(closed));
  const PatchSurface sound =
      sound_triangles(boundary, tolerance, corner_places(boundary, tolerance, target), target);
  const PatchSurface surface = flipped_to_file(sound, tolerance, target);
  const std::vector<Corners> wrap = corners_of(surface);
  return {.soup = soup_of(surface, soup),
          .tolerance = tolerance,
          .distance_max = largest_distance(wrap, file, tolerance),
          .file_distance_max = largest_distance(file.triangles, FileTriangles(wrap), tolerance)};
}

}  // namespace tessera::surface

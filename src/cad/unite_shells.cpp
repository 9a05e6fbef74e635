// SPDX-License-Identifier: BSD-3-Clause
#include "cad/unite_shells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/base/single_precision.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/base/union_find.hpp"
#include "tessera/mesh/half_edges.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/model/winding.hpp"
#include "tessera/surface/flat_contacts.hpp"
#include "tessera/surface/overlap.hpp"

#include "cad/error.hpp"
#include "cad/triangles/cells.hpp"
#include "geometry/stl_triangles.hpp"

namespace tessera::cad {
namespace {

using Corners = std::array<Vec3, 3>;
using Contacts = std::vector<std::array<std::size_t, 2>>;

// How far the new surface may be off the old one, in parts of what counts as touching. Both of two
// sheets may be moved.
constexpr double kMostOff = 10.0;
constexpr double kMostOffOnAverage = 4.0;

// A point so far below or above a sheet is on one side of all that touch it.
constexpr double kBeside = 4.0;

// OpenCASCADE parts space by 1,500 triangles in half a second. Above these it may take minutes.
constexpr LocalIndex kMostTriangles = 20000;

Corners corners_of(const model::TriangleSoup& soup, std::size_t t)
{
  const auto corner = [&](std::size_t c) {
    return point_at(std::span(soup.corner_xyz), 3 * t + c);
  };
  return {corner(0), corner(1), corner(2)};
}

std::vector<Corners> corners_of(const model::TriangleSoup& soup)
{
  std::vector<Corners> all;
  for (std::size_t t = 0; t < soup.triangle_solid.size(); ++t) all.push_back(corners_of(soup, t));
  return all;
}

std::vector<Corners> corners_of(const model::TriangleSurface& surface)
{
  std::vector<Corners> all;
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) all.push_back(surface.corners(t));
  return all;
}

// Of what the triangles enclose; the origin is near, as sums of large volumes are inexact.
double volume_of(const std::vector<Corners>& triangles, const Vec3& origin)
{
  double volume = 0.0;
  for (const auto& [a, b, c] : triangles) volume += tet_volume(origin, a, b, c);
  return volume;
}

// The given surface as bodies of their own and cavities.
class Bodies {
 public:
  Bodies(const model::TriangleSurface& surface, const Contacts& contacts,
         const model::TriangleSoup& file)
      : surface_(surface), shells_(surface.num_triangles()), origin_(surface.position(0))
  {
    // By edges: shells may share a vertex.
    const auto opposite =
        mesh::opposite_half_edges(mesh::half_edges_of_edges(surface.triangle_vertices));
    for (std::size_t h = 0; h < opposite.size(); ++h) {
      shells_.join(static_cast<LocalIndex>(h / 3), opposite[h] / 3);
    }
    for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
      const auto [a, b, c] = surface.corners(t);
      volume_[shell(t)] += tet_volume(origin_, a, b, c);
      area_ += triangle_area(a, b, c);
    }
    // Which of two that touch lies in the other is noise, so that their sides may be wrong. The
    // file says which they are.
    for (const auto& [first, second] : contacts) {
      const std::array shells{shell(static_cast<LocalIndex>(first)),
                              shell(static_cast<LocalIndex>(second))};
      if (shells[0] != shells[1]) touching_.insert(shells.begin(), shells.end());
    }
    if (!touching_.empty()) measure(file);
  }

  // Whether it is known what the file says of each shell that touches another.
  [[nodiscard]] bool are_known() const { return are_known_; }

  // Whatever the file says.
  void take_all_for_bodies() { has_cavities_ = false; }

  // How many bodies hold a point, less the cavities that do; nothing if it is too near to say.
  [[nodiscard]] std::optional<int> winding(const Vec3& point)
  {
    constexpr double kClear = 0.1;
    double angle = 0.0;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      angle += sign(shell(t)) * model::solid_angle(surface_.corners(t), point);
    }
    const double number = angle / (4.0 * std::numbers::pi);
    if (std::abs(number - std::round(number)) > kClear) return std::nullopt;
    return static_cast<int>(std::lround(number));
  }

  // What is in several bodies counts as often.
  [[nodiscard]] double volume() const
  {
    double sum = 0.0;
    for (const auto& [shell, volume] : volume_) sum += sign(shell) * volume;
    return sum;
  }

  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] std::size_t num_shells() const { return volume_.size(); }

 private:
  [[nodiscard]] LocalIndex shell(LocalIndex t) { return shells_.find(t); }

  // Volumes with the normals of the file. Without all of its triangles a shell has none.
  void measure(const model::TriangleSoup& file)
  {
    std::map<LocalIndex, LocalIndex> num_missing;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) ++num_missing[shell(t)];
    std::map<Corners, LocalIndex> triangles;  // Corners ascending.
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      Corners p = surface_.corners(t);
      std::ranges::sort(p);
      triangles[p] = t;
    }
    for (std::size_t t = 0; t < file.triangle_solid.size(); ++t) {
      Corners p = corners_of(file, t);
      const double volume = tet_volume(origin_, p[0], p[1], p[2]);
      std::ranges::sort(p);
      const auto found = triangles.find(p);
      if (found == triangles.end()) continue;  // It was mended.
      file_volume_[shell(found->second)] += volume;
      whole_file_volume_ += volume;
      --num_missing[shell(found->second)];
    }
    are_known_ = std::ranges::all_of(touching_, [&](LocalIndex s) { return num_missing[s] == 0; });
  }

  // For most files all normals look out; for some, in.
  [[nodiscard]] double sign(LocalIndex shell) const
  {
    const auto in_file = file_volume_.find(shell);
    if (!touching_.contains(shell) || in_file == file_volume_.end()) return 1.0;
    const bool is_cavity = has_cavities_ && in_file->second * whole_file_volume_ < 0.0;
    return is_cavity == (volume_.at(shell) < 0.0) ? 1.0 : -1.0;
  }

  const model::TriangleSurface& surface_;
  UnionFind shells_;
  Vec3 origin_;
  std::map<LocalIndex, double> volume_{};
  std::set<LocalIndex> touching_{};
  std::map<LocalIndex, double> file_volume_{};
  double whole_file_volume_ = 0.0;
  bool has_cavities_ = true;
  bool are_known_ = true;
  double area_ = 0.0;
};

// A point of a cell, below the middle of its largest triangle and off all others by more than they
// are uncertain; nothing if the cell is a film.
std::optional<Vec3> point_inside(const std::vector<Corners>& skin, double volume, double tolerance)
{
  double area = 0.0;
  const Corners* largest = &skin.front();
  for (const Corners& p : skin) {
    area += triangle_area(p);
    if (triangle_area(p) > triangle_area(*largest)) largest = &p;
  }
  const double below = 0.5 * std::min(0.1 * std::sqrt(triangle_area(*largest)), volume / area);
  if (!(below > 2.0 * tolerance)) return std::nullopt;
  const Vec3 normal = normal_of(*largest);
  return middle_of(*largest) - (below / norm(normal)) * normal;
}

void add_triangle(const Corners& corners, model::TriangleSoup& soup)
{
  for (const Vec3& p : corners) {
    soup.corner_xyz.insert(soup.corner_xyz.end(), p.begin(), p.end());
  }
  soup.triangle_solid.push_back(0);
}

// How many bodies hold each cell; nothing if it is not sure.
std::vector<int> windings_of(const Cells& cells, Bodies& bodies, double tolerance)
{
  double volume = 0.0;
  std::vector<int> windings;
  for (std::size_t cell = 0; cell < cells.sides.size(); ++cell) {
    const std::vector<Corners> skin = skin_of(cells, cell);
    const double of_cell = volume_of(skin, bodies.origin());
    windings.push_back(0);
    if (of_cell < 0.0) continue;  // All that is outside, which OpenCASCADE mostly leaves out.
    const auto point = point_inside(skin, of_cell, tolerance);
    const auto winding = point ? bodies.winding(*point) : std::nullopt;
    if (!winding) return {};
    volume += *winding * of_cell;
    windings.back() = *winding;
  }
  const double most_off = kMostOffOnAverage * tolerance * bodies.area();
  return std::abs(volume - bodies.volume()) <= most_off ? windings : std::vector<int>{};
}

// The cells' triangles between material and none; no triangles if it is not sure what is what.
model::TriangleSoup outside_of(const Cells& cells, Bodies& bodies, double tolerance)
{
  std::vector<int> windings = windings_of(cells, bodies, tolerance);
  // A cavity in nothing is a body with its inside out.
  if (std::ranges::any_of(windings, [](int number) { return number < 0; })) {
    bodies.take_all_for_bodies();
    windings = windings_of(cells, bodies, tolerance);
  }
  if (windings.empty()) return {};
  model::TriangleSoup soup;
  std::vector<int> num_materials(cells.face_triangles.size());
  for (std::size_t cell = 0; cell < cells.sides.size(); ++cell) {
    for (const auto& [face, is_turned] : cells.sides[cell])
      num_materials[face] += windings[cell] > 0 ? 1 : 0;
  }
  for (std::size_t cell = 0; cell < cells.sides.size(); ++cell) {
    if (windings[cell] <= 0) continue;
    for (const CellSide& side : cells.sides[cell]) {
      if (num_materials[side.face] != 1) continue;
      for (const Corners& corners : triangles_of(cells, side)) add_triangle(corners, soup);
    }
  }
  return soup;
}

model::TriangleSearch search_in(const model::TriangleSurface& surface)
{
  return model::TriangleSearch(corners_of(surface));
}

bool is_near(const model::TriangleSurface& surface, const model::TriangleSurface& to, double most)
{
  const model::TriangleSearch search = search_in(to);
  const auto is_on = [&](const Vec3& p) { return norm(search.nearest(p).xyz - p) <= most; };
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    const Corners corners = surface.corners(t);
    if (!std::ranges::all_of(corners, is_on) || !is_on(middle_of(corners))) return false;
  }
  return true;
}

// So many solid angles take some ten seconds.
constexpr GlobalIndex kMostAngles = 200'000'000;

// A given triangle that is not part of `made` has material on both sides or on none.
bool is_all_there(const model::TriangleSurface& given, Bodies& bodies,
                  const model::TriangleSurface& made, double tolerance)
{
  const model::TriangleSearch search = search_in(made);
  GlobalIndex num_angles = 0;
  for (LocalIndex t = 0; t < given.num_triangles(); ++t) {
    const Corners corners = given.corners(t);
    const Vec3 middle = middle_of(corners);
    if (norm(search.nearest(middle).xyz - middle) <= kMostOff * tolerance) continue;
    const Vec3 normal = normal_of(corners);
    if (norm(normal) == 0.0) continue;
    num_angles += 2 * GlobalIndex{given.num_triangles()};
    if (num_angles > kMostAngles) return false;
    const Vec3 off = (kBeside * tolerance / norm(normal)) * normal;
    const auto below = bodies.winding(middle - off);
    const auto above = bodies.winding(middle + off);
    if (below && above && (*below > 0) != (*above > 0)) return false;
  }
  return true;
}

// Several solids of one body name its sides.
bool has_several_solids(const model::TriangleSurface& surface)
{
  const auto& of = surface.triangle_solid;
  return std::ranges::adjacent_find(of, std::not_equal_to<>()) != of.end();
}

std::optional<model::CheckedSurface> united(const model::TriangleSurface& surface, Bodies& bodies,
                                            const std::string& name)
{
  if (!bodies.are_known()) return std::nullopt;
  const double tolerance = kSinglePrecisionNoise * model::box_diagonal(surface);
  model::TriangleSoup soup = with_occ_errors(
      name, [&] { return outside_of(cells_of(surface, tolerance), bodies, tolerance); });
  if (soup.num_triangles() == 0) return std::nullopt;
  const double volume = volume_of(corners_of(soup), bodies.origin());
  soup.solid_names = {surface.solid_names[at(surface.triangle_solid.front())]};
  model::CheckedSurface made = model::check_surface(soup, name);
  const surface::PatchSurface triangles = geometry::triangles_of(made.surface);
  if (!find_flat_contacts(triangles, tolerance).empty()) return std::nullopt;
  if (!find_overlaps(triangles).empty()) return std::nullopt;
  const double most_off = kMostOffOnAverage * tolerance * bodies.area();
  if (std::abs(volume_of(corners_of(made.surface), bodies.origin()) - volume) > most_off)
    return std::nullopt;
  if (!is_near(made.surface, surface, kMostOff * tolerance)) return std::nullopt;
  if (!is_all_there(surface, bodies, made.surface, tolerance)) return std::nullopt;
  made.repairs.insert(made.repairs.begin(),
                      fmt::format("surfaces that lie flat on each other joined: {} shells given",
                                  bodies.num_shells()));
  return made;
}

}  // namespace

void unite_flat_contacts(const model::TriangleSoup& soup, model::CheckedSurface& checked,
                         const std::string& name)
{
  const model::TriangleSurface& surface = checked.surface;
  if (surface.num_triangles() > kMostTriangles || has_several_solids(surface)
      || is_left_out(Repair::flat_contacts)) {
    return;
  }
  const Contacts contacts = find_flat_contacts(
      geometry::triangles_of(surface), kSinglePrecisionNoise * model::box_diagonal(surface));
  if (contacts.empty()) return;
  std::optional<model::CheckedSurface> made;
  try {
    Bodies bodies(surface, contacts, soup);
    made = united(surface, bodies, name);
  } catch (const GeometryError& error) {  // The file's surface is the better one then.
    note_given_up("one surface of those that lie flat on each other", error);
  }
  if (made) {
    checked.surface = std::move(made->surface);
    checked.repairs.insert(checked.repairs.end(), made->repairs.begin(), made->repairs.end());
    checked.counted_repairs += made->counted_repairs;
    checked.counted_repairs.add(Repair::flat_contacts, static_cast<GlobalIndex>(contacts.size()));
  } else {
    checked.repairs.emplace_back(fmt::format(
        "surfaces lie flat on each other at {} pairs of triangles, and could not be joined",
        contacts.size()));
  }
}

}  // namespace tessera::cad

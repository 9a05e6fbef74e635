// SPDX-License-Identifier: BSD-3-Clause
#include "surface/wrap/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "tessera/base/triangle.hpp"
#include "tessera/mesh/half_edges.hpp"
#include "tessera/model/winding.hpp"

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;

// So many sheets are asked of the others; more, as of a file whose triangles are all loose, would
// take a tree of winding numbers each.
constexpr std::size_t kMostAsked = 64;
constexpr std::size_t kMostSamples = 64;  // Of a sheet.

// Beside a sheet: in parts of the square root of its area.
constexpr double kBeside = 0.25;
// A fall of the winding number that is no accident; a hole in a ball has 0.3 and more.
constexpr double kClearFall = 0.05;
// Of a sheet's area to the power 3/2: how much it must be bent. Half a ball has 0.07.
constexpr double kClearlyBent = 0.01;

struct Sheet {
  std::vector<Corners> triangles{};
  double area = 0.0;
  bool is_closed = true;
};

void turn(Sheet& sheet)
{
  for (Corners& p : sheet.triangles) std::swap(p[1], p[2]);
}

// Walks over edges that two triangles share.
class SheetWalk {
 public:
  explicit SheetWalk(const model::TriangleSurface& surface)
      : surface_(surface),
        other_(surface.triangle_vertices.size(), kNoIndex),
        is_reached_(at(surface.num_triangles())),
        is_turned_(at(surface.num_triangles()))
  {
    const IndexLists edges = mesh::half_edges_of_edges(surface.triangle_vertices);
    for (LocalIndex e = 0; e < edges.num_lists(); ++e) {
      if (edges[e].size() != 2) continue;
      other_[at(edges[e][0])] = edges[e][1];
      other_[at(edges[e][1])] = edges[e][0];
    }
  }

  std::vector<Sheet> walk()
  {
    std::vector<Sheet> sheets;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (is_reached_[at(t)] == 0) sheets.push_back(walk_from(t));
    }
    return sheets;
  }

 private:
  Sheet walk_from(LocalIndex start)
  {
    std::vector<LocalIndex> reached{start};
    is_reached_[at(start)] = 1;
    Sheet sheet;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const LocalIndex t = reached[i];
      for (LocalIndex h = 3 * t; h < 3 * t + 3; ++h) {
        const LocalIndex opposite = other_[at(h)];
        if (opposite == kNoIndex) sheet.is_closed = false;
        if (opposite == kNoIndex || is_reached_[at(opposite / 3)] != 0) continue;
        is_reached_[at(opposite / 3)] = 1;
        const bool runs_alike =
            surface_.triangle_vertices[at(h)] == surface_.triangle_vertices[at(opposite)];
        is_turned_[at(opposite / 3)] = static_cast<char>((is_turned_[at(t)] != 0) != runs_alike);
        reached.push_back(opposite / 3);
      }
    }
    fill(sheet, reached);
    return sheet;
  }

  void fill(Sheet& sheet, const std::vector<LocalIndex>& triangles)
  {
    double turned_area = 0.0;
    for (const LocalIndex t : triangles) {
      Corners p = surface_.corners(t);
      const double area = triangle_area(p);
      sheet.area += area;
      if (is_turned_[at(t)] != 0) {
        turned_area += area;
        std::swap(p[1], p[2]);
      }
      sheet.triangles.push_back(p);
    }
    if (2.0 * turned_area > sheet.area) turn(sheet);
  }

  const model::TriangleSurface& surface_;
  std::vector<LocalIndex> other_;  // The other half-edge of an edge with two.
  std::vector<char> is_reached_;
  std::vector<char> is_turned_;
};

// Of the cone of a sheet and its middle: the enclosed volume if it is closed.
double bent_volume(const Sheet& sheet)
{
  Vec3 middle{};
  for (const Corners& p : sheet.triangles)
    middle = middle + (triangle_area(p) / (3.0 * sheet.area)) * (p[0] + p[1] + p[2]);
  double volume = 0.0;
  for (const Corners& p : sheet.triangles) volume += tet_volume(middle, p[0], p[1], p[2]);
  return volume;
}

// How far the winding number of others falls from the back of a sheet to its front, on average by
// area, and what it is there.
std::array<double, 2> fall_and_level(const Sheet& sheet, const model::WindingNumbers& others)
{
  const std::size_t step = (sheet.triangles.size() + kMostSamples - 1) / kMostSamples;
  const double beside = kBeside * std::sqrt(sheet.area);
  double area = 0.0;
  double fall = 0.0;
  double level = 0.0;
  for (std::size_t t = 0; t < sheet.triangles.size(); t += step) {
    const Corners& p = sheet.triangles[t];
    const Vec3 middle = middle_of(p);
    const Vec3 off = beside * unit_normal_of(p);
    const double weight = triangle_area(p);
    area += weight;
    fall += weight * (others.at(middle - off) - others.at(middle + off));
    level += weight * others.at(middle);
  }
  if (area == 0.0) return {};
  return {fall / area, level / area};
}

bool must_turn(const Sheet& sheet, const model::WindingNumbers* others)
{
  const double volume = bent_volume(sheet);
  const auto [fall, level] =
      others == nullptr ? std::array{0.0, 0.0} : fall_and_level(sheet, *others);
  // In another body it is a cavity or a body, as the file says.
  if (sheet.is_closed) return level < 0.5 && volume < 0.0;
  if (std::abs(fall) > kClearFall) return fall < 0.0;
  return volume < -kClearlyBent * sheet.area * std::sqrt(sheet.area);
}

}  // namespace

std::vector<Corners> oriented_triangles(const model::TriangleSurface& surface)
{
  std::vector<Sheet> sheets = SheetWalk(surface).walk();
  std::ranges::stable_sort(sheets, [](const Sheet& a, const Sheet& b) { return a.area > b.area; });
  std::vector<Corners> all;
  std::optional<model::WindingNumbers> before;  // Of the sheets before.
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    Sheet& sheet = sheets[s];
    if (sheet.area > 0.0 && must_turn(sheet, before ? &*before : nullptr)) turn(sheet);
    all.insert(all.end(), sheet.triangles.begin(), sheet.triangles.end());
    if (s + 1 < std::min(kMostAsked, sheets.size())) before.emplace(all);
  }
  return all;
}

}  // namespace tessera::surface

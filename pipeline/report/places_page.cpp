// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/places_page.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/model/description.hpp"

#include "pipeline/drawing/model_picture.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/viewer/view_page.hpp"

namespace tessera::pipeline {
namespace {

using surface::kNumPlaceKinds;
using surface::Place;
using surface::PlaceKind;
using surface::SurfacePlaces;
using Json = nlohmann::ordered_json;

constexpr std::array kKinds{PlaceKind::open_edge, PlaceKind::crowded_edge, PlaceKind::crossing};
static_assert(kKinds.size() == kNumPlaceKinds);

// Rows of a picture and a view: 0 is what is sound.
std::size_t row_of(PlaceKind kind) { return 1 + static_cast<std::size_t>(kind); }

std::size_t row_of_triangle(const SurfacePlaces& places, std::size_t triangle)
{
  for (const PlaceKind kind : kKinds) {
    const std::size_t entry = kNumPlaceKinds * triangle + static_cast<std::size_t>(kind);
    if (places.triangle_counts[entry] > 0) return row_of(kind);
  }
  return 0;
}

std::vector<std::string> row_names()
{
  std::vector<std::string> names{"triangles without such a place"};
  for (const PlaceKind kind : kKinds) names.push_back(surface::words_of(kind));
  return names;
}

// At most so many of each kind, spread over all of them.
std::vector<Place> some_places(const SurfacePlaces& places, std::size_t most)
{
  std::vector<Place> some;
  for (const PlaceKind kind : kKinds) {
    std::vector<Place> of_kind;
    std::ranges::copy_if(places.places, std::back_inserter(of_kind),
                         [&](const Place& place) { return place.kind == kind; });
    const std::size_t step = std::max<std::size_t>(1, (of_kind.size() + most - 1) / most);
    for (std::size_t i = 0; i < of_kind.size(); i += step) some.push_back(of_kind[i]);
  }
  return some;
}

// An octahedron.
void add_mark(const Vec3& middle, double radius, std::size_t row, model::ModelDescription& to)
{
  constexpr std::array<std::array<LocalIndex, 3>, 8> kTriangles{
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  const auto first = static_cast<LocalIndex>(to.vertex_xyz.size() / 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      Vec3 p = middle;
      p[axis] += side * radius;
      to.vertex_xyz.insert(to.vertex_xyz.end(), p.begin(), p.end());
    }
  }
  for (const auto& triangle : kTriangles) {
    for (const LocalIndex v : triangle) to.triangle_vertices.push_back(first + v);
    to.triangle_face.push_back(static_cast<LocalIndex>(row));
  }
}

std::string point_text(const Vec3& p) { return fmt::format("({:.6g})", fmt::join(p, ", ")); }

Json faces_json()
{
  Json faces = Json::array();
  for (const std::string& name : row_names())
    faces.push_back({{"name", name}, {"numbers", Json::array({faces.size() + 1})}});
  return faces;
}

Json marks_json(const SurfacePlaces& places)
{
  constexpr std::size_t kMostButtons = 10;  // Of each kind.
  Json marks = Json::array();
  for (const Place& place : some_places(places, kMostButtons)) {
    marks.push_back({{"centre", place.middle()},
                     {"title", fmt::format("one of the {}", surface::words_of(place.kind))}});
  }
  return marks;
}

SurfaceView view_of(const SurfacePlaces& places)
{
  Surface surface{.point_xyz = places.vertex_xyz, .corners = places.triangle_vertices};
  for (std::size_t t = 0; t < places.num_triangles(); ++t)
    surface.cells["face"].push_back(static_cast<std::uint32_t>(row_of_triangle(places, t)));
  return {.surface = std::move(surface),
          .description = {
              {"kind", "places"},
              {"unit", ""},
              {"faces", faces_json()},
              {"worst", marks_json(places)},
              {"worst_label", "Places"},
              {"colourings", {{{"array", "face"}, {"label", "place"}, {"names", row_names()}}}}}};
}

std::string picture_html(const SurfacePlaces& places)
{
  std::string legend;
  for (const std::string& name : row_names()) legend += "<li>" + escaped(name) + "</li>\n";
  return fmt::format(
      "<img alt=\"The file from two sides\" style=\"max-width:100%\" "
      "src=\"data:image/png;base64,{}\">\n<ol>{}</ol>\n",
      base64(to_png(places_picture(places))), legend);
}

std::string table_of(const SurfacePlaces& places)
{
  constexpr std::size_t kMostRows = 50;  // Of each kind.
  std::vector<std::vector<std::string>> rows;
  for (const Place& place : some_places(places, kMostRows)) {
    rows.push_back({escaped(surface::words_of(place.kind)), point_text(place.from),
                    place.kind == PlaceKind::crossing ? "" : point_text(place.to)});
  }
  return table_html({"place", "from", "to"}, rows);
}

}  // namespace

std::string places_text(const SurfacePlaces& places)
{
  std::string text;
  for (const PlaceKind kind : kKinds) {
    const std::size_t count = places.count(kind);
    if (count == 0) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", surface::words_of(kind), count);
  }
  return text;
}

mesh::MeshArrays places_arrays(const SurfacePlaces& places)
{
  constexpr std::array kNames{"open_edges", "crowded_edges", "crossings"};
  static_assert(kNames.size() == kNumPlaceKinds);
  mesh::MeshArrays arrays{.vertices_per_cell = 3,
                          .point_xyz = places.vertex_xyz,
                          .cell_points = places.triangle_vertices};
  for (std::size_t k = 0; k < kNumPlaceKinds; ++k) {
    std::vector<std::int32_t>& counts = arrays.cell_ints[kNames[k]];
    for (std::size_t t = 0; t < places.num_triangles(); ++t)
      counts.push_back(places.triangle_counts[kNumPlaceKinds * t + k]);
  }
  return arrays;
}

Picture places_picture(const SurfacePlaces& places)
{
  constexpr std::size_t kMostMarks = 100;  // Of each kind.
  constexpr double kRadius = 0.008;        // Of the diagonal.
  model::ModelDescription drawn{.vertex_xyz = places.vertex_xyz,
                                .triangle_vertices = places.triangle_vertices};
  for (std::size_t row = 0; row <= kNumPlaceKinds; ++row)
    drawn.faces.push_back({.number = static_cast<LocalIndex>(row) + 1});
  for (std::size_t t = 0; t < places.num_triangles(); ++t)
    drawn.triangle_face.push_back(static_cast<LocalIndex>(row_of_triangle(places, t)));
  const double radius = kRadius * box_diagonal(places.vertex_xyz);
  for (const Place& place : some_places(places, kMostMarks))
    add_mark(place.middle(), radius, row_of(place.kind), drawn);
  return draw_model(drawn);
}

std::string places_page(const std::filesystem::path& file, const std::string& message,
                        const SurfacePlaces& places)
{
  std::string body = fmt::format(
      "<header><h1>{}</h1><p class=\"soft\">An STL file whose triangles bound no "
      "body</p></header>\n",
      escaped(file.string()));
  body += section_html("Why it is refused", "<p>" + escaped(message) + "</p>\n");
  body += section_html("Where", picture_html(places));
  body += section_html("To turn and to point at", view_html(view_of(places)));
  body +=
      section_html("Places", "<p>" + escaped(places_text(places)) + "</p>\n" + table_of(places));
  return page_html("Tessera: " + file.string(), body);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/model_page.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/commands/model_info.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/viewer/view_page.hpp"

namespace tessera::pipeline {
namespace {

using Json = nlohmann::ordered_json;

// Of each face, over its edges.
struct Surroundings {
  std::vector<double> perimeter{};
  std::vector<std::set<LocalIndex>> touches{};  // Rows of faces.
};

Surroundings surroundings_of(const model::ModelDescription& model)
{
  Surroundings around;
  around.perimeter.resize(model.faces.size());
  around.touches.resize(model.faces.size());
  for (const model::EdgeDescription& edge : model.edges) {
    for (const LocalIndex face : edge.faces) {
      around.perimeter[at(face)] += edge.length;
      for (const LocalIndex other : edge.faces) {
        if (other != face) around.touches[at(face)].insert(other);
      }
    }
  }
  return around;
}

// A strip is as wide as its area over half its perimeter; what has no edges is narrow nowhere.
double width_of(const model::FaceDescription& face, double perimeter)
{
  return perimeter > 0.0 ? 2.0 * face.area / perimeter : std::sqrt(face.area);
}

Json faces_json(const model::ModelDescription& model)
{
  const Surroundings around = surroundings_of(model);
  Json faces = Json::array();
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const model::FaceDescription& face = model.faces[f];
    faces.push_back({{"name", face.name},
                     {"numbers", {face.number}},
                     {"area", face.area},
                     {"width", width_of(face, around.perimeter[f])},
                     {"solids", face.solids},
                     {"touches", around.touches[f]}});
  }
  return faces;
}

Json edges_json(const model::ModelDescription& model)
{
  Json edges = Json::array();
  for (const model::EdgeDescription& edge : model.edges) {
    edges.push_back({{"number", edge.number},
                     {"name", edge.name},
                     {"length", edge.length},
                     {"faces", edge.faces},
                     {"num_lines", edge.line_xyz.size() / 6}});
  }
  return edges;
}

Json solids_json(const model::ModelDescription& model)
{
  Json solids = Json::array();
  for (const model::SolidDescription& solid : model.solids) {
    solids.push_back({{"name", solid.name}, {"volume", solid.volume}});
  }
  return solids;
}

// What the slider of sizes needs: its ends and where it begins, and how sizes make tets.
Json sizes_json(const model::ModelDescription& model)
{
  constexpr double kFewest = 2e3;
  constexpr double kMost = 2e8;
  constexpr double kAtFirst = 2e5;
  const Extent extent = extent_of(model);
  const TetsOfSize tets = tets_of_size();
  return {{"volume", extent.volume},
          {"area", extent.area},
          {"per_cube", tets.per_cube},
          {"per_thinness", tets.per_thinness},
          {"low", size_for(extent, kMost)},
          {"high", size_for(extent, kFewest)},
          {"at_first", rounded_size(size_for(extent, kAtFirst))}};
}

// Colours of the file, each once.
struct FileColours {
  std::vector<std::string> names{};
  std::vector<std::uint32_t> of_face{};
};

FileColours colours_of(const model::ModelDescription& model)
{
  constexpr const char* kNone = "#b4b9be";
  FileColours colours;
  std::map<std::string, std::uint32_t> rows;
  for (const model::FaceDescription& face : model.faces) {
    const std::string colour = face.colour.empty() ? kNone : face.colour;
    const auto [place, is_new] =
        rows.emplace(colour, static_cast<std::uint32_t>(colours.names.size()));
    if (is_new) colours.names.push_back(colour);
    colours.of_face.push_back(place->second);
  }
  return colours;
}

std::vector<std::string> names_of_faces(const model::ModelDescription& model)
{
  std::vector<std::string> names;
  for (const model::FaceDescription& face : model.faces) {
    names.push_back(face.name.empty() ? fmt::format("face {}", face.number)
                                      : fmt::format("{}: {}", face.number, face.name));
  }
  return names;
}

std::vector<std::string> names_of_solids(const model::ModelDescription& model)
{
  std::vector<std::string> names;
  for (const model::SolidDescription& solid : model.solids) {
    names.push_back(solid.name.empty() ? fmt::format("solid {}", names.size() + 1) : solid.name);
  }
  return names;
}

Json colourings_json(const model::ModelDescription& model, const FileColours& colours)
{
  Json colourings = {{{"array", "face"}, {"label", "face"}, {"names", names_of_faces(model)}},
                     {{"array", "solid"}, {"label", "solid"}, {"names", names_of_solids(model)}}};
  if (colours.names.size() > 1) {
    colourings.push_back({{"array", "colour"},
                          {"label", "colour in the file"},
                          {"names", colours.names},
                          {"colours", colours.names}});
  }
  return colourings;
}

Surface surface_of(const model::ModelDescription& model, const FileColours& colours)
{
  Surface surface{.point_xyz = model.vertex_xyz, .corners = model.triangle_vertices};
  for (const LocalIndex face : model.triangle_face) {
    const std::vector<LocalIndex>& solids = model.faces[at(face)].solids;
    surface.cells["face"].push_back(static_cast<std::uint32_t>(face));
    surface.cells["solid"].push_back(
        solids.empty() ? 0 : static_cast<std::uint32_t>(solids.front() - 1));
    surface.cells["colour"].push_back(colours.of_face[at(face)]);
  }
  for (const model::EdgeDescription& edge : model.edges) {
    surface.line_xyz.insert(surface.line_xyz.end(), edge.line_xyz.begin(), edge.line_xyz.end());
  }
  return surface;
}

SurfaceView model_view(const model::ModelSource& source, const model::ModelDescription& model)
{
  const FileColours colours = colours_of(model);
  return {.surface = surface_of(model, colours),
          .description = {{"kind", "model"},
                          {"file", std::filesystem::path(source.file_name).filename().string()},
                          {"unit", source.length_unit},
                          {"faces", faces_json(model)},
                          {"edges", edges_json(model)},
                          {"solids", solids_json(model)},
                          {"sizes", sizes_json(model)},
                          {"colourings", colourings_json(model, colours)}}};
}

std::string card(const std::string& name, const std::string& value)
{
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

std::string cards_html(const model::ModelSource& source, const model::ModelDescription& model)
{
  const Extent extent = extent_of(model);
  const std::string& unit = source.length_unit;
  const auto count = [](std::size_t number) { return grouped(static_cast<GlobalIndex>(number)); };
  std::string html = "<dl class=\"cards\">\n";
  html += card("solids", count(model.solids.size())) + card("faces", count(model.faces.size()))
          + card("edges", count(model.edges.size()));
  html +=
      card("volume", fmt::format("{:.6g}{}", extent.volume, unit.empty() ? "" : " " + unit + "³"));
  html += card("area", fmt::format("{:.6g}{}", extent.area, unit.empty() ? "" : " " + unit + "²"));
  return html + card("length unit", unit.empty() ? "the file does not say" : unit) + "</dl>\n";
}

}  // namespace

std::string model_page(const model::ModelSource& source, const model::ModelDescription& model)
{
  std::string body = fmt::format(
      "<header><h1>{}</h1><p class=\"soft\">A CAD model, before it is meshed</p></header>\n",
      escaped(source.file_name));
  body += section_html("To turn and to point at", view_html(model_view(source, model)));
  body += section_html("What it holds", cards_html(source, model));
  body += section_html("Repairs when it was read", notes_html(source.repairs));
  return page_html("Tessera: " + source.file_name, body);
}

}  // namespace tessera::pipeline

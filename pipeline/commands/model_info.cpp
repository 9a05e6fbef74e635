// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/model_info.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tessera/base/box.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/part_names.hpp"

#include "pipeline/report/json/assembly_json.hpp"

namespace tessera::pipeline {
namespace {

using Json = nlohmann::ordered_json;

// Of the tets of 15 models with 10^4 to 3 10^5 of them, made by all kernels, all are within a
// factor of two, half within 1.3. Where walls are a few edges thick, small faces and curvature make
// more.
constexpr double kTetsPerCube = 7.0;
constexpr double kTetsPerThinness = 14.0;  // Times area h / volume, squared.

// Of the triangles: of the whole model, and face by face.
struct Boxes {
  Box model{};
  std::vector<Box> faces{};
};

Boxes boxes_of(const model::ModelDescription& description)
{
  Boxes boxes;
  boxes.faces.resize(description.faces.size());
  for (std::size_t t = 0; t < description.triangle_face.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p =
          point_at(std::span(description.vertex_xyz), description.triangle_vertices[3 * t + c]);
      boxes.model.include(p);
      boxes.faces[static_cast<std::size_t>(description.triangle_face[t])].include(p);
    }
  }
  return boxes;
}

// The normal of each face that is flat.
std::vector<std::optional<Vec3>> normals_of(const model::ModelDescription& description)
{
  constexpr double kFlat = 1e-6;  // Lengths of differences of unit normals.
  std::vector<std::optional<Vec3>> flat;
  for (const std::vector<Vec3>& normals : model::face_normals(description)) {
    std::optional<Vec3>& one = flat.emplace_back();
    const auto is_alike = [&](const Vec3& normal) {
      return norm(normal - normals.front()) <= kFlat;
    };
    if (normals.empty() || !std::ranges::all_of(normals, is_alike)) continue;
    one = normals.front();
    for (double& x : *one) {
      if (std::abs(x) < kFlat) x = 0.0;
    }
  }
  return flat;
}

std::vector<LocalIndex> faces_of_solids(const model::ModelDescription& description)
{
  std::vector<LocalIndex> numbers(description.solids.size(), 0);
  for (const model::FaceDescription& face : description.faces) {
    for (const LocalIndex solid : face.solids) ++numbers[static_cast<std::size_t>(solid) - 1];
  }
  return numbers;
}

std::string point_text(const Vec3& p)
{
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]);
}

std::string box_text(const Box& box)
{
  return box.is_empty() ? "not drawn"
                        : fmt::format("{} to {}", point_text(box.low), point_text(box.high));
}

double predicted_tets(const Extent& extent, double size)
{
  const double thinness = extent.area * size / extent.volume;
  return (kTetsPerCube + kTetsPerThinness * thinness * thinness) * extent.volume
         / (size * size * size);
}

std::string count_text(double count)
{
  if (count < 1e6) return fmt::format("{:.0f} k", std::max(1.0, count / 1e3));
  return fmt::format("{:.1f} M", count / 1e6);
}

std::string face_text(const model::FaceDescription& face, const Box& box,
                      const std::optional<Vec3>& normal, const std::string& unit)
{
  std::string text =
      fmt::format("  {:>5}  {:<20} area {:.6g}{}, box {}", face.number, face.patch_name(),
                  face.area, unit.empty() ? "" : " " + unit + "²", box_text(box));
  if (normal) text += ", normal " + point_text(*normal);
  if (!face.colour.empty()) text += ", colour " + face.colour;
  if (face.is_inside) text += fmt::format(", inside solid {}", face.solids.front());
  if (face.solids.size() > 1)
    text += fmt::format(", between solids {}", fmt::join(face.solids, " and "));
  return text + "\n";
}

std::string edge_text(const model::EdgeDescription& edge, const std::string& unit)
{
  return fmt::format("  {:>5}  {:<20} length {:.6g}{}, box {} to {}\n", edge.number,
                     edge.name.empty() ? "-" : edge.name, edge.length,
                     unit.empty() ? "" : " " + unit, point_text(edge.low), point_text(edge.high));
}

std::string solids_text(const model::ModelDescription& description, const std::string& unit)
{
  std::string text = fmt::format("solids: {}\n", description.solids.size());
  const std::vector<LocalIndex> num_faces = faces_of_solids(description);
  for (std::size_t s = 0; s < description.solids.size(); ++s) {
    const model::SolidDescription& solid = description.solids[s];
    text += fmt::format("  {:>5}  {:<20} volume {:.6g}{}, {} faces\n", s + 1,
                        solid.name.empty() ? "-" : solid.name, solid.volume,
                        unit.empty() ? "" : " " + unit + "³", num_faces[s]);
  }
  return text;
}

std::string faces_text(const model::ModelDescription& description, const Boxes& boxes,
                       const std::string& unit)
{
  std::string text = fmt::format("faces: {}\n", description.faces.size());
  const auto normals = normals_of(description);
  for (std::size_t f = 0; f < description.faces.size(); ++f) {
    text += face_text(description.faces[f], boxes.faces[f], normals[f], unit);
  }
  return text;
}

std::string solid_name(const model::ModelDescription& description, LocalIndex number)
{
  const std::string& name = description.solids[static_cast<std::size_t>(number) - 1].name;
  return name.empty() ? std::to_string(number) : fmt::format("{} '{}'", number, name);
}

std::string touches_text(const model::ModelDescription& description, const std::string& unit)
{
  const std::vector<Touch> touches = touches_of(description);
  std::string text;
  if (description.solids.size() > 1) {
    text = fmt::format("pairs of solids that share faces: {}\n", touches.size());
  }
  for (const Touch& touch : touches) {
    text += fmt::format("  solids {} and {}: {} faces, area {:.6g}{}\n",
                        solid_name(description, touch.solids[0]),
                        solid_name(description, touch.solids[1]), touch.num_faces, touch.area,
                        unit.empty() ? "" : " " + unit + "²");
  }
  return text;
}

std::string edges_text(const model::ModelDescription& description, bool lists_edges,
                       const std::string& unit)
{
  const std::size_t num_edges = description.edges.size();
  if (!lists_edges && num_edges > 0)
    return fmt::format("edges: {} (--edges lists them)\n", num_edges);
  std::string text = fmt::format("edges: {}\n", num_edges);
  for (const model::EdgeDescription& edge : description.edges) text += edge_text(edge, unit);
  return text;
}

std::string sizes_text(const Extent& extent)
{
  std::string text =
      "sizes for `tessera mesh MODEL --size H`, with about so many tets (up to twice "
      "or half):\n";
  for (const SuggestedSize& suggested : suggested_sizes(extent)) {
    text += fmt::format("  {:<7} {:<10g} {}\n", suggested.name, suggested.size,
                        count_text(suggested.num_tets));
  }
  return text;
}

Json json_of(const Box& box)
{
  return box.is_empty() ? Json(nullptr) : Json({{"low", box.low}, {"high", box.high}});
}

Json faces_json(const model::ModelDescription& description, const Boxes& boxes)
{
  Json faces = Json::array();
  const auto normals = normals_of(description);
  for (std::size_t f = 0; f < description.faces.size(); ++f) {
    const model::FaceDescription& face = description.faces[f];
    faces.push_back({{"number", face.number},
                     {"name", face.name},
                     {"patch", face.patch_name()},
                     {"colour", face.colour},
                     {"area", face.area},
                     {"box", json_of(boxes.faces[f])},
                     {"normal", normals[f] ? Json(*normals[f]) : Json(nullptr)},
                     {"solids", face.solids},
                     {"inside", face.is_inside}});
  }
  return faces;
}

Json edges_json(const model::ModelDescription& description)
{
  Json edges = Json::array();
  for (const model::EdgeDescription& edge : description.edges) {
    edges.push_back({{"number", edge.number},
                     {"name", edge.name},
                     {"length", edge.length},
                     {"box", {{"low", edge.low}, {"high", edge.high}}}});
  }
  return edges;
}

Json touches_json(const model::ModelDescription& description)
{
  Json touches = Json::array();
  for (const Touch& touch : touches_of(description)) {
    touches.push_back(
        {{"solids", touch.solids}, {"num_faces", touch.num_faces}, {"area", touch.area}});
  }
  return touches;
}

Json solids_json(const model::ModelDescription& description)
{
  Json solids = Json::array();
  const std::vector<LocalIndex> num_faces = faces_of_solids(description);
  for (std::size_t s = 0; s < description.solids.size(); ++s) {
    solids.push_back({{"number", s + 1},
                      {"name", description.solids[s].name},
                      {"volume", description.solids[s].volume},
                      {"num_faces", num_faces[s]}});
  }
  return solids;
}

}  // namespace

std::vector<Touch> touches_of(const model::ModelDescription& description)
{
  std::map<std::array<LocalIndex, 2>, Touch> found;
  for (const model::FaceDescription& face : description.faces) {
    for (std::size_t s = 1; s < face.solids.size(); ++s) {
      const std::array<LocalIndex, 2> pair{face.solids[s - 1], face.solids[s]};
      if (pair[0] == pair[1]) continue;
      Touch& touch = found[pair];
      touch.solids = pair;
      ++touch.num_faces;
      touch.area += face.area;
    }
  }
  std::vector<Touch> touches;
  for (const auto& [pair, touch] : found) touches.push_back(touch);
  return touches;
}

Extent extent_of(const model::ModelDescription& description)
{
  Extent extent;
  for (const model::SolidDescription& solid : description.solids) extent.volume += solid.volume;
  for (const model::FaceDescription& face : description.faces) extent.area += face.area;
  return extent;
}

TetsOfSize tets_of_size() { return {kTetsPerCube, kTetsPerThinness}; }

double rounded_size(double size)
{
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - 1.0);
  const double steps = std::round(size / unit);
  // Of a decimal text, so that 0.87 is not 0.8700000000000001.
  return std::stod(fmt::format("{:.2g}", steps * unit));
}

// The number of tets falls as the size grows.
double size_for(const Extent& extent, double num_tets)
{
  constexpr int kSteps = 60;
  double low = std::cbrt(kTetsPerCube * extent.volume / num_tets);
  double high = 2.0 * low;
  while (predicted_tets(extent, high) > num_tets) high *= 2.0;
  for (int step = 0; step < kSteps; ++step) {
    const double middle = 0.5 * (low + high);
    (predicted_tets(extent, middle) > num_tets ? low : high) = middle;
  }
  return high;
}

std::vector<SuggestedSize> suggested_sizes(const Extent& extent)
{
  constexpr std::array<std::pair<const char*, double>, 3> kWanted{
      {{"coarse", 2e4}, {"medium", 2e5}, {"fine", 2e6}}};
  std::vector<SuggestedSize> sizes;
  for (const auto& [name, num_tets] : kWanted) {
    const double size = rounded_size(size_for(extent, num_tets));
    sizes.push_back({name, size, predicted_tets(extent, size)});
  }
  return sizes;
}

std::string model_text(const model::ModelSource& source, const model::ModelDescription& description,
                       bool lists_edges)
{
  const Boxes boxes = boxes_of(description);
  const std::string& unit = source.length_unit;
  std::string text =
      fmt::format("model: box diagonal {:.6g} {}\nbox: {}\nlength unit: {}\n",
                  norm(boxes.model.high - boxes.model.low), unit, box_text(boxes.model),
                  unit.empty() ? "the file does not say" : unit);
  text += solids_text(description, unit);
  text += touches_text(description, unit);
  text += faces_text(description, boxes, unit);
  text += edges_text(description, lists_edges, unit);
  for (const std::string& repair : source.repairs) text += fmt::format("repair: {}\n", repair);
  return text + sizes_text(extent_of(description));
}

std::string model_json(const model::ModelSource& source, const model::ModelDescription& description)
{
  const Boxes boxes = boxes_of(description);
  Json json{{"file", source.file_name},
            {"length_unit", source.length_unit},
            {"box", json_of(boxes.model)},
            {"solids", solids_json(description)},
            {"touches", touches_json(description)},
            {"assembly", assembly_json(source.assembly)},
            {"faces", faces_json(description, boxes)},
            {"edges", edges_json(description)},
            {"num_edges", description.edges.size()},
            {"repairs", source.repairs}};
  json["sizes"] = Json::array();
  for (const SuggestedSize& suggested : suggested_sizes(extent_of(description))) {
    json["sizes"].push_back(
        {{"name", suggested.name}, {"size", suggested.size}, {"num_tets", suggested.num_tets}});
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tessera::pipeline

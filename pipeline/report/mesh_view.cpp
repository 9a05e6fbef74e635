// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/mesh_view.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace tessera::pipeline {
namespace {

using Json = nlohmann::ordered_json;

// Of a report that may be of another version: what it lacks is not shown.
const Json& block_of(const Json& report, const char* pointer)
{
  static const Json kNone = Json::array();
  const Json::json_pointer place(pointer);
  return report.contains(place) ? report.at(place) : kNone;
}

Json faces_json(const MeshWords& words, const Json& report)
{
  const Json& patches = block_of(report, "/patches");
  Json faces = Json::array();
  for (std::size_t p = 0; p < words.patches.size(); ++p) {
    Json face{{"name", words.patches[p]}, {"numbers", Json::array()}};
    if (patches.size() == words.patches.size()) {
      face["numbers"] = patches[p].value("faces", Json::array());
      face["area"] = patches[p].value("area", Json());
    }
    faces.push_back(std::move(face));
  }
  faces.push_back({{"name", "not made"}, {"numbers", Json::array()}});
  return faces;
}

// Of each subdomain, from 0.
std::vector<std::uint32_t> materials_of(const Json& report)
{
  std::vector<std::uint32_t> materials;
  for (const Json& subdomain : block_of(report, "/subdomains")) {
    const auto id = subdomain.at("id").get<std::size_t>();
    if (materials.size() <= id) materials.resize(id + 1);
    materials[id] = subdomain.at("material").get<std::uint32_t>() - 1;
  }
  return materials;
}

void add_materials(const Json& report, Surface& surface)
{
  if (surface.cells.contains("material")) return;
  const std::vector<std::uint32_t> material_of = materials_of(report);
  std::vector<std::uint32_t> materials;
  for (const std::uint32_t subdomain : surface.cells["subdomain"]) {
    if (subdomain >= material_of.size()) return;
    materials.push_back(material_of[subdomain]);
  }
  surface.cells["material"] = std::move(materials);
}

Json names_of(const Json& faces)
{
  Json names = Json::array();
  for (const Json& face : faces) names.push_back(face.at("name"));
  return names;
}

Json colourings_json(const MeshWords& words, const Json& faces, const Surface& surface)
{
  Json colourings = Json::array();
  for (Json colouring :
       {Json{{"array", "face"}, {"label", "patch"}, {"names", names_of(faces)}},
        Json{{"array", "subdomain"}, {"label", "subdomain"}},
        Json{{"array", "material"}, {"label", "material"}, {"names", words.materials}},
        Json{{"array", "quality"}, {"label", "quality of the tet behind"}}}) {
    if (surface.cells.contains(colouring.at("array"))) colourings.push_back(std::move(colouring));
  }
  return colourings;
}

}  // namespace

SurfaceView mesh_view(const MeshWords& words, Surface surface)
{
  const Json report = words.report ? Json::parse(*words.report) : Json::object();
  SurfaceView view{.surface = std::move(surface)};
  if (view.surface.corners.empty()) return view;
  // Where only a part of the mesh was made, its coarse triangles have one more.
  const auto not_made = static_cast<std::uint32_t>(words.patches.size());
  for (std::uint32_t& face : view.surface.cells["face"]) face = std::min(face, not_made);
  add_materials(report, view.surface);
  const Json faces = faces_json(words, report);
  view.description = {{"kind", "mesh"},
                      {"unit", words.length_unit},
                      {"faces", faces},
                      {"worst", block_of(report, "/quality/worst")},
                      {"colourings", colourings_json(words, faces, view.surface)}};
  return view;
}

}  // namespace tessera::pipeline

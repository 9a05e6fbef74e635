// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/mesh_page.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/report/html.hpp"
#include "pipeline/report/mesh_view.hpp"
#include "pipeline/report/report_page.hpp"
#include "pipeline/viewer/surface.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

// What the files of one mesh say between them.
struct MeshSurface {
  Surface surface{};
  std::vector<std::string> patches{};
  std::vector<std::string> materials{};
  std::string length_unit{};
};

// Files of tets and of triangles have one name, in folders of their own.
std::optional<fs::path> tets_beside(const std::vector<fs::path>& tet_files,
                                    const fs::path& boundary)
{
  const auto found = std::ranges::find_if(
      tet_files, [&](const fs::path& file) { return file.filename() == boundary.filename(); });
  if (found == tet_files.end()) return std::nullopt;
  return *found;
}

void take_names(const mesh::MeshArrays& piece, MeshSurface& mesh)
{
  const auto texts = [&](const char* name) {
    const auto found = piece.field_texts.find(name);
    return found == piece.field_texts.end() ? std::vector<std::string>{} : found->second;
  };
  if (mesh.patches.empty()) mesh.patches = texts("patch_names");
  if (mesh.materials.empty()) mesh.materials = texts("material_names");
  const std::vector<std::string> unit = texts("length_unit");
  if (!unit.empty()) mesh.length_unit = unit.front();
}

// The materials of subdomains: each is of one.
void add_materials(const mesh::MeshArrays& tets, SurfacePart& part)
{
  const auto attribute = tets.cell_ints.find("attribute");
  const auto subdomain = tets.cell_ints.find("subdomain");
  if (attribute == tets.cell_ints.end() || subdomain == tets.cell_ints.end()) return;
  std::map<std::uint32_t, std::uint32_t> material_of;
  for (std::size_t t = 0; t < subdomain->second.size(); ++t) {
    material_of[static_cast<std::uint32_t>(subdomain->second[t])] =
        static_cast<std::uint32_t>(attribute->second[t]) - 1;
  }
  for (const std::uint32_t number : part.cells["subdomain"]) {
    part.cells["material"].push_back(material_of[number]);
  }
}

MeshSurface read_surface(const fs::path& index, const std::function<void()>& before_each)
{
  const fs::path boundary = index.parent_path() / "boundary.pvtu";
  std::error_code error;
  if (index.filename() != "mesh.pvtu" || !fs::exists(boundary, error)) {
    throw InputError(index.string()
                     + ": --html needs the index mesh.pvtu with boundary.pvtu beside it");
  }
  const std::vector<fs::path> tet_files = io::piece_files(index);
  MeshSurface mesh;
  std::vector<SurfacePart> parts;
  for (const fs::path& file : io::piece_files(boundary)) {
    before_each();
    const mesh::MeshArrays triangles = io::read_vtu(file, io::CellOrder::up_to_second);
    take_names(triangles, mesh);
    const auto number = static_cast<LocalIndex>(parts.size());
    const std::optional<fs::path> tet_file = tets_beside(tet_files, file);
    if (!tet_file) {
      parts.push_back(surface_part(number, triangles, nullptr));
      continue;
    }
    const mesh::MeshArrays tets = io::read_vtu(*tet_file, io::CellOrder::up_to_second);
    parts.push_back(surface_part(number, triangles, &tets));
    add_materials(tets, parts.back());
  }
  mesh.surface = joined(std::move(parts));
  return mesh;
}

std::string page_of(const fs::path& index, const SurfaceView& view)
{
  const std::string name = index.string();
  return page_html("Tessera: " + name,
                   fmt::format("<header><h1>{}</h1></header>\n", escaped(name))
                       + section_html("To turn and to point at", view_html(view)));
}

}  // namespace

std::string mesh_page(const fs::path& index, const std::function<void()>& before_each)
{
  MeshSurface mesh = read_surface(index, before_each);
  std::error_code error;
  const fs::path folder = index.parent_path();
  std::optional<std::string> report;
  if (fs::exists(folder / "report.json", error)) report = read_report_source(folder).json;
  return page_of(index, mesh_view({.patches = mesh.patches,
                                   .materials = mesh.materials,
                                   .length_unit = mesh.length_unit,
                                   .report = report},
                                  std::move(mesh.surface)));
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/case.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "tessera/io/files.hpp"

#include "formats/files/whole_file.hpp"
#include "formats/link/number_faces.hpp"

namespace tessera::formats {
namespace {

struct SystemFile {
  const char* name = nullptr;
  std::string text{};
};

const std::array kSystemFiles{
    SystemFile{"controlDict", R"(application     laplacianFoam;
startFrom       startTime;
startTime       0;
stopAt          endTime;
endTime         1;
deltaT          1;
writeControl    timeStep;
writeInterval   1;
writeFormat     binary;
)"},
    SystemFile{"fvSchemes", R"(ddtSchemes { default steadyState; }
gradSchemes { default Gauss linear; }
divSchemes { default none; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
)"},
    SystemFile{"fvSolution", R"(solvers
{
    T
    {
        solver          PCG;
        preconditioner  DIC;
        tolerance       1e-12;
        relTol          0;
    }
}
SIMPLE { nNonOrthogonalCorrectors 10; }
)"},
};

GlobalIndex num_outer_triangles(const PieceCounts& piece)
{
  GlobalIndex sum = 0;
  for (const TagCount& count : piece.outer_triangles_of_patch) sum += count.count;
  return sum;
}

GlobalIndex num_patch_triangles(const PieceCounts& piece, std::int32_t tag)
{
  if (tag == kNoPatchTag) return piece.num_open_faces - num_outer_triangles(piece);
  const auto found = std::ranges::find(piece.outer_triangles_of_patch, tag, &TagCount::tag);
  return found == piece.outer_triangles_of_patch.end() ? 0 : found->count;
}

FaceCount inner_count(const Outline& outline, LocalIndex piece)
{
  if (!outline.cell_faces.empty()) return outline.cell_faces[at(piece)].inner;
  const GlobalIndex num_faces = num_owned_faces(outline, piece);
  return {kNoPatchTag, num_faces, 3 * num_faces};
}

// Behind what has its places already.
FacePlaces places_behind(const Outline& outline, GlobalIndex face, GlobalIndex corner,
                         const std::function<FaceCount(LocalIndex piece)>& count_of)
{
  return {{outline, face, [&](LocalIndex piece) { return count_of(piece).num_faces; }},
          {outline, corner, [&](LocalIndex piece) { return count_of(piece).num_corners; }}};
}

std::string system_text(const SystemFile& file)
{
  return foam_header({.format = "ascii", .kind = "dictionary", .location = "system"}, file.name)
         + file.text;
}

// Keeps one that is there: it is the user's.
void add_system_file(const std::filesystem::path& folder, const SystemFile& file)
{
  const std::filesystem::path path = folder / "system" / file.name;
  io::make_own_folder(folder / "system");
  if (!std::filesystem::exists(path)) write_whole_file(path, system_text(file));
}

SystemFile decomposition(const std::string& num_processors)
{
  return {"decomposeParDict",
          fmt::format("numberOfSubdomains {};\nmethod scotch;\n", num_processors)};
}

// Whether it is one of ours, for whatever number of processors.
bool is_own_decomposition(const std::filesystem::path& path)
{
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  constexpr const char* kDigits = "0123456789";
  const auto key = text.find("numberOfSubdomains");
  if (key == std::string::npos) return false;
  const auto begin = text.find_first_of(kDigits, key);
  const auto end = text.find_first_not_of(kDigits, begin);
  return text == system_text(decomposition(text.substr(std::min(begin, text.size()), end - begin)));
}

}  // namespace

FaceCount foam_patch_count(const Outline& outline, LocalIndex piece, std::int32_t tag)
{
  if (outline.cell_faces.empty()) {
    const GlobalIndex num_faces = num_patch_triangles(outline.pieces[at(piece)], tag);
    return {tag, num_faces, 3 * num_faces};
  }
  const auto& counts = outline.cell_faces[at(piece)].of_patch;
  const auto found = std::ranges::find(counts, tag, &FaceCount::tag);
  return found == counts.end() ? FaceCount{.tag = tag} : *found;
}

GlobalIndex foam_zone_count(const Outline& outline, LocalIndex piece, std::int32_t tag)
{
  const auto& counts = outline.cell_faces.empty() ? outline.pieces[at(piece)].elements[Shape::tet]
                                                  : outline.cell_faces[at(piece)].of_material;
  const auto found = std::ranges::find(counts, tag, &TagCount::tag);
  return found == counts.end() ? 0 : found->count;
}

FoamCase foam_case(const Outline& outline)
{
  FoamCase result;
  result.zones = foam_words(outline.material_names);
  // One name more, for the faces without a patch: so it is none of the others.
  std::vector<std::string> names = outline.patch_names;
  names.emplace_back("defaultFaces");
  names = foam_words(names);
  const auto add_patch = [&](const std::string& name, std::int32_t tag) {
    bool has_faces = false;
    for (LocalIndex piece = 0; piece < outline.num_pieces(); ++piece)
      has_faces = has_faces || foam_patch_count(outline, piece, tag).num_faces > 0;
    if (has_faces) result.patches.push_back({name, tag});
  };
  for (std::size_t i = 0; i + 1 < names.size(); ++i)
    add_patch(names[i], static_cast<std::int32_t>(i) + 1);
  add_patch(names.back(), kNoPatchTag);
  return result;
}

FoamBoundary foam_patch_entry(const Outline& outline, const FoamCase& names, std::size_t row)
{
  const auto [name, tag] = names.patches[row];
  FoamBoundary entry{.name = name};
  for (const PeriodicPatch& pair : outline.periodic) {
    if (tag != pair.from && tag != pair.to) continue;
    const bool is_image = tag == pair.to;
    const auto partner =
        std::ranges::find(names.patches, is_image ? pair.from : pair.to, &FoamPatch::tag);
    entry.cyclic = {.neighbour = partner->name,
                    .there = is_image ? pair.there.inverse() : pair.there};
  }
  return entry;
}

FoamLayout foam_layout(const Outline& outline)
{
  FoamLayout layout{.names = foam_case(outline),
                    .inner = places_behind(outline, 0, 0, [&](LocalIndex piece) {
                      return inner_count(outline, piece);
                    })};
  for (const FoamPatch& patch : layout.names.patches) {
    layout.patches.push_back(places_behind(
        outline, layout.num_faces(), layout.num_corners(),
        [&](LocalIndex piece) { return foam_patch_count(outline, piece, patch.tag); }));
  }
  return layout;
}

void write_foam_system(const std::filesystem::path& folder)
{
  for (const SystemFile& file : kSystemFiles) add_system_file(folder, file);
}

void write_foam_decomposition(const std::filesystem::path& folder, LocalIndex num_processors)
{
  const SystemFile file = decomposition(std::to_string(num_processors));
  const std::filesystem::path path = folder / "system" / file.name;
  if (is_own_decomposition(path)) write_whole_file(path, system_text(file));
  add_system_file(folder, file);
}

}  // namespace tessera::formats

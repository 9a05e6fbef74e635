// SPDX-License-Identifier: BSD-3-Clause
#include "config/key_table.hpp"

#include <algorithm>
#include <compare>
#include <iterator>
#include <vector>

#include "tessera/base/edit_distance.hpp"

#include "config/geometry_keys.hpp"
#include "config/text.hpp"

namespace tessera::config {
namespace {

constexpr Key kOtherKeys[] = {
    {.name = "size.target",
     .rule = RealRule{[](Case& c) -> double& { return c.size.target; }, 0.0, Bound::exclusive,
                      kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning =
         "Wanted edge length of the mesh: every coarse edge gets as many levels as it needs. "
         "Chooses coarse.max_size, unless that is given.",
     .reason = "a size suits one model only; give this or coarse.max_size",
     .example = "1.0",
     .is_optional = true},
    {.name = "size.min",
     .rule = RealRule{[](Case& c) -> double& { return c.size.min; }, 0.0, Bound::inclusive, kHuge,
                      Bound::inclusive},
     .unit = "output length unit",
     .meaning =
         "No size below this is wanted anywhere, whatever size.target, size.field and "
         "[[size.region]] say. And smaller features of a CAD model or STL file make no small "
         "tets: edges that are shorter are merged in the coarse mesh, and faces that are "
         "narrower; the report lists them. No point is moved by more, and the mesh is that "
         "far off the geometry there. What the case names stays. At most half of the coarse "
         "edge that is wanted at a place counts for that there. 0: nothing is merged.",
     .reason = "smaller features have no say in a solution with such edges; of sizes, all that are "
               "wanted are made",
     .derived_default = "for features, a twentieth of size.target, 0 without it; for sizes, none",
     .example = "0.1",
     .is_optional = true},
    {.name = "size.max",
     .rule = RealRule{[](Case& c) -> double& { return c.size.max; }, 0.0, Bound::exclusive, kHuge,
                      Bound::inclusive},
     .unit = "output length unit",
     .meaning = "No size above this is wanted anywhere.",
     .reason = "a size may grow as far as the coarse mesh lets it",
     .example = "2.0",
     .is_optional = true},
    {.name = "size.grading",
     .rule = RealRule{[](Case& c) -> double& { return c.size.grading; }, 0.0, Bound::exclusive, 1.0,
                      Bound::inclusive},
     .meaning = "Largest growth of the wanted size per length, away from where it is smaller: at "
                "0.3, edges 10 lengths away may be longer by 3 lengths. Acts on size.field, and on "
                "each [[size.region]] without a growth of its own.",
     .reason = "as coarse.grading: neighbouring edges then differ by about a third"},
    {.name = "size.curvature",
     .rule = RealRule{[](Case& c) -> double& { return c.size.curvature; }, 0.0, Bound::exclusive,
                      1000.0, Bound::inclusive},
     .unit = "edges per radius of curvature",
     .meaning = "How finely the mesh follows curved surfaces: edges there are at most so many to a "
                "radius long. The coarse mesh has coarse.curvature of them.",
     .reason = "points are on the geometry anyway; what follows its curves more closely than "
               "size.target has a reason that only the analysis knows",
     .example = "8.0",
     .is_optional = true},
    {.name = "size.field",
     .rule = PathRule{[](Case& c) -> std::filesystem::path& { return c.size.field; }},
     .meaning = "File with wanted sizes at points, as an error estimator writes it: .vtu, .pvtu or "
                ".vti. Relative to the folder of the case file. Between its points the size is "
                "interpolated; outside of its cells it grows by size.grading.",
     .reason = "one size everywhere is the rule",
     .example = "\"field.vtu\"",
     .is_optional = true},
    {.name = "size.field_array",
     .rule = TextRule{[](Case& c) -> std::string& { return c.size.field_array; }},
     .meaning = "Name of the array of size.field that has the sizes: a point array with one "
                "component, in output length units.",
     .reason = "a name for what it holds"},

    {.name = "coarse.mesher",
     .rule = word_rule([](Case& c) -> surface::Mesher& { return c.coarse.mesher; }),
     .meaning = "The program that makes the coarse mesh: \"netgen\", or \"gmsh\", which must be "
                "installed, for .step, .iges and .brep. Gmsh has no coarse.grading.",
     .reason = "NETGEN reads every kind of model and is always there"},
    {.name = "coarse.max_size",
     .rule = RealRule{[](Case& c) -> double& { return c.coarse.max_size; }, 0.0, Bound::exclusive,
                      kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning =
         "Largest edge that the mesher aims at in the coarse mesh. One edge in a hundred may come "
         "out 1.5 times as long, and small features make the mesh finer by themselves.",
     .reason = "a size suits one model only; give this or size.target",
     .derived_default = "with size.target, a few times that, depending on the model's box",
     .example = "10.0"},
    {.name = "coarse.grading",
     .rule = RealRule{[](Case& c) -> double& { return c.coarse.grading; }, 0.0, Bound::exclusive,
                      1.0, Bound::inclusive},
     .meaning = "How fast the size grows away from small features; small values grow slowly.",
     .reason = "NETGEN's own default"},
    {.name = "coarse.curvature",
     .rule = RealRule{[](Case& c) -> double& { return c.coarse.curvature; }, 0.0, Bound::exclusive,
                      100.0, Bound::inclusive},
     .unit = "elements per radius of curvature",
     .meaning =
         "How finely the coarse mesh follows curved surfaces. Of STEP, IGES and BREP models it "
         "is less fine where that alone would make most of more than 500,000 tets.",
     .reason = "NETGEN's own default"},
    {.name = "coarse.feature_angle_deg",
     .rule = RealRule{[](Case& c) -> double& { return c.coarse.feature_angle_deg; }, 0.0,
                      Bound::exclusive, 180.0, Bound::exclusive},
     .unit = "degrees",
     .meaning = "STL and meshes: angle between two triangles from which their edge separates "
                "two patches.",
     .reason = "NETGEN's own default"},
    {.name = "coarse.optimize",
     .rule = FlagRule{[](Case& c) -> bool& { return c.coarse.optimize; }},
     .meaning = "Whether tets off the geometry are flipped and vertices moved so that the children "
                "of the coarse tets become better.",
     .reason = "what is subdivided gains most; what NETGEN or our optimiser makes better "
               "afterwards gains little"},
    {.name = "coarse.timeout_s",
     .rule = RealRule{[](Case& c) -> double& { return c.coarse.timeout_s; }, 0.0, Bound::inclusive,
                      1e6, Bound::inclusive},
     .unit = "seconds of CPU time",
     .meaning = "Limit of each job of a try at the coarse mesh (its surface, a domain, the whole); "
                "0 derives it from the model's faces and area, the size and the triangles.",
     .reason = "the derived limit is ten times what models of that size take, or more; on some "
               "models NETGEN never ends, and then the next try comes soon"},

    {.name = "decompose.subdomains",
     .rule =
         IntegerRule{[](Case& c) -> int& { return c.decompose.subdomains; }, 1, 1'000'000, "auto"},
     .meaning = "Wanted number of subdomains K, never a function of the number of ranks. A "
                "request: there is at least one for each material, at most one for each coarse "
                "tet, and repair may split some.",
     .reason = "\"auto\" is one for each 50,000 predicted tets, for each 500,000 where all are "
               "subdivided, and at least eight: more of them have more seams, and fewer leave "
               "ranks without work"},

    {.name = "decompose.method",
     .rule = word_rule([](Case& c) -> decompose::Method& { return c.decompose.method; }),
     .meaning =
         "What is cut into subdomains. \"mesh\": the coarse mesh, by METIS. \"octree\": the same, "
         "in runs of octants along a space curve. \"geometry\": the model, by "
         "planes, before it is meshed; subdomains end at these planes. The model must be "
         "CSG, STEP, IGES or BREP. Where no plane cuts well, or the parts cannot be meshed, "
         "the coarse mesh is cut as well.",
     .reason = "METIS cuts every mesh, and finds less area"},
    {.name = "decompose.planes",
     .rule = word_rule([](Case& c) -> cut::PlaneRule& { return c.planes.rule; }),
     .meaning =
         "How planes are chosen, with decompose.method = \"geometry\". \"clear\": the best of "
         "many, which are balanced and stay away from corners and faces that they do not "
         "cross; a part that none cuts well stays whole. \"pca\": through the centre of mass, "
         "across the longest axis.",
     .reason = "a plane in a bad place leaves thin slices, and these tiny tets"},

    {.name = "refine.levels",
     .rule = IntegerRule{[](Case& c) -> int& { return c.refine.levels; }, 0, 10},
     .meaning = "Number of refinements L: every coarse edge is split into 2^L, and the mesh has "
                "about 8^L times as many tets. With keys of [size], the largest number: each edge "
                "has as many as it needs.",
     .reason = "the smallest number that refines at all; where sizes are wanted, edges decide",
     .derived_default = "1; with keys of [size], as many as needed",
     .example = "2",
     .is_optional = true},

    {.name = "fill.kernel",
     .rule = word_rule([](Case& c) -> fill::KernelKind& { return c.fill.kernel; }),
     .meaning =
         "What turns a subdomain into tets: \"subdivide\" splits each of its coarse tets into 8^L; "
         "\"optimize\" makes these better with our own optimiser; \"netgen\" lets NETGEN swap "
         "their "
         "edges and faces before, and mesh a subdomain anew where they are folded.",
     .reason = "it fills what the others cannot, and its meshes are as good as any; \"optimize\" "
               "takes two thirds of the time; subdivision keeps the shapes of the coarse tets"},
    {.name = "fill.levels",
     .rule =
         IntegerRule{[](Case& c) -> int& { return c.fill.levels; }, 1, fill::kAllLevels, "auto"},
     .meaning = "On how many of the refine.levels subdomains are filled, by \"netgen\" or "
                "\"optimize\", and seams improved. For the others tets are split into eight and "
                "smoothed, which is many times as fast. More than refine.levels is all of them. "
                "\"auto\" leaves two for the split, but fills on two at least; it is all with "
                "output.order = 2. Where edges have levels of their own, fewer are left for the "
                "split if it would make a tenth more tets.",
     .reason = "from three levels on, the split mesh is better in mean and 1st percentile, and "
               "comes many times as fast"},
    {.name = "fill.split_corners",
     .rule = SwitchRule{[](Case& c) -> std::optional<bool>& { return c.fill.split_corners; }},
     .meaning = "Whether no tet may have more than one face on the geometry. Solvers want that: "
                "all four corners of such a tet can be on the boundary, and OpenFOAM's checkMesh "
                "calls it under-determined. \"auto\": yes for \"netgen\" and \"optimize\"; for "
                "\"subdivide\" only if output.formats has OpenFOAM's. true excludes "
                "--only-subdomains.",
     .reason = "it costs 0.003 of the mean ratio at most; what is subdivided can then be written "
               "only after all of it was made"},
    {.name = "fill.timeout_s",
     .rule = RealRule{[](Case& c) -> double& { return c.fill.timeout_s; }, 0.0, Bound::inclusive,
                      kHuge, Bound::inclusive},
     .unit = "seconds of CPU time",
     .meaning = "Limit of one job of fill or improvement; 0 derives it from the predicted number "
                "of tets. A job that sleeps as long, or 120 s, is ended too.",
     .reason = "the derived limit is generous (at least 20 times the prediction), so that only a "
               "hanging job meets it"},
    {.name = "fill.memory_gib",
     .rule = RealRule{[](Case& c) -> double& { return c.fill.memory_gib; }, 0.0, Bound::exclusive,
                      1e6, Bound::inclusive},
     .unit = "GiB",
     .meaning = "Limit of the resident memory of one job of fill or improvement.",
     .reason =
         "filling one skin alone with 485 k tets took 0.7 GiB; a job that needs more than this is "
         "running away, or wants more subdomains"},
    {.name = "fill.optimize_steps",
     .rule = IntegerRule{[](Case& c) -> int& { return c.fill.optimize_steps; }, 0, 100},
     .meaning = "NETGEN's rounds in a fill: of swaps where it begins with tets, of all its steps "
                "where it meshes a subdomain anew.",
     .reason = "our own optimiser goes over the tets afterwards, so a second round gains nothing"},
    {.name = "fill.grading",
     .rule = RealRule{[](Case& c) -> double& { return c.fill.grading; }, 0.0, Bound::exclusive, 1.0,
                      Bound::inclusive},
     .meaning =
         "How fast the size grows from the surface of a subdomain to its inside where NETGEN "
         "meshes the surface alone: if the children of its coarse tets are folded, or became "
         "poor tets. Small values grow slowly.",
     .reason = "NETGEN's own default"},

    {.name = "improve.seams",
     .rule = FlagRule{[](Case& c) -> bool& { return c.improve.seams; }},
     .meaning = "Whether the tets around the seams between subdomains are optimised once more, "
                "across the seams. What is subdivided stays as it is.",
     .reason = "so the mesh is as good with 64 subdomains as with one"},
    {.name = "improve.rounds",
     .rule = IntegerRule{[](Case& c) -> int& { return c.improve.rounds; }, 1, 10},
     .meaning = "Rounds of optimisation around a seam.",
     .reason = "a fill has one round too"},

    {.name = "quality.min_dihedral_deg",
     .rule = RealRule{[](Case& c) -> double& { return c.quality.min_dihedral_deg; }, 0.0,
                      Bound::inclusive, 70.5, Bound::inclusive},
     .unit = "degrees",
     .meaning = "Smallest dihedral angle that is wanted; if one is smaller, the run ends degraded "
                "(exit code 3). A regular tet has 70.5.",
     .reason = "a run is judged by validity alone unless more is asked"},
    {.name = "quality.min_mean_ratio",
     .rule = RealRule{[](Case& c) -> double& { return c.quality.min_mean_ratio; }, 0.0,
                      Bound::inclusive, 1.0, Bound::inclusive},
     .meaning =
         "Smallest mean ratio 12 (3 V)^(2/3) / (sum of squared edges) that is wanted; if one "
         "is smaller, the run ends degraded (exit code 3). A regular tet has 1.",
     .reason = "a run is judged by validity alone unless more is asked"},

    {.name = "output.directory",
     .rule = PathRule{[](Case& c) -> std::filesystem::path& { return c.output.directory; }},
     .meaning = "Folder of the results, relative to the working directory. It must be new or empty "
                "unless --overwrite is given.",
     .reason = "one folder a case, where git ignores it",
     .derived_default = "outputs/<name of the case file without .toml>",
     .example = "\"outputs/case\"",
     .is_optional = true},
    {.name = "output.formats",
     .rule = word_list_rule([](Case& c) -> std::vector<io::Format>& { return c.output.formats; }),
     .meaning =
         "Formats in which the mesh is written. Pieces in pvtu are always written; the other "
         "formats are made of them, as by `tessera convert`.",
     .reason = "ParaView and VTK read it in parallel"},
    {.name = "output.order",
     .rule = IntegerRule{[](Case& c) -> int& { return c.output.order; }, 1, 2},
     .meaning =
         "Order of the tets. 2: a node on every edge, which lies on the geometry where the edge "
         "does, so tets are curved there; each is certainly valid. Excludes fill.levels below "
         "refine.levels.",
     .reason = "what every solver reads"},
    {.name = "output.layers",
     .rule = word_rule([](Case& c) -> io::LayerCells& { return c.output.layers; }),
     .meaning = "What formats other than pvtu have where [[layer]] is: prisms, or the tets that "
                "they are cut into.",
     .reason = "flat tets make errors that prisms do not"},
    {.name = "output.compression",
     .rule = word_rule([](Case& c) -> io::Compression& { return c.output.compression; }),
     .meaning = "Compression of the arrays in the mesh files.",
     .reason = "lz4 wrote 10 M tets/s at 19 bytes a tet; none 11 M at 33; zlib 2 M at 7.5"},
    {.name = "output.parts",
     .rule = IntegerRule{[](Case& c) -> int& { return c.output.parts; }, 0, 1'000'000},
     .meaning =
         "Number of parts for a solver on so many ranks, one piece file each: balanced, "
         "connected where the model is, and made of whole subdomains, which are numbered part "
         "by part. 0: none. Excludes output.files.",
     .reason = "readers can share out subdomains as they like"},
    {.name = "output.files",
     .rule = IntegerRule{[](Case& c) -> int& { return c.output.files; }, 0, 1'000'000},
     .meaning =
         "Number of files that hold the pieces, each a contiguous range of subdomains; 0: one "
         "for each subdomain.",
     .reason =
         "readers can share out every subdomain; ask for fewer when they are too many for the "
         "file system"},
    {.name = "output.cell_quality",
     .rule = FlagRule{[](Case& c) -> bool& { return c.output.cell_quality; }},
     .meaning = "Also write the mean ratio of every tet.",
     .reason = "one more number a tet, and report.json has the histogram"},
    {.name = "output.report_html",
     .rule = FlagRule{[](Case& c) -> bool& { return c.output.report_html; }},
     .meaning = "Also write report.html, the report for people, with pictures of the mesh.",
     .reason = "the pictures take a second or two, however large the mesh is"},
};

// Whatever may stand in a case file.
std::vector<std::string_view> all_names()
{
  std::vector<std::string_view> names;
  for (const Key& key : all_keys()) names.push_back(key.name);
  for (const TableList& list : all_table_lists()) {
    names.push_back(list.name);
    for (const Key& key : list.keys) names.push_back(key.name);
  }
  return names;
}

// A right key in a wrong table counts as one mistake; then the nearer table decides.
struct Nearness {
  std::size_t mistakes = 0;
  std::size_t distance = 0;

  friend auto operator<=>(const Nearness&, const Nearness&) = default;
};

Nearness nearness_of(std::string_view name, std::string_view known)
{
  const std::size_t distance = edit_distance(name, known);
  return {std::min(distance, 1 + edit_distance(last_part(name), last_part(known))), distance};
}

}  // namespace

std::span<const Key> all_keys()
{
  static const std::vector<Key> keys = [] {
    std::vector<Key> all(std::begin(kGeometryKeys), std::end(kGeometryKeys));
    all.insert(all.end(), std::begin(kOtherKeys), std::end(kOtherKeys));
    return all;
  }();
  return keys;
}

const Key* find_key(std::string_view name)
{
  const auto found = std::ranges::find(all_keys(), name, &Key::name);
  return found == all_keys().end() ? nullptr : &*found;
}

std::string_view table_of(std::string_view name)
{
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : name.substr(0, dot);
}

std::string_view last_part(std::string_view name)
{
  return name.substr(name.rfind('.') + 1);  // npos + 1 is 0: a name without a dot is its own.
}

bool is_table(std::string_view name)
{
  return std::ranges::any_of(all_keys(),
                             [&](const Key& key) { return table_of(key.name) == name; });
}

std::optional<std::string_view> nearest_key(std::string_view name)
{
  constexpr std::size_t kLongestName = 100;  // Nothing longer is near; bounds the work.
  if (name.size() > kLongestName) return std::nullopt;
  if (const Key* key = find_key(table_of(name))) return key->name;  // [coarse.max_size]
  std::optional<std::string_view> nearest;
  Nearness least{.mistakes = std::max<std::size_t>(2, name.size() / 4) + 1};
  for (const std::string_view known : all_names()) {
    const Nearness nearness = nearness_of(name, known);
    if (nearness < least) {
      least = nearness;
      nearest = known;
    }
  }
  return nearest;
}

}  // namespace tessera::config

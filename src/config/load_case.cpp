// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"
#include "tessera/config/exclusions.hpp"

#include "config/key_table.hpp"
#include "config/text.hpp"
#include "config/toml_document.hpp"

namespace tessera::config {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& where, const std::string& what)
{
  throw ConfigError(fmt::format("{}: {}", where, what));
}

std::string file_name_for_messages(const fs::path& file) { return printable(file.string()); }

[[noreturn]] void fail_unknown(const std::string& name, const std::string& origin)
{
  if (name == "coarse.defeature") {
    fail(origin, "coarse.defeature is size.min now: give size.min the value that it has here");
  }
  std::string message = "unknown key " + toml_string(name);
  if (const auto near = nearest_key(name))
    message += fmt::format("; did you mean {}?", toml_string(*near));
  fail(origin, message + " (configs/reference.toml lists all keys)");
}

// A key of a list is known, but not where other keys stand.
[[noreturn]] void fail_unknown_outside_lists(const std::string& name, const std::string& origin)
{
  const TableList* list = list_around(name);
  if (list == nullptr) fail_unknown(name, origin);
  fail(origin,
       fmt::format("{} stands outside of a list; {} must be {}", name, list->name, allowed(*list)));
}

// An empty table says nothing, but its name must be known.
bool is_empty_table(const Entry& entry)
{
  const auto* other = std::get_if<OtherValue>(&entry.value.data);
  return other != nullptr && other->kind == kEmptyTable;
}

const Key* key_of(const Entry& entry)
{
  const Key* key = find_key(entry.name);
  if (key != nullptr) return key;
  if (!is_table(entry.name)) fail_unknown_outside_lists(entry.name, entry.origin);
  if (is_empty_table(entry)) return nullptr;
  fail(entry.origin,
       fmt::format("{} is a table, not a value: write [{}] on a line of its own and its keys below",
                   toml_string(entry.name), entry.name));
}

Entry parse_override(const std::string& text)
{
  const std::string origin = "--set " + printable(text);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) fail(origin, "must have the form table.key=value");
  Entry entry{.name = std::string(trimmed(std::string_view(text).substr(0, equals))),
              .origin = origin};
  const std::string_view value = trimmed(std::string_view(text).substr(equals + 1));
  const TableList* list = find_table_list(entry.name);
  const Key* key = find_key(entry.name);
  if (list == nullptr && key == nullptr) fail_unknown_outside_lists(entry.name, origin);
  if (value.empty()) {
    fail(origin,
         "no value after '='; must be " + (key != nullptr ? allowed(key->rule) : allowed(*list)));
  }
  entry.value = {std::string(value)};
  const bool is_quoted = value.front() == '"' || value.front() == '\'';
  if (key != nullptr && takes_text(key->rule) && !is_quoted) return entry;
  return parse_toml_value(value, entry.name, origin).value_or(entry);
}

// Overrides come after the file's entries and win, the last one of a key before all.
std::vector<Entry> all_entries(std::string_view text, const fs::path& file,
                               std::span<const std::string> overrides)
{
  std::vector<Entry> entries = parse_toml(text, file_name_for_messages(file));
  for (const std::string& override_text : overrides) {
    Entry entry = parse_override(override_text);
    std::erase_if(entries, [&](const Entry& old) { return old.name == entry.name; });
    entries.push_back(std::move(entry));
  }
  return entries;
}

[[noreturn]] void fail_value(const Entry& entry, const std::string& must_be)
{
  fail(entry.origin,
       fmt::format("{} = {}: must be {}", entry.name, value_text(entry.value), must_be));
}

const Key& key_in(const TableList& list, const Entry& entry)
{
  const auto key = std::ranges::find(list.keys, entry.name, &Key::name);
  if (key == list.keys.end()) fail_unknown(entry.name, entry.origin);
  return *key;
}

// The alternative that the table has taken; empty if the list has none.
std::string_view alternative_in(const TableList& list, const Table& table)
{
  std::string_view chosen;
  const Entry* first = nullptr;
  for (const Entry& entry : table.entries) {
    const std::string_view other = alternative_of(list, key_in(list, entry));
    if (other.empty() || other == chosen) continue;
    if (first != nullptr) {
      fail(entry.origin,
           fmt::format("{} stands beside {} ({}); must be one of {} in every [[{}]]", entry.name,
                       first->name, first->origin, fmt::join(list.alternatives, ", "), list.name));
    }
    chosen = other;
    first = &entry;
  }
  if (chosen.empty() && !list.alternatives.empty()) {
    fail(table.origin, fmt::format("[[{}]] has none of {}; must have one of them", list.name,
                                   fmt::join(list.alternatives, ", ")));
  }
  return chosen;
}

// Fills the last element of the list.
void apply_table(const TableList& list, const Table& table, Case& into)
{
  const std::string_view chosen = alternative_in(list, table);
  std::set<std::string_view> given;
  for (const Entry& entry : table.entries) {
    const Key& key = key_in(list, entry);
    if (!assign(key.rule, entry.value, into)) fail_value(entry, allowed(key.rule));
    given.insert(key.name);
  }
  for (const Key& key : list.keys) {
    const std::string_view alternative = alternative_of(list, key);
    const bool is_needed = alternative.empty() || alternative == chosen;
    if (!is_needed || key.is_optional || given.contains(key.name)) continue;
    fail(table.origin, fmt::format("no {}; must be {}", key.name, allowed(key.rule)));
  }
  const std::string defect = list.defect == nullptr ? "" : list.defect(into);
  if (!defect.empty()) fail(table.origin, fmt::format("[[{}]]: {}", list.name, defect));
}

// A list's elements by the value of the unique key.
class UniqueElements {
 public:
  explicit UniqueElements(const TableList& list) : list_(list) {}

  void add(const Table& table)
  {
    const auto unique = std::ranges::find(table.entries, list_.unique_key, &Entry::name);
    const std::string text = value_text(unique->value);
    const auto [first, is_new] = origins_.emplace(text, unique->origin);
    if (is_new) return;
    const bool is_elsewhere = first->second != unique->origin;
    fail(unique->origin,
         fmt::format("{} = {}: given twice{}; must be another one in every [[{}]]", unique->name,
                     text, is_elsewhere ? fmt::format(" (first at {})", first->second) : "",
                     list_.name));
  }

 private:
  const TableList& list_;
  std::map<std::string, std::string> origins_{};
};

void apply_list(const TableList& list, const Entry& entry, Case& into)
{
  const auto* items = std::get_if<std::vector<Value>>(&entry.value.data);
  if (items == nullptr) fail_value(entry, allowed(list));
  UniqueElements elements(list);
  for (const Value& item : *items) {
    const auto* table = std::get_if<Table>(&item.data);
    if (table == nullptr) fail_value(entry, allowed(list));
    list.resize(into, list.size(into) + 1);
    apply_table(list, *table, into);
    if (!list.unique_key.empty()) elements.add(*table);
  }
}

void apply(const Entry& entry, Case& into)
{
  if (const TableList* list = find_table_list(entry.name)) {
    apply_list(*list, entry, into);
    return;
  }
  const Key* key = key_of(entry);
  if (key == nullptr || assign(key->rule, entry.value, into)) return;
  fail_value(entry, allowed(key->rule));
}

// What only a CAD model, or only a mesh, has.
void check_own_mesh(const Case& loaded, bool is_mesh, const std::string& where)
{
  const GeometryOptions& geometry = loaded.geometry;
  if (is_mesh && loaded.coarse.max_size > 0.0) {
    fail(where,
         "coarse.max_size is for a CAD model; the mesh in geometry.file is the coarse mesh, with "
         "the sizes that it has");
  }
  if (!is_mesh && (!geometry.cad.empty() || geometry.smooth)) {
    fail(where, fmt::format("geometry.{} is for a mesh in geometry.file (.msh, .vol, .vtu)",
                            geometry.smooth ? "smooth" : "cad"));
  }
  const std::string kind = model::lower_case_extension(geometry.file);
  if (loaded.coarse.mesher == surface::Mesher::gmsh
      && (is_mesh || kind == ".geo" || kind == ".stl")) {
    fail(where, fmt::format("coarse.mesher = \"gmsh\" is for .step, .iges and .brep; {}",
                            is_mesh ? "the mesh in geometry.file is the coarse mesh"
                                    : "leave it out for " + kind));
  }
  if (geometry.smooth && !geometry.cad.empty()) {
    fail(where, "geometry.smooth excludes geometry.cad: the CAD model has the smooth surface");
  }
  if (model::is_mesh_name(geometry.cad)) {
    fail(where, "geometry.cad names a mesh; it must be a CAD model");
  }
}

// What only a model with solids of OpenCASCADE has.
void check_assembly(const Case& loaded, const std::string& where)
{
  const GeometryOptions& geometry = loaded.geometry;
  const std::filesystem::path& model = geometry.cad.empty() ? geometry.file : geometry.cad;
  const std::string kind = model::lower_case_extension(model);
  const bool has_solids = kind != ".geo" && kind != ".stl" && !model::is_mesh_name(model);
  if (has_solids) return;
  model::AssemblyOptions of_others;
  if (kind == ".geo") of_others.embedded = geometry.assembly.embedded;
  if (geometry.assembly == of_others) return;
  fail(where,
       fmt::format("geometry.overlap, geometry.gap, geometry.loose_faces and "
                   "geometry.loose_curves are for .step, .iges and .brep, and [[embed]] for these "
                   "and .geo; leave them out for {}",
                   kind));
}

// What only an STL file needs.
void check_wrap(const Case& loaded, const std::string& where)
{
  const GeometryOptions& geometry = loaded.geometry;
  if (geometry.stl == model::StlOptions{}) return;
  if (geometry.stl.repair != model::StlRepair::wrap) {
    fail(where, "geometry.wrap_tolerance needs geometry.repair = \"wrap\"");
  }
  const std::string kind = model::lower_case_extension(geometry.file);
  if (kind == ".stl") return;
  fail(where, fmt::format("geometry.repair = \"wrap\" is for .stl, whose triangles may bound no "
                          "body; leave it out for {}",
                          kind));
}

void check_required(const Case& loaded, const std::string& where)
{
  if (loaded.geometry.file.empty()) {
    fail(where, "no geometry.file; every case names its CAD model");
  }
  const bool is_mesh = model::is_mesh_name(loaded.geometry.file);
  if (loaded.size.target == 0.0 && loaded.coarse.max_size == 0.0 && !is_mesh) {
    fail(where, "no size; give either size.target or coarse.max_size");
  }
  check_own_mesh(loaded, is_mesh, where);
  check_assembly(loaded, where);
  check_wrap(loaded, where);
  if (loaded.size.max > 0.0 && loaded.size.min > loaded.size.max) {
    fail(where, fmt::format("size.min = {} is above size.max = {}; it must not be",
                            number_text(loaded.size.min), number_text(loaded.size.max)));
  }
  if (loaded.output.parts > 0 && loaded.output.files > 0) {
    fail(where, "output.parts excludes output.files: each part is one file; give either of them");
  }
}

// Whether pieces are split after they were filled, because the case says so.
bool asks_for_split(const Case& loaded)
{
  const int levels = refine::levels_of(loaded.refine, sizing::are_wanted(loaded.size));
  return loaded.fill.levels > 0 && loaded.fill.levels < levels;
}

// Nodes of second order are put on the tets that were filled.
void check_order(const Case& loaded, const std::string& where)
{
  if (loaded.output.order == 1 || !asks_for_split(loaded)) return;
  fail(where,
       "output.order = 2 excludes fill.levels below refine.levels; leave out fill.levels, so that "
       "subdomains are filled on all levels");
}

// Layers of which the case does not say how many there are lead up to the size inside.
void complete_layers(Case& loaded, const std::string& where)
{
  for (layers::LayerOptions& layer : loaded.layers) {
    if (layers::is_complete(layer)) continue;
    if (loaded.size.target > 0.0) layer.count = layers::count_up_to(layer, loaded.size.target);
    if (layer.count > layers::kMostLayers) {
      fail(where, fmt::format("[[layer]] of \"{}\" needs more than {} layers to lead up to "
                              "size.target = {:g}; choose a larger first or growth, or give count",
                              layer.patch, layers::kMostLayers, loaded.size.target));
    }
    if (layer.count > 0) continue;
    fail(where, fmt::format("[[layer]] of \"{}\" has neither count nor thickness, and {}; give "
                            "one of them",
                            layer.patch,
                            loaded.size.target > 0.0
                                ? "with growth = 1 its layers never get as high as size.target"
                                : "there is no size.target that its layers could lead up to"));
  }
}

// A surface that is made smooth knows only the points of its own triangles.
void check_layers(const Case& loaded, const std::string& where)
{
  if (loaded.layers.empty()) return;
  const std::string_view other = loaded.output.order == 2 ? "output.order = 2"
                                 : loaded.geometry.smooth ? "geometry.smooth"
                                 : loaded.decompose.method == decompose::Method::geometry
                                     ? "decompose.method = \"geometry\""
                                     : "";
  if (other.empty()) return;
  fail(where, fmt::format("[[layer]] excludes {}; leave out one of them", other));
}

void check_lines(const Case& loaded, const std::string& where)
{
  const auto& embedded = loaded.geometry.assembly.embedded;
  const auto line = std::ranges::find_if(embedded, &model::EmbeddedShape::is_line);
  const std::string_view other = excluded_by_inner_lines(loaded);
  if (line == embedded.end() || other.empty()) return;
  fail(where, fmt::format("[[embed]] \"{}\" with a polyline excludes {}; leave out one of them",
                          line->name, other));
}

void check_embedded(const Case& loaded, const std::string& where)
{
  if (loaded.geometry.assembly.embedded.empty()) return;
  const std::string_view other = model::is_mesh_name(loaded.geometry.file)
                                     ? "a mesh in geometry.file"
                                     : excluded_by_inner_faces(loaded);
  if (other.empty()) return;
  fail(where, fmt::format("[[embed]] excludes {}; leave out one of them", other));
}

// What makes sides anew, or surfaces that are not alike on both.
void check_periodic(const Case& loaded, const std::string& where)
{
  if (loaded.periodic.empty()) return;
  const bool is_mesh = model::is_mesh_name(loaded.geometry.file);
  const std::string_view other =
      loaded.geometry.smooth                                      ? "geometry.smooth"
      : !is_mesh && loaded.coarse.mesher == surface::Mesher::gmsh ? "coarse.mesher = \"gmsh\""
      : loaded.decompose.method == decompose::Method::geometry ? "decompose.method = \"geometry\""
                                                               : "";
  if (other.empty()) return;
  fail(where, fmt::format("[[periodic]] excludes {}; leave out one of them", other));
}

void check_planes(const Case& loaded, const std::string& where)
{
  if (loaded.planes.given.empty() || loaded.decompose.method == decompose::Method::geometry) return;
  fail(where, "[[decompose.plane]] cuts the model; it needs decompose.method = \"geometry\"");
}

void resolve_paths(const fs::path& case_file, Case& loaded)
{
  const auto beside_case = [&](const fs::path& path) {
    return fs::absolute(case_file.parent_path() / path).lexically_normal();
  };
  loaded.geometry.file = beside_case(loaded.geometry.file);
  if (!loaded.geometry.cad.empty()) loaded.geometry.cad = beside_case(loaded.geometry.cad);
  if (!loaded.size.field.empty()) loaded.size.field = beside_case(loaded.size.field);
  if (loaded.output.directory.empty()) loaded.output.directory = "outputs" / case_file.stem();
}

std::string read_text(const fs::path& file)
{
  const std::string name = file_name_for_messages(file);
  if (file.empty()) throw ConfigError("the name of the case file is empty");
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail(name, "no such case file");
  if (status.type() == fs::file_type::directory) fail(name, "is a folder, not a case file");

  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(name, std::string("cannot read the case file: ") + std::strerror(errno));
  // Far above any case file; a model is often larger. The time of toml11 grows with the square.
  constexpr std::size_t kLargest = 1U << 16U;
  std::string text(kLargest + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) fail(name, "cannot read the case file: input or output error");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kLargest) fail(name, "is larger than 64 KiB, so it is no case file");
  return text;
}

}  // namespace

Case parse_case(std::string_view text, const std::filesystem::path& file,
                std::span<const std::string> overrides)
{
  const std::string name = file_name_for_messages(file);
  if (text.find('\0') != std::string_view::npos) {
    fail(name, "is a binary file, not a case file (TOML)");
  }
  if (trimmed(text).empty()) fail(name, "the case file is empty");

  const std::vector<Entry> entries = all_entries(text, file, overrides);
  Case loaded;
  for (const Entry& entry : entries) apply(entry, loaded);
  check_required(loaded, name);
  check_order(loaded, name);
  check_planes(loaded, name);
  complete_layers(loaded, name);
  check_layers(loaded, name);
  check_embedded(loaded, name);
  check_lines(loaded, name);
  check_periodic(loaded, name);
  resolve_paths(file, loaded);
  return loaded;
}

Case load_case(const std::filesystem::path& file, std::span<const std::string> overrides)
{
  return parse_case(read_text(file), file, overrides);
}

}  // namespace tessera::config

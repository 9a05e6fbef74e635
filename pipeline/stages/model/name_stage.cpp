// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/model/name_stage.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/name_patterns.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/require_job.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kDescribeLimits{.cpu_s = 600.0, .stall_s = 60.0, .memory_gib = 8.0};

JobResult<model::ModelDescription> run_describe(const std::string& name, const Bytes& request,
                                                RunContext& context)
{
  const JobRequest job{name, request, kDescribeLimits};
  auto described = attempt_job(job, description_from_bytes, wait_for_stop_signal(), context);
  keep_if_failed(job, described.end, context);
  return described;
}

std::string what_is_described(const config::Case& given)
{
  return given.geometry.file.string() + ": its faces and solids";
}

// Limits are left out: whether they are met depends on the machine, and which faces a name fits may
// depend on the triangles.
bool has_failed(const jobs::JobEnd& end)
{
  return end.status != jobs::JobStatus::ok && end.status != jobs::JobStatus::cancelled
         && !depends_on_machine(end);
}

// Patterns of names in the tables of a case.
struct Patterns {
  std::vector<std::string> patches{};
  std::vector<std::string> curves{};
};

Patterns patterns_of(const config::Case& given)
{
  Patterns patterns;
  for (const sizing::SizeRegion& region : given.size.regions) {
    if (const auto* patch = std::get_if<sizing::PatchPattern>(&region.shape))
      patterns.patches.push_back(patch->pattern);
    if (const auto* curve = std::get_if<sizing::CurvePattern>(&region.shape))
      patterns.curves.push_back(curve->pattern);
  }
  for (const layers::LayerOptions& layer : given.layers) {
    if (layer.patch != "*") patterns.patches.push_back(layer.patch);  // That names none of them.
  }
  for (const topology::SplitPatch& split : given.splits.patches)
    patterns.patches.push_back(split.patch);
  for (const topology::PeriodicSide& side : given.periodic) {
    patterns.patches.insert(patterns.patches.end(), {side.from, side.to});
  }
  return patterns;
}

bool matches_any(const std::vector<std::string>& patterns, const std::string& name)
{
  return std::ranges::any_of(
      patterns, [&](const std::string& pattern) { return matches_pattern(pattern, name); });
}

// Curves of a CSG file have numbers of other kinds; they are found by none.
std::optional<LocalIndex> curve_of(const model::EdgeDescription& edge)
{
  LocalIndex number = 0;
  const char* const end = edge.number.data() + edge.number.size();
  const auto read = std::from_chars(edge.number.data(), end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional(number - 1) : std::nullopt;
}

// The name that a face will have as a patch.
std::string name_of(const model::FaceDescription& face, const model::NamedParts& named)
{
  const auto given = std::ranges::find(named.faces, face.number, &model::NumberedName::number);
  if (given != named.faces.end()) return given->name;
  return face.patch_name();
}

surface::KeptParts kept_parts(const model::ModelDescription& described,
                              const model::NamedParts& named, const Patterns& patterns)
{
  std::set<LocalIndex> patches;
  for (const model::NumberedName& face : named.faces) patches.insert(face.number - 1);
  for (const model::FaceDescription& face : described.faces) {
    if (matches_any(patterns.patches, name_of(face, named))) patches.insert(face.number - 1);
  }
  std::set<LocalIndex> curves;
  for (const model::EdgeDescription& edge : described.edges) {
    const auto curve = curve_of(edge);
    const bool is_named =
        matches_any(patterns.curves, edge.number) || matches_any(patterns.curves, edge.name);
    if (curve && is_named) curves.insert(*curve);
  }
  return {{patches.begin(), patches.end()}, {curves.begin(), curves.end()}};
}

// What is one face to the case, or was one before faces were put in, is one patch, under the name
// that it had.
void name_pieces(const model::ModelDescription& described, const config::Case& given,
                 model::NamedParts& named)
{
  std::map<LocalIndex, std::string> name_of_number;
  for (const model::FaceDescription& face : described.faces) {
    if (face.name.empty() && face.given_number() > 0)
      name_of_number[face.number] = mesh::default_patch_name(face.given_number() - 1);
  }
  for (const model::NumberedName& face : named.faces) name_of_number[face.number] = face.name;
  for (const model::FaceDescription& face : described.faces) {
    const bool is_embedded =
        std::ranges::any_of(given.geometry.assembly.embedded,
                            [&](const model::EmbeddedShape& one) { return one.name == face.name; });
    if (is_embedded) name_of_number[face.number] = face.name;
  }
  named.faces.clear();
  for (const auto& [number, name] : name_of_number) named.faces.push_back({number, name});
}

// Centroid of the faces with some surface numbers, file length unit.
Vec3 centroid_of(const model::ModelDescription& model, const std::vector<LocalIndex>& surfaces)
{
  std::vector<std::array<Vec3, 3>> triangles;
  for (std::size_t t = 0; t < model.triangle_face.size(); ++t) {
    const LocalIndex surface = model.faces[at(model.triangle_face[t])].number - 1;
    if (std::ranges::find(surfaces, surface) == surfaces.end()) continue;
    triangles.push_back(corners_at<3>(model.vertex_xyz, model.triangle_vertices, t));
  }
  return tessera::centroid_of(triangles);
}

std::vector<surface::PeriodicPatches> periodic_patches(const model::ModelDescription& described,
                                                       const model::NamedParts& named,
                                                       const config::Case& given)
{
  std::vector<surface::PeriodicPatches> all;
  for (const topology::PeriodicSide& side : given.periodic) {
    const auto faces_of = [&](const std::string& pattern) {
      std::vector<LocalIndex> faces;
      for (const model::FaceDescription& face : described.faces) {
        if (matches_pattern(pattern, name_of(face, named))) faces.push_back(face.number - 1);
      }
      sort_unique(faces);
      return faces;
    };
    surface::PeriodicPatches patches{.from = faces_of(side.from), .to = faces_of(side.to)};
    if (patches.from.empty() || patches.to.empty()) continue;  // run_periodic_stage() will say so.
    patches.there = transform_of(
        side, given.geometry.scale
                  * (centroid_of(described, patches.to) - centroid_of(described, patches.from)));
    all.push_back(std::move(patches));
  }
  return all;
}

bool has_sides(const config::Case& given, model::Format format)
{
  return !given.periodic.empty() && format != model::Format::own;
}

bool has_embedded(const config::Case& given) { return !given.geometry.assembly.embedded.empty(); }

}  // namespace

JobResult<model::ModelDescription> describe_in_jobs(
    model::Format format,
    const std::function<JobResult<model::ModelDescription>(const std::string&, const Bytes&)>&
        run_describe)
{
  auto first = run_describe("describe", describe_request(surface::SurfaceMesher::netgen));
  if (format != model::Format::csg || !has_failed(first.end)) return first;
  auto second = run_describe("describe_remeshed", describe_request(surface::SurfaceMesher::remesh));
  return has_failed(second.end) ? std::move(first) : std::move(second);
}

model::ModelDescription describe_model(const config::Case& given, RunContext& context)
{
  const Bytes request = describe_request(surface::SurfaceMesher::netgen);
  return require_job({"describe", request, kDescribeLimits}, description_from_bytes,
                     what_is_described(given), context);
}

bool names_parts(const config::Case& given, model::Format format)
{
  const Patterns patterns = patterns_of(given);
  const bool keeps_parts =
      given.coarse.defeature > 0.0 && !(patterns.patches.empty() && patterns.curves.empty());
  return !given.geometry.names.empty() || keeps_parts || has_sides(given, format)
         || has_embedded(given);
}

PartsOfCase run_name_stage(const config::Case& given, model::Format format, RunContext& context)
{
  StageScope stage(context, Stage::names);
  PartsOfCase parts = comm::on_root(context.comm, [&] {
    return with_file_context(given, [&] {
      const auto run = [&](const std::string& name, const Bytes& request) {
        return run_describe(name, request, context);
      };
      const model::ModelDescription described =
          require_made(describe_in_jobs(format, run), what_is_described(given));
      PartsOfCase found{
          model::find_named_parts(described, given.geometry.names, given.geometry.scale)};
      if (has_embedded(given)) name_pieces(described, given, found.named);
      found.kept = kept_parts(described, found.named, patterns_of(given));
      if (has_sides(given, format))
        found.periodic = periodic_patches(described, found.named, given);
      return found;
    });
  });
  stage.work_is_done();
  stage.finish(
      fmt::format("{} faces, {} solids", parts.named.faces.size(), parts.named.solids.size()));
  return parts;
}

}  // namespace tessera::pipeline

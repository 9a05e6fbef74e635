// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/failed_jobs.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/base/version.hpp"
#include "tessera/io/files.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/report/places_page.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "tessera failed job";
constexpr std::size_t kMostKept = 16;          // Jobs of one rank.
constexpr std::uintmax_t kMostLog = 1U << 20;  // Bytes of the job's own words; the end counts.
constexpr jobs::JobLimits kSkinLimits{.cpu_s = 120.0, .stall_s = 30.0, .memory_gib = 8.0};

struct KeptJob {
  std::string name{};
  std::vector<std::string> loads{};  // Files of DIR/failure/inputs.
  Bytes request{};

  static auto fields(auto& self) { return std::tie(self.name, self.loads, self.request); }
};

// job.bin: by its first words readers know whether they can read the job.
struct JobFile {
  std::string mark{};
  std::string version{};  // record_version() of who wrote it.
  KeptJob job{};

  static auto fields(auto& self) { return std::tie(self.mark, self.version, self.job); }
};

std::string_view text_of(std::span<const std::byte> bytes)
{
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// "fill: subdomain 2" becomes fill_subdomain_2, and fill_subdomain_2.2 for the second such job.
fs::path make_job_folder(const fs::path& failure, const std::string& name)
{
  std::string word;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain) word += c;
    if (!is_plain && !word.empty() && word.back() != '_') word += '_';
  }
  for (int number = 1;; ++number) {
    fs::path folder = failure / (number == 1 ? word : fmt::format("{}.{}", word, number));
    if (fs::create_directory(folder)) return folder;
  }
}

std::string tail_of_log(const RunContext& context)
{
  std::ifstream in(context.jobs_log, std::ios::binary | std::ios::ate);
  if (!in) return {};
  const auto size = static_cast<std::uintmax_t>(in.tellg());
  const std::uintmax_t first =
      std::max(std::min(context.job_log_begin, size), size > kMostLog ? size - kMostLog : 0);
  in.seekg(static_cast<std::streamoff>(first));
  return {std::istreambuf_iterator<char>(in), {}};
}

// Many jobs have the same loads: each is written once, under its hash.
std::vector<std::string> write_loads(const fs::path& failure, const RunContext& context)
{
  std::vector<std::string> names;
  io::make_own_folder(failure / "inputs");
  for (const auto& [kind, message] : context.loads) {
    names.push_back(fmt::format("{}_{}.bin", kind, to_hex(hash_bytes(message.bytes()))));
    const fs::path file = failure / "inputs" / names.back();
    if (!fs::exists(fs::symlink_status(file)))
      io::write_text_atomically(file, text_of(message.bytes()));
  }
  return names;
}

// Runs `write` and makes a warning of what it cannot do.
template <class Write>
void try_to_keep(const RunContext& context, const Write& write)
{
  try {
    write();
  } catch (const Error& error) {
    context.log.warn(fmt::format("failure: {}", error.what()));
  } catch (const fs::filesystem_error& error) {
    context.log.warn(fmt::format("failure: {}", error.what()));
  }
}

Bytes read_file(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError(file.string() + ": cannot be read; replay takes a folder in DIR/failure");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

KeptJob parse_job(const Bytes& bytes)
{
  ByteReader in(bytes);
  if (in.get<std::string>() != kMark) throw InputError("is no job that a run has kept");
  const auto version = in.get<std::string>();
  if (version != record_version()) {
    throw InputError(fmt::format("was kept by version {}, this is {}", version, record_version()));
  }
  return from_bytes<JobFile>(bytes).job;
}

void write_coarse(const fs::path& file, const mesh::CoarseMesh& coarse,
                  const mesh::Decomposition& decomposition)
{
  if (fs::exists(fs::symlink_status(file))) return;
  mesh::MeshArrays arrays;
  arrays.point_xyz = coarse.vertex_xyz.to_vector();
  arrays.cell_points = coarse.tet_vertices.to_vector();
  for (const LocalIndex material : coarse.tet_material) {
    arrays.cell_ints["attribute"].push_back(coarse.body(material));
  }
  arrays.cell_ints["subdomain"] = decomposition.tet_subdomain.to_vector();
  io::write_vtu(arrays, file, io::Compression::none);
}

void write_skin(const fs::path& file, SkinMesh skin)
{
  mesh::MeshArrays arrays{.vertices_per_cell = 3};
  arrays.point_xyz = std::move(skin.vertex_xyz);
  arrays.cell_points = std::move(skin.triangle_vertices);
  io::write_vtu(arrays, file, io::Compression::none);
}

void write_region(const fs::path& file, const improve::RegionMesh& region)
{
  mesh::MeshArrays arrays;
  arrays.point_xyz = region.vertex_xyz;
  arrays.cell_points = region.tet_vertices;
  for (const LocalIndex owner : region.tet_owner) {
    arrays.cell_ints["subdomain"].push_back(region.subdomains[at(owner)]);
  }
  io::write_vtu(arrays, file, io::Compression::none);
}

}  // namespace

fs::path keep_failed_job(const JobRequest& job, const Bytes& request, const jobs::JobEnd& end,
                         RunContext& context)
{
  fs::path kept;
  if (context.num_failed_jobs_kept == kMostKept) return kept;
  try_to_keep(context, [&] {
    const fs::path failure = context.folder / "failure";
    io::make_own_folder(failure);
    const std::vector<std::string> loads = write_loads(failure, context);
    const fs::path folder = make_job_folder(failure, job.name);
    const JobFile job_file{std::string(kMark), record_version(), {job.name, loads, request}};
    io::write_text_atomically(folder / "job.bin", text_of(to_bytes(job_file)));
    io::write_text_atomically(folder / "log.txt", fmt::format("{}: {}\n\n{}", job.name, end.message,
                                                              tail_of_log(context)));
    ++context.num_failed_jobs_kept;
    kept = folder;
  });
  return kept;
}

void keep_if_failed(const JobRequest& job, const jobs::JobEnd& end, RunContext& context)
{
  using jobs::JobStatus;
  if (end.status == JobStatus::ok || end.status == JobStatus::cancelled) return;
  static_cast<void>(keep_failed_job(job, job.request, end, context));
}

void keep_meshes_of_failed_fill(const fs::path& kept, LocalIndex subdomain,
                                const mesh::CoarseMesh& coarse,
                                const mesh::Decomposition& decomposition,
                                const jobs::JobRunner::WaitCallback& on_wait, RunContext& context)
{
  if (kept.empty()) return;
  const jobs::JobOutcome skin = context.jobs.run(skin_request(subdomain), kSkinLimits, on_wait);
  try_to_keep(context, [&] {
    write_coarse(kept.parent_path() / "coarse.vtu", coarse, decomposition);
    if (skin.status == jobs::JobStatus::ok)
      write_skin(kept / "skin.vtu", from_bytes<SkinMesh>(skin.result));
  });
}

void keep_meshes_of_failed_region(const fs::path& kept,
                                  const std::function<improve::RegionMesh()>& extract,
                                  const mesh::CoarseMesh& coarse,
                                  const mesh::Decomposition& decomposition, RunContext& context)
{
  if (kept.empty()) return;
  try_to_keep(context, [&] {
    write_coarse(kept.parent_path() / "coarse.vtu", coarse, decomposition);
    write_region(kept / "region.vtu", extract());
  });
}

void keep_places(const fs::path& file, const std::string& message, RunContext& context)
{
  const auto places =
      read_result(context.jobs.run(places_request(file), kSkinLimits, wait_for_stop_signal()),
                  from_bytes<surface::SurfacePlaces>)
          .made;
  if (!places || places->places.empty()) return;
  try_to_keep(context, [&] {
    const fs::path failure = context.folder / "failure";
    io::make_own_folder(failure);
    io::write_vtu(places_arrays(*places), failure / "places.vtu", io::Compression::none);
    io::write_text_atomically(failure / "places.png", text_of(to_png(places_picture(*places))));
    io::write_text_atomically(failure / "places.html", places_page(file, message, *places));
    context.log.info(fmt::format("failure: {}: see {}", places_text(*places),
                                 (failure / "places.html").string()));
  });
}

RecordedJob read_failed_job(const fs::path& folder)
{
  const fs::path file = folder / "job.bin";
  KeptJob kept;
  try {
    kept = parse_job(read_file(file));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  RecordedJob job{.name = kept.name, .request = kept.request};
  for (const std::string& name : kept.loads) {
    if (fs::path(name).filename() != name) throw InputError(file.string() + ": is damaged");
    job.loads.push_back(
        read_file(fs::absolute(folder).lexically_normal() / ".." / "inputs" / name));
  }
  return job;
}

}  // namespace tessera::pipeline

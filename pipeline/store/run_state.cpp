// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/run_state.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/version.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

constexpr const char* kWayOut = "; --overwrite starts anew";

std::string first_difference(const std::string& there, const std::string& here)
{
  std::istringstream old_lines(there);
  std::istringstream new_lines(here);
  std::string old_line;
  std::string new_line;
  do {
    old_line.clear();
    new_line.clear();
    std::getline(old_lines, old_line);
    std::getline(new_lines, new_line);
  } while (old_line == new_line && (old_lines || new_lines));
  return fmt::format("`{}` there, `{}` now", old_line, new_line);
}

struct Identity {
  std::string version{};  ///< record_version() of who made the records.
  std::string model{};    ///< Hash of what was read of the model file.
  std::string field{};    ///< The same of size.field.
  std::vector<LocalIndex> only_subdomains{};
  bool has_files = true;
  std::string left_out{};  ///< TESSERA_LEAVE_OUT.

  static auto fields(auto& self)
  {
    return std::tie(self.version, self.model, self.field, self.only_subdomains, self.has_files,
                    self.left_out);
  }
};

// A folder in its place could not be read, and a link leads elsewhere.
bool is_own_file(const std::filesystem::path& file)
{
  std::error_code error;
  return std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error));
}

// What `read` finds in the report that a run has left there; nothing in one that is damaged.
template <class Read>
auto read_report(const std::filesystem::path& output, const Read& read)
    -> std::optional<decltype(read(nlohmann::json()))>
{
  if (!is_own_file(output / "report.json")) return std::nullopt;
  std::ifstream file(output / "report.json");
  try {
    return read(nlohmann::json::parse(file));
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

Identity identity(const InputContent& input, const std::vector<LocalIndex>& only_subdomains,
                  bool has_files)
{
  return {record_version(), to_hex(input.model), to_hex(input.field),
          only_subdomains,  has_files,           names_of(left_out_repairs())};
}

// What another version notes besides its name may be anything.
std::optional<Identity> recorded_identity(const Bytes& record)
{
  Identity noted{.version = ByteReader(record).get<std::string>()};
  return noted.version == record_version() ? from_bytes<Identity>(record) : noted;
}

// What the report of a run that has ended says. Whether pieces are in files does not matter then,
// since none are left: it counts as what is asked for.
std::optional<Identity> reported_identity(const std::filesystem::path& output, bool has_files)
{
  return read_report(output, [&](const nlohmann::json& report) {
    return Identity{record_version(report.at("version").get<std::string>()),
                    report.at("model").at("digest"),
                    report.value("size_field_digest", to_hex(Hash128{})),
                    report.at("only_subdomains").get<std::vector<LocalIndex>>(),
                    has_files,
                    report.value("left_out", "")};
  });
}

// In what the run of `now` is not that of `there`; empty if in nothing.
std::string change(const Identity& there, const Identity& now)
{
  if (there.version != now.version)
    return fmt::format("it was begun by version {}, this is {}", there.version, now.version);
  if (there.model != now.model) return "the model file has changed";
  if (there.field != now.field) return "the file of size.field has changed";
  if (there.only_subdomains != now.only_subdomains)
    return "it was begun with other --only-subdomains";
  if (there.left_out != now.left_out)
    return fmt::format("TESSERA_LEAVE_OUT has changed, '{}' there, '{}' now", there.left_out,
                       now.left_out);
  if (there.has_files == now.has_files) return {};
  return now.has_files ? "its pieces were to be handed over, not to go into files"
                       : "its mesh was to go into files";
}

// All pieces of the mesh are where it says.
bool has_all_pieces(const std::filesystem::path& mesh_file)
{
  return std::ranges::all_of(io::piece_files(mesh_file), [](const std::filesystem::path& piece) {
    return std::filesystem::is_regular_file(piece);
  });
}

}  // namespace

config::Case without_limits(config::Case run_case)
{
  const config::Case plain;
  run_case.output.directory = plain.output.directory;
  run_case.output.report_html = plain.output.report_html;
  run_case.coarse.timeout_s = plain.coarse.timeout_s;
  run_case.fill.timeout_s = plain.fill.timeout_s;
  run_case.fill.memory_gib = plain.fill.memory_gib;
  return run_case;
}

io::RecordStore RunState::store() const { return io::RecordStore(store_folder(output_)); }

void RunState::require_begun() const
{
  std::error_code error;
  if (std::filesystem::is_directory(output_, error) && !std::filesystem::is_empty(output_, error)) {
    return;
  }
  throw InputError(fmt::format("cannot resume {}: no run has begun there", output_.string()));
}

void RunState::require_same_case(const config::Case& given) const
{
  const auto file = output_ / "case.toml";
  if (!is_own_file(file)) return;
  const std::string there = config::to_toml(without_limits(config::load_case(file)));
  const std::string here = config::to_toml(without_limits(given));
  if (there != here) {
    throw InputError(fmt::format("cannot resume {}: the case has changed, {}{}", output_.string(),
                                 first_difference(there, here), kWayOut));
  }
}

bool RunState::has_made(config::Case given) const
{
  std::error_code error;  // A refused --resume leaves the folder of the store, with nothing in it.
  const std::filesystem::path records = store_folder(output_);
  const bool is_ended =
      (!std::filesystem::exists(records, error) || std::filesystem::is_empty(records, error))
      && finished();
  if (!is_ended || !is_own_file(output_ / "case.toml")) return false;
  try {
    const config::Case there = config::load_case(output_ / "case.toml");
    given.output.directory = there.output.directory;  // Each may name the folder in its own way.
    return config::to_toml(there) == config::to_toml(given) && has_all_pieces(output_ / "mesh.pvtu")
           && has_all_pieces(output_ / "boundary.pvtu")
           && (!is_own_file(output_ / "lines.pvtu") || has_all_pieces(output_ / "lines.pvtu"));
  } catch (const Error&) {  // Then the folder is refused, as any other that is not empty.
    return false;
  }
}

void RunState::require_same_input(const InputContent& input) const
{
  const auto noted = reported_identity(output_, has_files_);
  const std::string what = noted ? change(*noted, identity(input, only_subdomains_, has_files_))
                                 : "its report names no model that it was made of";
  if (what.empty()) return;
  throw OutputError(
      fmt::format("folder {} exists and is not empty: it holds a run of the same case, but {}{}",
                  output_.string(), what, kWayOut));
}

void RunState::require_same_run(const InputContent& input) const
{
  const Identity now = identity(input, only_subdomains_, has_files_);
  const std::optional<Bytes> record = store().find("run");
  const auto noted = record ? recorded_identity(*record) : reported_identity(output_, has_files_);
  if (!noted) {
    clear();
    return store().put("run", to_bytes(now));
  }
  const std::string what = change(*noted, now);
  if (what.empty()) return;
  throw InputError(fmt::format("cannot resume {}: {}{}", output_.string(), what, kWayOut));
}

void RunState::keep_coarse(std::span<const std::byte> coarse) const
{
  store().put("coarse", coarse);
}

std::optional<Bytes> RunState::find_coarse() const { return store().find("coarse"); }

void RunState::keep_plan(const Plan& plan) const { store().put("plan", to_bytes(plan)); }

std::optional<Plan> RunState::find_plan() const
{
  const auto bytes = store().find("plan");
  return bytes ? std::optional(from_bytes<Plan>(*bytes)) : std::nullopt;
}

std::optional<MeshResult> RunState::finished() const
{
  if (!is_own_file(output_ / "mesh.pvtu")) return std::nullopt;
  const auto result = read_report(output_, [&](const nlohmann::json& report) {
    const std::string status = report.at("status");
    if (status != "ok" && status != "degraded") return std::optional<MeshResult>();
    const nlohmann::json& whole = report.contains("whole_mesh") ? report["whole_mesh"] : report;
    return std::optional(
        MeshResult{.status = status == "ok" ? MeshStatus::ok : MeshStatus::degraded,
                   .reason = report.at("reason"),
                   .num_vertices = whole.at("num_vertices"),
                   .num_tets = report.at("num_tets"),
                   .num_subdomains = report.at("num_subdomains"),
                   .volume = report.at("volume"),
                   .digest = report.at("digest"),
                   .folder = output_});
  });
  return result.value_or(std::nullopt);
}

void RunState::clear() const { store().remove_all(); }

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/part_report.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "tessera/base/version.hpp"
#include "tessera/comm/mpi_version.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/migrate/partition.hpp"

namespace tessera::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json parts_json(const RepartitionFigures& figures)
{
  Json parts = Json::array();
  for (std::size_t p = 0; p < figures.parts.size(); ++p) {
    const migrate::PartFigures& part = figures.parts[p];
    parts.push_back({{"id", p},
                     {"tets", part.num_tets},
                     {"boundary_triangles", part.num_boundary},
                     {"cut_triangles", part.num_cut_triangles},
                     {"components", part.num_components},
                     {"volume", part.volume}});
  }
  return parts;
}

Json steps_json(const RepartitionFigures& figures)
{
  Json steps = Json::array();
  for (const StepTime& step : figures.steps) {
    steps.push_back({{"name", step.name}, {"wall_time_s", step.wall_s}});
  }
  return steps;
}

double volume_of(const RepartitionFigures& figures)
{
  double volume = 0.0;
  for (const migrate::PartFigures& part : figures.parts) volume += part.volume;
  return volume;
}

}  // namespace

GlobalIndex RepartitionFigures::num_tets() const
{
  GlobalIndex num = 0;
  for (const migrate::PartFigures& part : parts) num += part.num_tets;
  return num;
}

GlobalIndex RepartitionFigures::num_cut_triangles() const
{
  GlobalIndex num_sides = 0;
  for (const migrate::PartFigures& part : parts) num_sides += part.num_cut_triangles;
  return num_sides / 2;
}

GlobalIndex RepartitionFigures::largest_part() const
{
  GlobalIndex largest = 0;
  for (const migrate::PartFigures& part : parts) largest = std::max(largest, part.num_tets);
  return largest;
}

double RepartitionFigures::balance() const
{
  const double average = static_cast<double>(num_tets()) / static_cast<double>(parts.size());
  return static_cast<double>(largest_part()) / average;
}

GlobalIndex RepartitionFigures::num_disconnected() const
{
  return std::ranges::count_if(
      parts, [](const migrate::PartFigures& part) { return part.num_components > 1; });
}

std::string repartition_json(ExitCode exit_code, const std::string& reason,
                             const RepartitionFigures& figures)
{
  Json json{{"schema", 1},
            {"version", version()},
            {"status", status_name(exit_code)},
            {"exit_code", static_cast<int>(exit_code)},
            {"reason", reason},
            {"mesh", figures.mesh_file},
            {"num_ranks", figures.num_ranks}};
  if (!figures.parts.empty()) {
    json["num_parts"] = figures.parts.size();
    json["ghost_layers"] = figures.num_ghost_layers;
    json["num_tets"] = figures.num_tets();
    json["num_vertices"] = figures.num_vertices;
    json["volume"] = volume_of(figures);
    json["tets_digest"] = to_hex(figures.tets_digest);
    json["balance"] = figures.balance();
    json["cut_triangles"] = figures.num_cut_triangles();
    json["disconnected_parts"] = figures.num_disconnected();
    json["partition"] = {{"tries", figures.cut.num_tries}, {"rounds", figures.cut.num_rounds}};
    json["migration"] = {{"messages", figures.traffic.num_messages},
                         {"bytes", figures.traffic.num_bytes}};
    json["parts"] = parts_json(figures);
  }
  json["notes"] = figures.notes;
  json["wall_time_s"] = figures.wall_time_s;
  json["stages"] = steps_json(figures);
  json["libraries"] = {{"ptscotch", migrate::scotch_version()},
                       {"vtk", io::vtk_version()},
                       {"mpi", comm::mpi_version()}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tessera::pipeline

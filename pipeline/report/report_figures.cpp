// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "pipeline/report/html.hpp"
#include "pipeline/report/report_parts.hpp"

namespace tessera::pipeline {
namespace {

constexpr const char* kMissing = "–";

std::string form_text(double value, FigureForm form)
{
  switch (form) {
    case FigureForm::count:
      return grouped(static_cast<GlobalIndex>(value));
    case FigureForm::seconds:
      return duration_text(value);
    case FigureForm::bytes:
      return bytes_text(value);
    case FigureForm::degrees:
      return fmt::format("{:.1f}°", value);
    case FigureForm::plain:
      break;
  }
  constexpr double kLarge = 1e4;  // From here on digits before the point are enough.
  constexpr double kLargest = 1e15;
  const double size = std::abs(value);
  if (size >= kLarge && size < kLargest) return grouped(std::llround(value));
  return fmt::format("{:.5g}", value);
}

}  // namespace

Report::Report(const ReportSource& from) : source(from)
{
  json = Json::parse(from.json, nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains("status")
      || !json["status"].is_string() || json.value("schema", Json(0)) != 1) {
    throw InputError(from.folder.string() + ": report.json is damaged, or of another version");
  }
}

const Json* Report::find(const char* pointer) const
{
  const Json::json_pointer place(pointer);
  return json.contains(place) ? &json.at(place) : nullptr;
}

std::optional<double> Report::number(const char* pointer) const
{
  const Json* const found = find(pointer);
  if (found == nullptr || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::string Report::text(const char* pointer) const
{
  const Json* const found = find(pointer);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

std::vector<std::string> Report::texts(const char* pointer) const
{
  std::vector<std::string> texts;
  const Json* const found = find(pointer);
  if (found == nullptr || !found->is_array()) return texts;
  for (const Json& text : *found) {
    if (text.is_string()) texts.push_back(text.get<std::string>());
  }
  return texts;
}

std::vector<GlobalIndex> Report::counts(const char* pointer) const
{
  std::vector<GlobalIndex> counts;
  const Json* const found = find(pointer);
  if (found == nullptr || !found->is_array()) return counts;
  for (const Json& count : *found) {
    counts.push_back(count.is_number_integer() ? count.get<GlobalIndex>() : 0);
  }
  return counts;
}

const std::vector<KeyFigure>& key_figures()
{
  using enum FigureForm;
  using enum BetterValue;
  static const std::vector<KeyFigure> kFigures{
      {"tets", "/num_tets", count, neither},
      {"vertices", "/num_vertices", count, neither},
      {"subdomains", "/num_subdomains", count, neither},
      {"volume", "/volume", plain, neither},
      {"worst mean ratio", "/quality/mean_ratio/min", plain, higher},
      {"average mean ratio", "/quality/mean_ratio/mean", plain, higher},
      {"smallest angle", "/quality/min_dihedral_deg", degrees, higher},
      {"largest angle", "/quality/max_dihedral_deg", degrees, lower},
      {"median edge length", "/quality/edge_length/median", plain, neither},
      {"ranks", "/num_ranks", count, neither},
      {"wall time", "/wall_time_s", seconds, lower},
      {"tets per second", "/tets_per_second", count, higher},
      {"memory of a rank", "/peak_rss_bytes_max", bytes, lower},
  };
  return kFigures;
}

std::string figure_text(const Report& report, const KeyFigure& figure)
{
  const auto value = report.number(figure.pointer);
  return value ? form_text(*value, figure.form) : kMissing;
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "pipeline/report/html.hpp"

namespace tessera::pipeline {
namespace {

constexpr const char* kMissing = "–";

constexpr const char* kBusyColour = "#2f6fb2";
constexpr const char* kUnevenColour = "#e09a3e";
constexpr const char* kIdleColour = "#d5dbe2";
constexpr const char* kAloneColour = "#8e7cc3";

constexpr Colour kSmallestColour{47, 111, 178};
constexpr Colour kLargestColour{224, 154, 62};

// By exit code, for what the message itself cannot know.
std::string way_out(const Report& report)
{
  const std::string folder = shell_word(report.source.folder.string());
  switch (static_cast<int>(report.number("/exit_code").value_or(0.0))) {
    case 2:
      return fmt::format(
          "What failed is in the folder {0}/failure, if a job failed: log.txt says why, the .vtu "
          "files show where, and tessera replay repeats it. A smaller coarse.max_size, or another "
          "number of decompose.subdomains, often helps.",
          folder);
    case 64:
      return "Correct what the message names, and run again.";
    case 73:
      return "Make room on the disk, or give permission to write there. Then the same command goes "
             "on with --resume: what was finished is kept.";
    case 75:
      return "The run was stopped from outside. The same command goes on with --resume, with any "
             "number of ranks: what was finished is kept.";
    default:
      return fmt::format("This is a defect of the program. Please report it, with {}/log.", folder);
  }
}

std::string list_html(const std::vector<std::string>& items)
{
  std::string html = "<ul>";
  for (const std::string& item : items) html += "<li>" + escaped(item) + "</li>";
  return html + "</ul>\n";
}

std::string swatch(const std::string& colour)
{
  return fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>", colour);
}

std::string patch_legend(const Report& report)
{
  constexpr std::size_t kMost = 24;  // Then colours repeat.
  const std::vector<std::string> names = report.texts("/patch_names");
  if (names.empty()) return {};
  std::string html = "<ul class=\"legend\">";
  const std::vector<Colour>& colours = distinct_colours();
  for (std::size_t p = 0; p < std::min(names.size(), kMost); ++p) {
    html += fmt::format("<li>{}{}</li>", swatch(css_colour(colours[p % colours.size()])),
                        escaped(names[p]));
  }
  if (names.size() > kMost) {
    html += fmt::format("<li>and {} more; colours repeat</li>", names.size() - kMost);
  }
  return html + "</ul>";
}

std::string quality_legend()
{
  std::string html = "<ul class=\"legend\">";
  const std::vector<Colour>& colours = quality_colours();
  for (std::size_t bin = 0; bin < colours.size(); ++bin) {
    const double low = 0.1 * static_cast<double>(bin);
    html +=
        fmt::format("<li>{}{:.1f}–{:.1f}</li>", swatch(css_colour(colours[bin])), low, low + 0.1);
  }
  return html + "</ul>";
}

std::string figure_html(const Report& report, const std::string& name, const std::string& caption)
{
  return fmt::format(
      "<figure><img id=\"picture-{0}\" alt=\"{1}\" "
      "src=\"data:image/png;base64,{2}\"><figcaption>{1}</figcaption>{3}</figure>\n",
      name, escaped(caption), report.source.pictures.at(name),
      name == "patches" ? patch_legend(report)
      : name == "cut"   ? quality_legend()
                        : std::string());
}

std::string cut_caption(const Report& report)
{
  constexpr double kDrawnInFull = 1e6;  // Tets: so many are read back in any case.
  std::string caption =
      "Cut open: the tets that a plane meets, by mean ratio. Red is bad, blue is good.";
  if (report.number("/num_tets").value_or(0.0) > kDrawnInFull) {
    caption +=
        " Where there are too many to draw them all, large coarse tets stand for them, with the "
        "average of their subdomain.";
  }
  return caption;
}

std::vector<Colour> colours_of_bins(std::size_t num_bins)
{
  const std::vector<Colour>& tenths = quality_colours();
  std::vector<Colour> colours;
  for (std::size_t b = 0; b < num_bins; ++b) {
    colours.push_back(tenths[b * tenths.size() / num_bins]);
  }
  return colours;
}

std::string mean_ratio_figure(const Report& report)
{
  const std::vector<GlobalIndex> counts = report.counts("/quality/mean_ratio/histogram");
  if (counts.empty()) return {};
  return "<figure><h3>Mean ratio</h3>"
         + histogram_svg({.title = "mean ratio of a tet"},
                         {{"mean ratio", counts, colours_of_bins(counts.size())}})
         + fmt::format(
             "<figcaption>1 is the regular tet, 0 a flat one. Worst {:.3f}, mean {:.3f}; one tet "
             "in a hundred is below {:.3f}.</figcaption></figure>\n",
             report.number("/quality/mean_ratio/min").value_or(0.0),
             report.number("/quality/mean_ratio/mean").value_or(0.0),
             report.number("/quality/mean_ratio/p01").value_or(0.0));
}

std::string angle_figure(const Report& report)
{
  const auto smallest = report.counts("/quality/dihedral_deg_histogram/smallest_of_tet");
  const auto largest = report.counts("/quality/dihedral_deg_histogram/largest_of_tet");
  if (smallest.empty() || largest.empty()) return {};
  return "<figure><h3>Dihedral angles</h3>"
         + histogram_svg({.title = "angle between two faces of a tet",
                          .unit = "°",
                          .high = 180.0,
                          .num_ticks = 6},
                         {{"smallest angle", smallest, {kSmallestColour}},
                          {"largest angle", largest, {kLargestColour}}})
         + fmt::format(
             "<figcaption>{}Smallest angle of each tet {}largest angle of each tet. All lie "
             "between {:.1f}° and {:.1f}°; those of the regular tet are "
             "70.5°.</figcaption></figure>\n",
             swatch(css_colour(kSmallestColour)), swatch(css_colour(kLargestColour)),
             report.number("/quality/min_dihedral_deg").value_or(0.0),
             report.number("/quality/max_dihedral_deg").value_or(0.0));
}

struct Stage {
  std::string name{};
  double wall_s = 0.0;
  double least_s = 0.0;  // Of a rank at work.
  double most_s = 0.0;
};

std::vector<Stage> stages_of(const Report& report)
{
  std::vector<Stage> stages;
  const Json* const found = report.find("/stages");
  if (found == nullptr) return stages;
  for (const Json& stage : *found) {
    Stage one{stage.value("name", ""), stage.value("wall_time_s", 0.0),
              stage.value("rank_min_s", 0.0), stage.value("rank_max_s", 0.0)};
    one.most_s = std::min(one.most_s, one.wall_s);
    one.least_s = std::min(one.least_s, one.most_s);
    stages.push_back(std::move(one));
  }
  return stages;
}

// What only rank 0 does, with its jobs.
bool is_of_one_rank(const Stage& stage)
{
  constexpr std::array<const char*, 7> kNames{"model",  "names",  "size",     "cut",
                                              "coarse", "levels", "decompose"};
  return std::ranges::find(kNames, stage.name) != kNames.end();
}

std::vector<BarPart> stage_parts(const Stage& stage, bool is_parallel)
{
  if (is_parallel && is_of_one_rank(stage)) {
    return {{stage.wall_s, kAloneColour, "rank 0 alone, all others wait"}};
  }
  return {{stage.least_s, kBusyColour, "all ranks at work"},
          {stage.most_s - stage.least_s, kUnevenColour, "some ranks at work, others wait"},
          {stage.wall_s - stage.most_s, kIdleColour, "exchange of results"}};
}

std::string stage_note(const Stage& stage, bool is_parallel)
{
  const double waited = stage.most_s - stage.least_s;
  std::string note = duration_text(stage.wall_s);
  if (is_parallel && !is_of_one_rank(stage) && waited >= 0.05 && waited >= 0.05 * stage.wall_s) {
    note += fmt::format("; a rank waited {} ({:.0f} %)", duration_text(waited),
                        100.0 * waited / stage.wall_s);
  }
  return note;
}

// A stage of some length in which a rank had much less to do than another.
std::vector<std::string> imbalance_advice(const Report& report)
{
  std::vector<std::string> advice;
  const double wall_s = report.number("/wall_time_s").value_or(0.0);
  if (report.number("/num_ranks").value_or(1.0) < 2.0) return advice;
  for (const Stage& stage : stages_of(report)) {
    const double waited = stage.most_s - stage.least_s;
    if (is_of_one_rank(stage) || waited < 0.1 * wall_s || waited < 0.3 * stage.most_s) continue;
    advice.push_back(fmt::format(
        "In the stage {} a rank had nothing to do for {} of {}. More decompose.subdomains make "
        "smaller jobs, which are easier to share out; or use fewer ranks.",
        stage.name, duration_text(waited), duration_text(stage.wall_s)));
  }
  return advice;
}

std::optional<std::string> merge_advice(const Report& report)
{
  const auto num = report.number("/coarse/defeatured/num_vertices");
  const double num_edges = report.number("/coarse/defeatured/num_edges").value_or(0.0);
  const double num_faces = report.number("/coarse/defeatured/num_faces").value_or(0.0);
  if (!num || num_edges + num_faces + *num == 0.0) return std::nullopt;
  return fmt::format(
      "What is smaller than size.min was merged: {:.0f} edges and {:.0f} faces of the model. "
      "Therefore {:.0f} vertices of the coarse mesh are off the geometry, by at most {:.3g}. That "
      "is no defect.",
      num_edges, num_faces, *num, report.number("/coarse/defeatured/distance_max").value_or(0.0));
}

std::vector<std::string> failure_advice(const Report& report)
{
  std::vector<std::string> advice;
  if (const auto tries = report.number("/coarse/tries");
      tries && !report.texts("/coarse/failures").empty()) {
    advice.push_back(
        fmt::format("The coarse mesh took {:.0f} tries. The first failure was: {}. The mesh is "
                    "sound; another coarse.max_size may spare the tries.",
                    *tries, report.texts("/coarse/failures").front()));
  }
  if (const Json* const subdomains = report.find("/subdomains")) {
    const auto has_failed = [](const Json& one) { return one.contains("failures"); };
    if (const auto num = std::ranges::count_if(*subdomains, has_failed); num > 0) {
      advice.push_back(fmt::format(
          "{} of {} subdomains took more than one try. The block subdomains of report.json has the "
          "messages. Their tets were checked like all others; there is nothing to do unless their "
          "quality is poor.",
          num, subdomains->size()));
    }
  }
  if (const auto failed = report.number("/improve/failed"); failed && *failed > 0.0) {
    advice.push_back(fmt::format(
        "The improvement of {:.0f} seams failed; their tets stayed as they were filled. "
        "The folder failure has the details.",
        *failed));
  }
  return advice;
}

// The number of a row from 1, and where its tet is.
std::vector<std::string> place_of(const Json& tet, std::size_t row)
{
  const Json centre = tet.value("centre", Json::array());
  std::vector<std::string> cells{std::to_string(row + 1)};
  for (std::size_t c = 0; c < 3; ++c) {
    cells.push_back(c < centre.size() ? fmt::format("{:.6g}", centre[c].get<double>()) : kMissing);
  }
  return cells;
}

}  // namespace

std::string verdict_html(const Report& report)
{
  const std::string status = report.text("/status");
  std::string body;
  if (status == "ok") {
    body = "<strong>✓ OK</strong><p>A valid mesh is saved, and every wanted target was met.</p>";
  } else if (status == "degraded") {
    std::vector<std::string> reasons = report.texts("/reasons");
    if (reasons.empty()) reasons.push_back(report.text("/reason"));
    body =
        "<strong>⚠ Degraded</strong><p>A valid mesh is saved, but something that was wanted "
        "could not be had:</p>"
        + list_html(reasons);
  } else {
    const double code = report.number("/exit_code").value_or(0.0);
    body = fmt::format(
        "<strong>✗ {}</strong><p>There is no finished mesh. Exit code {:.0f}.</p><pre>{}</pre>"
        "<p><b>What to do:</b> {}</p>",
        code == 75.0 ? "Stopped" : "Failed", code, escaped(report.text("/reason")),
        escaped(way_out(report)));
  }
  const char* const kind = status == "ok" ? "ok" : status == "degraded" ? "degraded" : "failed";
  return fmt::format("<div class=\"verdict {0}\" data-status=\"{1}\">{2}</div>\n", kind,
                     escaped(status), body);
}

std::vector<std::string> picture_figures(const Report& report)
{
  const std::vector<std::pair<std::string, std::string>> captions{
      {"subdomains", fmt::format("The outside by subdomain: {} of them were made one by one.",
                                 figure_text(report, key_figures()[2]))},
      {"patches",
       "The outside by patch: the faces of the geometry, to which a solver's boundary "
       "conditions go."},
      {"cut", cut_caption(report)}};
  std::vector<std::string> figures;
  for (const auto& [name, caption] : captions) {
    if (report.source.pictures.contains(name))
      figures.push_back(figure_html(report, name, caption));
  }
  return figures;
}

std::vector<std::string> quality_figures(const Report& report)
{
  std::vector<std::string> figures{mean_ratio_figure(report), angle_figure(report)};
  std::erase(figures, std::string());
  return figures;
}

double longest_stage_s(const Report& report)
{
  double longest = 0.0;
  for (const Stage& stage : stages_of(report)) longest = std::max(longest, stage.wall_s);
  return longest;
}

std::string stages_html(const Report& report, double full, double width)
{
  const bool is_parallel = report.number("/num_ranks").value_or(1.0) > 1.0;
  std::vector<Bar> bars;
  for (const Stage& stage : stages_of(report)) {
    Bar& bar = bars.emplace_back();
    bar.name = stage.name;
    bar.note = stage_note(stage, is_parallel);
    bar.parts = stage_parts(stage, is_parallel);
  }
  return bars.empty() ? std::string() : bars_svg({"Times of the stages", full, width}, bars);
}

std::string stages_legend()
{
  return fmt::format(
      "<ul class=\"legend\"><li>{}all ranks at work</li><li>{}some ranks at work, others "
      "wait</li><li>{}exchange of results</li><li>{}rank 0 alone, all others wait</li></ul>\n",
      swatch(kBusyColour), swatch(kUnevenColour), swatch(kIdleColour), swatch(kAloneColour));
}

std::string sharp_tets_html(const Report& report)
{
  const Json* const worst = report.find("/coarse/sharp/worst");
  if (worst == nullptr || worst->empty()) return {};
  std::vector<std::vector<std::string>> rows;
  for (const Json& tet : *worst) {
    std::vector<std::string> row = place_of(tet, rows.size());
    row.push_back(fmt::format("{:.2f}°", tet.value("min_dihedral_deg", 0.0)));
    const auto patches = tet.value("patches", std::vector<std::string>());
    row.push_back(escaped(fmt::format("{}", fmt::join(patches, ", "))));
    rows.push_back(std::move(row));
  }
  return table_html({"tet", "x", "y", "z", "smallest angle", "patches"}, rows);
}

std::string worst_tets_html(const Report& report)
{
  const Json* const worst = report.find("/quality/worst");
  if (worst == nullptr || worst->empty()) return {};
  std::vector<std::vector<std::string>> rows;
  for (const Json& tet : *worst) {
    std::vector<std::string> row = place_of(tet, rows.size());
    row.push_back(std::to_string(tet.value("subdomain", 0)));
    row.push_back(fmt::format("{:.4f}", tet.value("mean_ratio", 0.0)));
    row.push_back(fmt::format("{:.2f}°", tet.value("min_dihedral_deg", 0.0)));
    row.push_back(fmt::format("{:.2f}°", tet.value("max_dihedral_deg", 0.0)));
    rows.push_back(std::move(row));
  }
  return table_html(
      {"tet", "x", "y", "z", "subdomain", "mean ratio", "smallest angle", "largest angle"}, rows);
}

std::vector<std::string> advice_of(const Report& report)
{
  std::vector<std::string> advice = report.texts("/warnings");
  for (const std::string& repair : report.texts("/model/repairs")) {
    advice.push_back("The model file was repaired: " + repair
                     + ". Look at the pictures: is it what you meant?");
  }
  if (const auto num = report.number("/points_within_tolerance/num"); num && *num > 0.0) {
    advice.push_back(fmt::format(
        "{:.0f} vertices of the coarse mesh are off the geometry by at most {:.3g}, which is "
        "within "
        "the tolerance of the CAD file, or next to nothing of their edges. That is no defect.",
        *num, report.number("/points_within_tolerance/distance_max").value_or(0.0)));
  }
  if (auto merged = merge_advice(report)) advice.push_back(std::move(*merged));
  for (std::string& one : failure_advice(report)) advice.push_back(std::move(one));
  if (const Json* const same = report.find("/reproducible"); same != nullptr && *same == false) {
    advice.emplace_back(
        "A try ended for time or memory, so another machine may give another mesh. Raise "
        "fill.timeout_s, fill.memory_gib or coarse.timeout_s if you need the same one everywhere.");
  }
  for (std::string& one : imbalance_advice(report)) advice.push_back(std::move(one));
  if (report.text("/reason").find("< wanted") != std::string::npos) {
    advice.emplace_back(
        "A wanted quality was missed. The table above says where the worst tets are. A smaller "
        "coarse.max_size, coarse.optimize = true or another fill.kernel makes better ones; the "
        "shapes of small features of the model set a limit.");
  }
  constexpr double kPoor = 0.1;
  if (const auto least = report.number("/quality/mean_ratio/min"); least && *least < kPoor) {
    advice.push_back(fmt::format(
        "The worst tet has a mean ratio of {:.3g}, which some solvers do not like. The table above "
        "says where it is. A smaller coarse.max_size, coarse.optimize = true or another kernel "
        "often helps.",
        *least));
  }
  return advice;
}

}  // namespace tessera::pipeline

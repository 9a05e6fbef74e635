// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "pipeline/report/html.hpp"
#include "pipeline/report/report_page.hpp"
#include "pipeline/report/report_parts.hpp"

namespace tessera::pipeline {
namespace {

// Smaller differences are those of rounding, or of a machine that does other things too.
constexpr double kNoticeable = 0.01;

enum class Change { none, better, worse, other };

struct Difference {
  KeyFigure figure{};
  std::string a{};
  std::string b{};
  std::string ratio{};  // B over A.
  Change change = Change::none;
};

Change change_of(double a, double b, BetterValue better)
{
  if (std::abs(b - a) <= kNoticeable * std::max(std::abs(a), std::abs(b))) return Change::none;
  if (better == BetterValue::neither) return Change::other;
  return (b > a) == (better == BetterValue::higher) ? Change::better : Change::worse;
}

std::vector<Difference> differences_of(const Report& a, const Report& b)
{
  std::vector<Difference> rows;
  for (const KeyFigure& figure : key_figures()) {
    const auto left = a.number(figure.pointer);
    const auto right = b.number(figure.pointer);
    if (!left && !right) continue;
    Difference& row = rows.emplace_back();
    row.figure = figure;
    row.a = figure_text(a, figure);
    row.b = figure_text(b, figure);
    row.ratio = "–";
    if (!left || !right) continue;
    row.change = change_of(*left, *right, figure.better);
    if (*left != 0.0) row.ratio = fmt::format("{:.3f}", *right / *left);
  }
  return rows;
}

const char* word_of_change(Change change)
{
  switch (change) {
    case Change::better:
      return "better";
    case Change::worse:
      return "worse";
    case Change::other:
      return "other";
    case Change::none:
      break;
  }
  return "";
}

// Of the meshes, not of the runs.
std::string sameness(const Report& a, const Report& b)
{
  const std::string left = a.text("/digest");
  const std::string right = b.text("/digest");
  if (left.empty() || right.empty()) return "There are no two meshes to compare.";
  return left == right ? "The two meshes are the same, bit for bit." : "The two meshes differ.";
}

std::string figures_table(const Report& a, const Report& b)
{
  std::string html =
      "<div class=\"scroll\"><table><thead><tr><th scope=\"col\">figure</th><th "
      "scope=\"col\">A</th>"
      "<th scope=\"col\">B</th><th scope=\"col\">B / A</th></tr></thead><tbody>\n";
  for (const Difference& row : differences_of(a, b)) {
    const std::string word = word_of_change(row.change);
    const std::string kind = word.empty() ? "" : fmt::format(" class=\"{}\"", word);
    const bool is_judged = row.change == Change::better || row.change == Change::worse;
    html += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}{}</td></tr>\n", kind,
                        row.figure.name, row.a, row.b, row.ratio, is_judged ? " " + word : "");
  }
  return html + "</tbody></table></div>\n"
         + "<p class=\"soft\">Coloured: differs by more than one per cent. Better and worse are B "
           "against A.</p>\n";
}

std::string heading_of(const char* letter, const Report& report)
{
  return fmt::format("<h3>{}: {}</h3><p class=\"soft\">{}</p>", letter,
                     escaped(report.source.folder.string()), escaped(report.text("/case")));
}

// The same part of both, side by side. An empty part leaves its place empty.
std::string pair_html(const std::string& a, const std::string& b)
{
  if (a.empty() && b.empty()) return {};
  return fmt::format("<div class=\"pair\"><div>{}</div><div>{}</div></div>\n", a, b);
}

std::string pairs_html(const std::vector<std::string>& a, const std::vector<std::string>& b)
{
  std::string html;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    html += pair_html(i < a.size() ? a[i] : "", i < b.size() ? b[i] : "");
  }
  return html;
}

// Pictures of two runs have the same ids in their own pages.
std::vector<std::string> pictures_of(const Report& report, const std::string& letter)
{
  std::vector<std::string> figures = picture_figures(report);
  for (std::string& figure : figures) {
    const std::string id = "id=\"picture-";
    const std::size_t place = figure.find(id);
    if (place != std::string::npos) figure.insert(place + id.size(), letter + "-");
  }
  return figures;
}

std::string stage_bars(const Report& a, const Report& b)
{
  constexpr double kHalf = 520.0;  // Pixels.
  const double full = std::max(longest_stage_s(a), longest_stage_s(b));
  const std::string bars = pair_html(stages_html(a, full, kHalf), stages_html(b, full, kHalf));
  return bars.empty() ? bars : bars + stages_legend();
}

std::string short_status(const char* letter, const Report& report)
{
  std::string text =
      fmt::format("{}: {} ({})", letter, report.text("/status"), report.source.folder.string());
  if (const std::string reason = report.text("/reason"); !reason.empty()) text += ": " + reason;
  return text + "\n";
}

}  // namespace

std::string compare_page(const ReportSource& source_a, const ReportSource& source_b)
{
  const Report a(source_a);
  const Report b(source_b);
  std::string body =
      fmt::format("<header><h1>Two runs side by side</h1><p>{}</p></header>\n", sameness(a, b));
  body += pair_html(heading_of("A", a) + verdict_html(a), heading_of("B", b) + verdict_html(b));
  body += section_html("Key figures", figures_table(a, b));
  body += section_html("Pictures", pairs_html(pictures_of(a, "a"), pictures_of(b, "b")));
  body += section_html("Quality", pairs_html(quality_figures(a), quality_figures(b)));
  body += section_html("Time, and who waited", stage_bars(a, b));
  const std::string worst_a = worst_tets_html(a);
  const std::string worst_b = worst_tets_html(b);
  body += section_html("The ten worst tets of A", worst_a);
  body += section_html("The ten worst tets of B", worst_b);
  return page_html("Tessera: two runs side by side", body);
}

std::string compare_text(const ReportSource& source_a, const ReportSource& source_b)
{
  const Report a(source_a);
  const Report b(source_b);
  std::string text = short_status("A", a) + short_status("B", b) + sameness(a, b) + "\n\n"
                     + fmt::format("{:<20}{:>16}{:>16}{:>10}\n", "", "A", "B", "B / A");
  for (const Difference& row : differences_of(a, b)) {
    const std::string line =
        fmt::format("{:<20}{:>16}{:>16}{:>10}", row.figure.name, row.a, row.b, row.ratio);
    const std::string word = row.change == Change::other ? "" : word_of_change(row.change);
    text += line + (word.empty() ? "" : "  " + word) + "\n";
  }
  return text;
}

}  // namespace tessera::pipeline

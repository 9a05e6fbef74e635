// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report_page.hpp"

#include <array>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "pipeline/report/html.hpp"
#include "pipeline/report/report_parts.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || !text) throw InputError("cannot read " + file.string());
  return text.str();
}

// Between the quotes of its source, if these hold base64 and nothing else.
std::string picture_in(const std::string& html, const std::string& name)
{
  constexpr std::string_view kSource = "src=\"data:image/png;base64,";
  const std::size_t image = html.find("id=\"picture-" + name + "\"");
  if (image == std::string::npos) return {};
  const std::size_t source = html.find(kSource, image);
  if (source == std::string::npos) return {};
  const std::size_t begin = source + kSource.size();
  const std::size_t end = html.find_first_not_of(
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=", begin);
  if (end == std::string::npos || html[end] != '"') return {};
  return html.substr(begin, end - begin);
}

std::string cards_html(const Report& report)
{
  const std::string unit = report.text("/model/length_unit");
  std::string html = "<dl class=\"cards\">\n";
  for (const KeyFigure& figure : key_figures()) {
    if (!report.number(figure.pointer)) continue;
    const bool is_volume = std::string_view(figure.pointer) == "/volume";
    html +=
        fmt::format("<div><dt>{}</dt><dd data-key=\"{}\">{}{}</dd></div>\n", figure.name,
                    figure.pointer, figure_text(report, figure),
                    is_volume && !unit.empty() ? fmt::format(" <small>{}³</small>", escaped(unit))
                                               : std::string());
  }
  return html + "</dl>\n";
}

std::string pair_html(const std::vector<std::string>& figures)
{
  if (figures.empty()) return {};
  std::string html = "<div class=\"pair\">\n";
  for (const std::string& figure : figures) html += figure;
  return html + "</div>\n";
}

// The cut has a row of its own.
std::string pictures_html(const Report& report)
{
  std::vector<std::string> figures = picture_figures(report);
  if (figures.size() < 3) return pair_html(figures);
  const std::string last = figures.back();
  figures.pop_back();
  return pair_html(figures) + "<div class=\"wide\">" + last + "</div>\n";
}

std::string time_html(const Report& report)
{
  const std::string bars = stages_html(report, longest_stage_s(report), 1040.0);
  if (bars.empty()) return {};
  return bars + stages_legend();
}

std::string advice_html(const Report& report)
{
  const std::vector<std::string> advice = advice_of(report);
  const std::string status = report.text("/status");
  if (advice.empty()) {
    return status == "ok" || status == "degraded" ? "<p>None.</p>\n" : "";
  }
  return notes_html(advice);
}

std::string worst_html(const Report& report)
{
  const std::string table = worst_tets_html(report);
  if (table.empty()) return {};
  return "<p class=\"soft\">Where they are is the mean of their corners, in the units of the mesh. "
         "In ParaView, open mesh.pvtu and look there.</p>\n"
         + table;
}

std::string sharp_html(const Report& report)
{
  const std::string table = sharp_tets_html(report);
  if (table.empty()) return {};
  return "<p class=\"soft\">The worst coarse tets with angles below 5°. Short edges or narrow "
         "faces "
         "of the model may be there. Tets at its own sharp angles are not in the table.</p>\n"
         + table;
}

std::string materials_html(const Report& report)
{
  const Json* const materials = report.find("/materials");
  if (materials == nullptr || materials->size() < 2) return {};
  std::vector<std::vector<std::string>> rows;
  for (const Json& material : *materials) {
    rows.push_back({escaped(material.value("name", "")), std::to_string(material.value("id", 0)),
                    grouped(material.value("tets", GlobalIndex{0})),
                    fmt::format("{:.6g}", material.value("volume", 0.0))});
  }
  return table_html({"material", "attribute", "tets", "volume"}, rows);
}

std::string patches_html(const Report& report)
{
  const Json* const patches = report.find("/patches");
  if (patches == nullptr || patches->empty()) return {};
  constexpr std::size_t kMostRows = 100;
  std::vector<std::vector<std::string>> rows;
  for (const Json& patch : *patches) {
    if (rows.size() == kMostRows) break;
    rows.push_back({escaped(patch.value("name", "")), std::to_string(patch.value("id", 0)),
                    grouped(patch.value("triangles", GlobalIndex{0})),
                    fmt::format("{:.6g}", patch.value("area", 0.0))});
  }
  std::string html = table_html({"name", "patch", "triangles", "area"}, rows);
  if (patches->size() > kMostRows) {
    html += fmt::format("<p class=\"soft\">The other {} are in report.json.</p>\n",
                        patches->size() - kMostRows);
  }
  return html;
}

std::string again_html(const Report& report)
{
  const int ranks = static_cast<int>(report.number("/num_ranks").value_or(1.0));
  const std::string start = ranks > 1 ? fmt::format("mpirun -n {} ", ranks) : "";
  const auto in_folder = [&](const char* name) {
    return escaped(shell_word((report.source.folder / name).string()));
  };
  const std::string status = report.text("/status");
  const std::string folder = escaped(shell_word(report.source.folder.string()));
  const std::string run =
      fmt::format("{}tessera mesh {} --output {}", start, in_folder("case.toml"), folder);
  if (status != "ok" && status != "degraded") {
    return fmt::format(
        "<pre>{0} --resume\n{0} --overwrite</pre>\n<p class=\"soft\">The first goes on with what "
        "is "
        "finished, the second starts anew.</p>\n",
        run);
  }
  return fmt::format(
      "<pre>{} --overwrite\ntessera check {}</pre>\n<p class=\"soft\">The first makes the same "
      "mesh "
      "again, bit for bit, with any number of ranks. The second verifies it from its files alone. "
      "Give another --output to keep this mesh.</p>\n",
      run, in_folder("mesh.pvtu"));
}

std::string footer_html(const Report& report)
{
  std::string text = "Tessera " + report.text("/version");
  if (const Json* const libraries = report.find("/libraries")) {
    for (const auto& [name, version] : libraries->items()) {
      if (version.is_string()) text += fmt::format(" · {} {}", name, version.get<std::string>());
    }
  }
  if (const std::string digest = report.text("/digest"); !digest.empty()) {
    text += " · digest " + digest;
  }
  return "<footer class=\"soft\">" + escaped(text)
         + "<br>The same figures, for programs: report.json.</footer>\n";
}

std::string head_html(const Report& report)
{
  return fmt::format(
      "<header><h1>{}</h1><p class=\"soft\">Report of a mesh, in the folder {}</p></header>\n",
      escaped(report.text("/case")), escaped(report.source.folder.string()));
}

}  // namespace

ReportSource report_source(std::string json, const std::vector<MeshPicture>& pictures,
                           std::string view, fs::path folder)
{
  ReportSource source{
      .json = std::move(json), .view = std::move(view), .folder = std::move(folder)};
  for (const MeshPicture& picture : pictures) source.pictures[picture.name] = base64(picture.png);
  return source;
}

ReportSource read_report_source(const fs::path& folder)
{
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw InputError(folder.string() + ": no such folder");
  if (!fs::is_regular_file(folder / "report.json", error)) {
    throw InputError(folder.string() + ": not the output folder of a run, it has no report.json");
  }
  ReportSource source{.json = content_of(folder / "report.json"), .folder = folder};
  if (!fs::is_regular_file(folder / "report.html", error)) return source;
  const std::string html = content_of(folder / "report.html");
  for (const char* const name : {"subdomains", "patches", "cut"}) {
    std::string picture = picture_in(html, name);
    if (!picture.empty()) source.pictures[name] = std::move(picture);
  }
  return source;
}

std::string report_page(const ReportSource& source)
{
  const Report report(source);
  std::string body = head_html(report) + verdict_html(report);
  body += section_html("Key figures", cards_html(report));
  body += section_html("Pictures", pictures_html(report));
  body += section_html("To turn and to point at", source.view);
  body += section_html("Quality", pair_html(quality_figures(report)));
  body += section_html("Time, and who waited", time_html(report));
  body += section_html("Materials", materials_html(report));
  body += section_html("Patches", patches_html(report));
  body += section_html("The ten worst tets", worst_html(report));
  body += section_html("Small angles that the model does not force", sharp_html(report));
  body += section_html("Warnings", advice_html(report));
  body += section_html("Run it again", again_html(report));
  return page_html("Tessera: " + report.text("/case"), body + footer_html(report));
}

}  // namespace tessera::pipeline

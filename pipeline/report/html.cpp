// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/html.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace tessera::pipeline {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light; --ink: #1d2733; --soft: #5b6775; --line: #dde3ea; --tint: #f5f7fa; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink); line-height: 1.5;
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 28px 24px 48px; }
h1 { font-size: 1.7rem; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 40px 0 12px; padding-bottom: 6px; border-bottom: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 0 0 6px; overflow-wrap: anywhere; }
p { margin: 6px 0; max-width: 78ch; }
.soft { color: var(--soft); font-size: .92rem; }
.verdict { margin: 18px 0 0; padding: 14px 20px; border: 1px solid; border-left-width: 8px; border-radius: 6px; }
.verdict strong { font-size: 1.25rem; }
.verdict ul { margin: 6px 0 2px; padding-left: 22px; }
.ok { background: #eef8f0; border-color: #2c8a4b; }
.degraded { background: #fff7e6; border-color: #c77d0a; }
.failed { background: #fdeeee; border-color: #b3261e; }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(165px, 1fr)); gap: 12px; margin: 0; }
.cards div { background: var(--tint); border: 1px solid var(--line); border-radius: 6px; padding: 10px 14px; }
.cards dt { color: var(--soft); font-size: .86rem; }
.cards dd { margin: 0; font-size: 1.22rem; font-weight: 600; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.cards small { font-weight: 400; font-size: .8rem; color: var(--soft); }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 24px; align-items: start; }
.pair > * { min-width: 0; }
.pair + .pair { margin-top: 24px; }
.wide { max-width: 860px; margin: 24px auto 0; }
figure { margin: 0; }
figure img, svg { width: 100%; height: auto; display: block; }
figure img { border: 1px solid var(--line); border-radius: 6px; }
figcaption { margin-top: 6px; font-size: .92rem; }
.legend { display: flex; flex-wrap: wrap; gap: 2px 14px; margin: 6px 0 0; padding: 0; list-style: none; font-size: .86rem; }
.legend li { overflow-wrap: anywhere; }
.swatch { display: inline-block; width: 12px; height: 12px; margin-right: 5px; border: 1px solid #0004; border-radius: 2px; vertical-align: -1px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; font-size: .94rem; }
th, td { padding: 5px 12px 5px 0; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
th { color: var(--soft); font-weight: 600; }
th:first-child, td:first-child { text-align: left; white-space: normal; overflow-wrap: anywhere; }
tr.better td:last-child { background: #e3f4e8; } tr.worse td:last-child { background: #fde8d7; }
tr.other td:last-child { background: #eaf1fb; }
pre { background: var(--tint); border: 1px solid var(--line); border-radius: 6px; padding: 10px 14px; margin: 8px 0; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .9rem; }
svg text { font-family: inherit; font-size: 12px; fill: #1d2733; } svg .tick { fill: #5b6775; }
.notes li { margin: 6px 0; } .notes { padding-left: 22px; margin: 0; }
footer { margin-top: 44px; padding-top: 10px; border-top: 1px solid var(--line); }
@media print { main { max-width: none; padding: 0; } body { font-size: 11pt; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  figure, tr, .verdict, .cards div, svg { break-inside: avoid; } h2 { break-after: avoid; } }
)css";

// Sizes of charts, in the units of their drawing.
constexpr double kChartWidth = 520.0;
constexpr double kChartHeight = 170.0;
constexpr double kAxisHeight = 40.0;

double largest_count(const std::vector<HistogramSeries>& series)
{
  GlobalIndex largest = 1;
  for (const HistogramSeries& one : series) {
    if (!one.counts.empty()) largest = std::max(largest, *std::ranges::max_element(one.counts));
  }
  return static_cast<double>(largest);
}

std::string histogram_bars(const HistogramAxis& axis, const HistogramSeries& series, double largest)
{
  constexpr double kLeastHeight = 1.5;
  const double width = kChartWidth / static_cast<double>(series.counts.size());
  const double step = (axis.high - axis.low) / static_cast<double>(series.counts.size());
  std::string bars;
  for (std::size_t b = 0; b < series.counts.size(); ++b) {
    if (series.counts[b] == 0) continue;
    const double share = static_cast<double>(series.counts[b]) / largest;
    const double height = std::max(kLeastHeight, share * kChartHeight);
    const auto bin = static_cast<double>(b);
    bars += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
        "fill-opacity=\"0.85\"><title>{}: {} tets from {:g} to {:g}{}</title></rect>",
        bin * width + 0.5, kChartHeight - height, width - 1.0, height,
        css_colour(series.colours[b % series.colours.size()]), escaped(series.name),
        grouped(series.counts[b]), axis.low + bin * step, axis.low + (bin + 1.0) * step,
        escaped(axis.unit));
  }
  return bars;
}

std::string histogram_axis(const HistogramAxis& axis)
{
  std::string text =
      fmt::format("<line x1=\"0\" x2=\"{0}\" y1=\"{1}\" y2=\"{1}\" stroke=\"#5b6775\"/>",
                  kChartWidth, kChartHeight);
  for (int tick = 0; tick <= axis.num_ticks; ++tick) {
    const double share = static_cast<double>(tick) / axis.num_ticks;
    const char* const anchor = tick == 0 ? "start" : tick == axis.num_ticks ? "end" : "middle";
    text +=
        fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"{}\">{:g}{}</text>",
                    share * kChartWidth, kChartHeight + 16.0, anchor,
                    axis.low + share * (axis.high - axis.low), escaped(axis.unit));
  }
  return text
         + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                       0.5 * kChartWidth, kChartHeight + 34.0, escaped(axis.title));
}

std::string bar_row(const Bar& bar, double scale, double y)
{
  constexpr double kNameWidth = 84.0;
  constexpr double kBarHeight = 16.0;
  std::string row = fmt::format("<text x=\"0\" y=\"{}\">{}</text>", y + 12.5, escaped(bar.name));
  double x = kNameWidth;
  for (const BarPart& part : bar.parts) {
    const double width = std::max(0.0, part.value * scale);
    row += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"><title>{}: "
        "{}</title></rect>",
        x, y, width, kBarHeight, part.colour, escaped(part.meaning), duration_text(part.value));
    x += width;
  }
  return row
         + fmt::format("<text class=\"tick\" x=\"{:.2f}\" y=\"{}\">{}</text>", x + 8.0, y + 12.5,
                       escaped(bar.note));
}

}  // namespace

std::string escaped(std::string_view text)
{
  std::string html;
  html.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default: {
        const auto octet = static_cast<unsigned char>(c);
        const bool is_control = (octet < 0x20 && c != '\n' && c != '\t') || octet == 0x7f;
        html += is_control ? std::string("\xef\xbf\xbd") : std::string(1, c);
      }
    }
  }
  return html;
}

std::string shell_word(const std::string& text)
{
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')
           || std::string_view("_-./=+,:@%").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string base64(std::span<const std::byte> bytes)
{
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - first);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      bits <<= 8U;
      if (i < count) bits |= std::to_integer<std::uint32_t>(bytes[first + i]);
    }
    for (std::size_t digit = 0; digit < 4; ++digit) {
      const auto value = (bits >> (18U - 6U * static_cast<unsigned>(digit))) & 63U;
      text += digit <= count ? kDigits[value] : '=';
    }
  }
  return text;
}

std::string css_colour(const Colour& colour)
{
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

std::string grouped(GlobalIndex number)
{
  std::string text = std::to_string(number);
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  for (std::size_t place = text.size(); place > first + 3; place -= 3) text.insert(place - 3, ",");
  return text;
}

std::string duration_text(double seconds)
{
  constexpr double kMinute = 60.0;
  constexpr double kHour = 3600.0;
  if (seconds < 0.995) return fmt::format("{:.2f} s", seconds);
  if (seconds < 99.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<GlobalIndex>(std::llround(seconds));
  if (static_cast<double>(whole) < 2.0 * kMinute) return fmt::format("{} s", whole);
  if (static_cast<double>(whole) < kHour) {
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  }
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string bytes_text(double bytes)
{
  constexpr std::array<const char*, 5> kUnits{"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000.0;
  return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

std::string histogram_svg(const HistogramAxis& axis, const std::vector<HistogramSeries>& series)
{
  std::string svg =
      fmt::format("<svg viewBox=\"-2 -4 {} {}\" role=\"img\" aria-label=\"{}\">", kChartWidth + 4.0,
                  kChartHeight + kAxisHeight + 4.0, escaped("Histogram: " + axis.title));
  const double largest = largest_count(series);
  for (const HistogramSeries& one : series) svg += histogram_bars(axis, one, largest);
  return svg + histogram_axis(axis) + "</svg>\n";
}

std::string bars_svg(const BarAxis& axis, const std::vector<Bar>& bars)
{
  constexpr double kRow = 24.0;
  constexpr double kShareOfBar = 0.6;  // The rest is for names and notes.
  const double scale = axis.full > 0.0 ? kShareOfBar * axis.width / axis.full : 0.0;
  std::string svg =
      fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", axis.width,
                  kRow * static_cast<double>(bars.size()), escaped(axis.title));
  double y = 2.0;
  for (const Bar& bar : bars) {
    svg += bar_row(bar, scale, y);
    y += kRow;
  }
  return svg + "</svg>\n";
}

std::string table_html(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows)
{
  std::string html = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& cell : head) html += "<th scope=\"col\">" + cell + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + cell + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string notes_html(const std::vector<std::string>& notes)
{
  if (notes.empty()) return {};
  std::string html = "<ul class=\"notes\">\n";
  for (const std::string& note : notes) html += "<li>" + escaped(note) + "</li>\n";
  return html + "</ul>\n";
}

std::string section_html(std::string_view heading, const std::string& content)
{
  if (content.empty()) return {};
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escaped(heading), content);
}

std::string page_html(std::string_view title, const std::string& body)
{
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      // Whatever stands in it, a page asks nothing of anywhere.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n{}</main>\n</body>\n</"
      "html>\n",
      escaped(title), kStyle, body);
}

}  // namespace tessera::pipeline

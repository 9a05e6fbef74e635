// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/viewer/view_page.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/vec3.hpp"

#include "pipeline/drawing/mesh_scene.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/viewer/packed_arrays.hpp"
#include "pipeline/viewer/three_js.hpp"
#include "pipeline/viewer/viewer_files.hpp"

namespace tessera::pipeline {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSteps = 65535.0;  // Of a side of the box: coordinates have 16 bits.

// Goes wherever three.js goes, as its licence asks.
constexpr std::string_view kLicence =
    R"html(<details class="soft"><summary>Drawn with three.js</summary>
<p>The MIT License. Copyright © 2010-2019 three.js authors. Permission is hereby granted, free of charge, to any person
obtaining a copy of this software and associated documentation files (the "Software"), to deal in the Software without
restriction, including without limitation the rights to use, copy, modify, merge, publish, distribute, sublicense, and/or
sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to the following
conditions: The above copyright notice and this permission notice shall be included in all copies or substantial portions
of the Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT
LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.</p>
</details>
)html";

constexpr std::string_view kCoarseNote =
    "<p class=\"soft\" id=\"viewer-coarse\">Coarse triangles stand here for those of the mesh: "
    "there are "
    "more of these than a page has room for, or only a part of the mesh was made.</p>\n";

struct Grid {
  Vec3 low{};
  Vec3 step{};
};

Grid grid_around(std::span<const double> xyz)
{
  const Box box = bounding_box(xyz);
  return {box.low, (1.0 / kSteps) * box.extent()};
}

std::vector<std::uint32_t> coordinates(std::span<const double> xyz, const Grid& grid,
                                       std::size_t axis)
{
  std::vector<std::uint32_t> values;
  values.reserve(xyz.size() / 3);
  for (std::size_t i = axis; i < xyz.size(); i += 3) {
    const double steps = grid.step[axis] > 0.0 ? (xyz[i] - grid.low[axis]) / grid.step[axis] : 0.0;
    values.push_back(static_cast<std::uint32_t>(std::lround(std::clamp(steps, 0.0, kSteps))));
  }
  return values;
}

std::size_t width_of(std::span<const std::uint32_t> values)
{
  const std::uint32_t largest = values.empty() ? 0 : *std::ranges::max_element(values);
  return largest <= 0xffU ? 1 : largest <= 0xffffU ? 2 : 4;
}

PackedArrays packed(const Surface& surface, const Grid& grid)
{
  PackedArrays arrays;
  for (const auto& [name, axis] : {std::pair("x", 0U), std::pair("y", 1U), std::pair("z", 2U)}) {
    arrays.add(name, 2, coordinates(surface.point_xyz, grid, axis));
    arrays.add(std::string("line_") + name, 2, coordinates(surface.line_xyz, grid, axis));
  }
  const std::vector<std::uint32_t> corners(surface.corners.begin(), surface.corners.end());
  arrays.add("corners", 4, corners);
  for (const auto& [name, values] : surface.cells) arrays.add(name, width_of(values), values);
  return arrays;
}

std::vector<std::string> css_colours(const std::vector<Colour>& colours)
{
  std::vector<std::string> texts;
  for (const Colour& colour : colours) texts.push_back(css_colour(colour));
  return texts;
}

// Text that neither ends the element that it stands in nor begins another.
std::string json_text(const Json& json)
{
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return text;
}

std::string without_view(const std::string& why)
{
  return "<p class=\"soft\" id=\"no-view\">" + escaped(why) + "</p>\n";
}

}  // namespace

std::string view_html(const SurfaceView& view)
{
  const Surface& surface = view.surface;
  if (surface.corners.empty()) return without_view("There is no surface to turn here.");
  if (static_cast<GlobalIndex>(surface.num_triangles()) > Surface::kMostTriangles) {
    return without_view(fmt::format(
        "There is no view to turn here: the surface has {} triangles, and a page has room for {}.",
        grouped(static_cast<GlobalIndex>(surface.num_triangles())),
        grouped(Surface::kMostTriangles)));
  }
  const std::optional<std::string> three = packed_three_js();
  if (!three) {
    return without_view(fmt::format(
        "There is no view to turn here: three.js was not there when this page was written. It is "
        "looked for as {}, which the Debian package libjs-three brings; install that and write the "
        "page again, or set the environment variable TESSERA_THREE_JS to the file three.min.js.",
        three_js_file().string()));
  }
  const Grid grid = grid_around(surface.point_xyz);
  const PackedArrays arrays = packed(surface, grid);
  Json data = view.description;
  data["is_coarse"] = surface.is_coarse;
  data["low"] = grid.low;
  data["step"] = grid.step;
  data["arrays"] = arrays.layout();
  data["palette"] = css_colours(distinct_colours());
  for (Json& colouring : data["colourings"]) {
    if (colouring["array"] == "quality") colouring["scale"] = css_colours(quality_colours());
  }
  const ViewerFiles files = viewer_files();
  return fmt::format(
      "<style>\n{}</style>\n{}{}{}"
      "<script type=\"application/json\" id=\"viewer-data\">{}</script>\n"
      "<script type=\"text/plain\" id=\"viewer-arrays\">{}</script>\n"
      "<script type=\"text/plain\" id=\"viewer-three\">{}</script>\n"
      "<script type=\"module\">\n{}</script>\n",
      files.style, surface.is_coarse ? kCoarseNote : "", files.markup, kLicence, json_text(data),
      arrays.text(), *three, files.script);
}

}  // namespace tessera::pipeline

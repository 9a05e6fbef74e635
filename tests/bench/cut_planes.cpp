// SPDX-License-Identifier: BSD-3-Clause
// Cut planes by each rule, judged on the triangles of the model; nothing is meshed.
//
//   cut_planes MODEL COARSE_SIZE [PARTS]... [--picture=PREFIX]
//
// For each number of parts (2, 4, 8, 16 and 32 if none is given) and each rule: parts, balance, the
// smallest clearance (of features, in their sizes), the shortest edge of a cut (coarse sizes), the
// smallest angle, the area of all cuts over that of a side of a cube of the model's volume, and
// milliseconds of CPU. PREFIX: a picture of each choice, PREFIX-RULE-PARTS.png. NETGEN runs in this
// process.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/cut/choose_planes.hpp"
#include "tessera/netgen/factory.hpp"

#include "pipeline/drawing/canvas.hpp"
#include "pipeline/drawing/png.hpp"

namespace {

using namespace tessera;

using Polygon = std::vector<Vec3>;

// What of a polygon is below a plane, or above it.
Polygon clipped(const Polygon& polygon, const cut::Plane& plane, double side)
{
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& p = polygon[i];
    const Vec3& q = polygon[(i + 1) % polygon.size()];
    const double hp = side * plane.height(p);
    const double hq = side * plane.height(q);
    if (hp >= 0.0) kept.push_back(p);
    if ((hp >= 0.0) != (hq >= 0.0)) kept.push_back(p + (hp / (hp - hq)) * (q - p));
  }
  return kept;
}

void draw(pipeline::Canvas& canvas, const cut::CutTree& tree, LocalIndex row,
          const Polygon& polygon)
{
  if (polygon.size() < 3) return;
  const cut::CutNode& node = tree.nodes[at(row)];
  if (!node.is_leaf()) {
    draw(canvas, tree, node.below, clipped(polygon, node.plane, -1.0));
    draw(canvas, tree, node.above, clipped(polygon, node.plane, 1.0));
    return;
  }
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    canvas.draw({polygon[0], polygon[i - 1], polygon[i]}, node.part);
  }
}

void write_picture(const model::ModelDescription& model, const cut::CutTree& tree,
                   const std::string& file)
{
  const pipeline::View view = pipeline::view_from({1.0, -1.7, 1.1});
  pipeline::Canvas canvas(pipeline::fit_camera(view, model.vertex_xyz, {800, 800, 20}));
  for (std::size_t t = 0; t < model.triangle_face.size(); ++t) {
    Polygon corners;
    for (std::size_t c = 0; c < 3; ++c) {
      corners.push_back(point_at(std::span(model.vertex_xyz), model.triangle_vertices[3 * t + c]));
    }
    const auto& solids = model.faces[at(model.triangle_face[t])].solids;
    if (solids.empty()) continue;
    draw(canvas, tree, tree.solid_root[at(solids.front() - 1)], corners);
  }
  const Bytes png = pipeline::to_png(
      pipeline::paint(canvas, {.colours = pipeline::distinct_colours(), .has_borders = true}));
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

void print_row(const cut::CutChoice& choice, const cut::CutOptions& options, double cpu_ms)
{
  double volume = 0.0;
  for (const cut::CutPart& part : choice.report.parts) volume += part.volume;
  double clearance = 99.0;
  double edge = 99.0;
  double angle_deg = 90.0;
  double area = 0.0;
  for (const cut::PlaneJudgement& plane : choice.report.planes) {
    clearance = std::min(clearance, plane.clearance);
    edge = std::min(edge, plane.shortest_edge);
    angle_deg = std::min(angle_deg, plane.angle_deg);
    area += plane.area;
  }
  std::printf("%5d  %-6s  %5d  %7.2f  %9.3f  %7.3f  %5.1f  %6.2f  %6.0f\n", options.parts,
              std::string(word_of(options.rule)).c_str(), choice.tree.num_parts,
              choice.report.balance, clearance, edge, angle_deg, area / std::cbrt(volume * volume),
              cpu_ms);
  for (const cut::CutPart& part : choice.report.parts) {
    if (part.whole_because.empty()) continue;
    std::printf("       one part instead of %d: %s\n", part.num_wanted, part.whole_because.c_str());
  }
}

void run(const std::string& file, double coarse_size, const std::vector<LocalIndex>& counts,
         const std::string& prefix)
{
  const auto model = netgen::load_model(netgen::import_model(file, {}));
  const model::ModelDescription described = netgen::describe_model(*model);
  std::printf("%s: %zu triangles, %zu faces, %zu solids, coarse size %g\n", file.c_str(),
              described.triangle_face.size(), described.faces.size(), described.solids.size(),
              coarse_size);
  std::printf("parts  rule      got  balance  clearance     edge  angle    area  CPU ms\n");
  for (const LocalIndex parts : counts) {
    for (const auto& [rule, word] : kEnumWords<cut::PlaneRule>) {
      const cut::CutOptions options{.rule = rule, .parts = parts, .coarse_size = coarse_size};
      const std::clock_t start = std::clock();
      const cut::CutChoice choice = cut::choose_planes(described, options);
      const double cpu_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      print_row(choice, options, cpu_ms);
      if (prefix.empty()) continue;
      write_picture(described, choice.tree,
                    prefix + "-" + std::string(word) + "-" + std::to_string(parts) + ".png");
    }
  }
}

}  // namespace

int main(int argc, char** argv)
{
  constexpr std::string_view kPicture = "--picture=";
  std::vector<LocalIndex> counts;
  std::string prefix;
  for (int i = 3; i < argc; ++i) {
    const std::string_view argument(argv[i]);
    if (argument.starts_with(kPicture)) {
      prefix = argument.substr(kPicture.size());
    } else {
      counts.push_back(std::atoi(argv[i]));
    }
  }
  if (counts.empty()) counts = {2, 4, 8, 16, 32};
  if (argc < 3) {
    std::fprintf(stderr, "usage: cut_planes MODEL COARSE_SIZE [PARTS]... [--picture=PREFIX]\n");
    return 64;
  }
  try {
    run(argv[1], std::atof(argv[2]), counts, prefix);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

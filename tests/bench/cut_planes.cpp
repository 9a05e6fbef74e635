// SPDX-License-Identifier: BSD-3-Clause
// Cut planes by each rule: judged on the triangles of the model and, if asked for, by the coarse
// mesh of the parts.
//
//   cut_planes MODEL COARSE_SIZE [PARTS]... [--mesh] [--rule=RULE] [--picture=PREFIX]
//
// For each number of parts (2, 4, 8, 16 and 32 if none is given) and each rule: parts, balance, the
// smallest clearance (of features, in their sizes), the shortest edge of a cut (coarse sizes), the
// smallest angle, the area of all cuts over that of a side of a cube of the model's volume, and
// milliseconds of CPU. With --mesh, against the coarse mesh of the uncut model: the smallest edge,
// the number of tets, seconds of CPU; and the smallest dihedral angle of both, degrees. Each mesh
// is made in a child process, in 120 seconds of CPU at most. PREFIX: a picture of each choice,
// PREFIX-RULE-PARTS.png.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/cut/choose_planes.hpp"
#include "tessera/mesh/tet_edges.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/quality/tet_quality.hpp"

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

constexpr rlim_t kMostSeconds = 120;  // Of CPU, for one mesh; thin slices may take hours.

struct MeshFigures {
  double shortest_edge = std::numeric_limits<double>::infinity();
  double min_dihedral_deg = 180.0;
  double num_tets = 0.0;
  double cpu_s = 0.0;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Of the mesh that `make` returns.
template <class Make>
MeshFigures figures_of(const Make& make)
{
  MeshFigures figures;
  const double start = cpu_seconds();
  const mesh::CoarseMesh mesh = make();
  figures.cpu_s = cpu_seconds() - start;
  figures.num_tets = mesh.num_tets();
  mesh::for_each_edge(mesh.tet_vertices, mesh.num_vertices(), [&](LocalIndex a, LocalIndex b) {
    figures.shortest_edge =
        std::min(figures.shortest_edge, norm(mesh.position(b) - mesh.position(a)));
  });
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    quality::TetCorners corners;
    for (std::size_t c = 0; c < 4; ++c) corners[c] = mesh.position(mesh.tet(t)[c]);
    figures.min_dihedral_deg = std::min(
        figures.min_dihedral_deg, quality::angle_deg(quality::shape_of(corners).largest_cosine));
  }
  return figures;
}

// The same in a child process; nothing if that dies.
template <class Make>
std::optional<MeshFigures> figures_in_child(const Make& make)
{
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    try {
      const rlimit limit{kMostSeconds, kMostSeconds};
      setrlimit(RLIMIT_CPU, &limit);
      std::freopen("/dev/null", "w", stdout);
      const MeshFigures figures = figures_of(make);
      _exit(write(ends[1], &figures, sizeof(figures)) == sizeof(figures) ? 0 : 1);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(1);
    }
  }
  close(ends[1]);
  MeshFigures figures;
  const bool is_whole = read(ends[0], &figures, sizeof(figures)) == sizeof(figures);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!is_whole) return std::nullopt;
  return figures;
}

void print_judgement(const cut::CutChoice& choice, const cut::CutOptions& options, double cpu_ms)
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
  std::printf("%5d  %-6s  %5d  %7.2f  %9.3f  %7.3f  %5.1f  %6.2f  %6.0f", options.parts,
              std::string(word_of(options.rule)).c_str(), choice.tree.num_parts,
              choice.report.balance, clearance, edge, angle_deg, area / std::cbrt(volume * volume),
              cpu_ms);
}

void print_reasons(const cut::CutReport& report)
{
  for (const cut::CutPart& part : report.parts) {
    if (part.whole_because.empty()) continue;
    std::printf("       one part instead of %d: %s\n", part.num_wanted, part.whole_because.c_str());
  }
}

struct Arguments {
  std::string file{};
  double coarse_size = 0.0;
  std::vector<LocalIndex> counts{};
  std::string prefix{};
  std::string rule{};  // Empty: all.
  bool meshes = false;
};

class Bench {
 public:
  explicit Bench(const Arguments& arguments)
      : arguments_(arguments),
        model_(netgen::load_model(netgen::import_model(arguments.file, {}))),
        described_(netgen::describe_model(*model_)),
        coarse_{.max_size = arguments.coarse_size}
  {
  }

  void run()
  {
    std::printf("%s: %zu triangles, %zu faces, %zu solids, coarse size %g\n",
                arguments_.file.c_str(), described_.triangle_face.size(), described_.faces.size(),
                described_.solids.size(), arguments_.coarse_size);
    if (arguments_.meshes) mesh_uncut();
    std::printf("parts  rule      got  balance  clearance     edge  angle    area  CPU ms%s\n",
                arguments_.meshes ? "   min edge    tets  CPU s  dihedral" : "");
    for (const LocalIndex parts : arguments_.counts) {
      for (const auto& [rule, word] : kEnumWords<cut::PlaneRule>) {
        if (arguments_.rule.empty() || arguments_.rule == word) {
          run({.rule = rule, .parts = parts, .coarse_size = arguments_.coarse_size});
        }
      }
    }
  }

 private:
  void mesh_uncut()
  {
    const auto figures =
        figures_in_child([&] { return netgen::make_coarse_mesher(*model_)->generate(coarse_); });
    if (!figures) throw NetgenError("the uncut model cannot be meshed");
    uncut_ = *figures;
    std::printf("uncut: smallest edge %.4g, %.0f tets, %.2f s, dihedral angle %.2f\n",
                uncut_.shortest_edge, uncut_.num_tets, uncut_.cpu_s, uncut_.min_dihedral_deg);
  }

  void run(const cut::CutOptions& options)
  {
    const double start = cpu_seconds();
    const cut::CutChoice choice = cut::choose_planes(described_, options);
    print_judgement(choice, options, 1e3 * (cpu_seconds() - start));
    if (arguments_.meshes) mesh_parts(choice.tree);
    std::printf("\n");
    print_reasons(choice.report);
    if (arguments_.prefix.empty()) return;
    write_picture(described_, choice.tree,
                  arguments_.prefix + "-" + std::string(word_of(options.rule)) + "-"
                      + std::to_string(options.parts) + ".png");
  }

  void mesh_parts(const cut::CutTree& tree)
  {
    const auto figures = figures_in_child(
        [&] { return netgen::make_coarse_mesher(*model_)->generate_parts(coarse_, tree).mesh; });
    if (!figures) {
      std::printf("   cannot be meshed");
      return;
    }
    std::printf("   %8.3f  %6.3f  %5.2f  %8.2f", figures->shortest_edge / uncut_.shortest_edge,
                figures->num_tets / uncut_.num_tets, figures->cpu_s / uncut_.cpu_s,
                figures->min_dihedral_deg);
  }

  const Arguments& arguments_;
  std::unique_ptr<model::Model> model_;
  model::ModelDescription described_;
  surface::CoarseOptions coarse_;
  MeshFigures uncut_{};
};

Arguments read_arguments(const std::vector<std::string>& given)
{
  constexpr std::string_view kPicture = "--picture=";
  constexpr std::string_view kRule = "--rule=";
  Arguments arguments{.file = given.at(0), .coarse_size = std::stod(given.at(1))};
  for (std::size_t i = 2; i < given.size(); ++i) {
    if (given[i] == "--mesh") {
      arguments.meshes = true;
    } else if (given[i].starts_with(kPicture)) {
      arguments.prefix = given[i].substr(kPicture.size());
    } else if (given[i].starts_with(kRule)) {
      arguments.rule = given[i].substr(kRule.size());
    } else {
      arguments.counts.push_back(std::stoi(given[i]));
    }
  }
  if (arguments.counts.empty()) arguments.counts = {2, 4, 8, 16, 32};
  return arguments;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: cut_planes MODEL COARSE_SIZE [PARTS]... [--mesh] [--rule=RULE] "
                 "[--picture=PREFIX]\n");
    return 64;
  }
  try {
    const Arguments arguments = read_arguments({argv + 1, argv + argc});
    Bench(arguments).run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

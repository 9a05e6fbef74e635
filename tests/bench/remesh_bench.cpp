// SPDX-License-Identifier: BSD-3-Clause
// Remeshes the triangles of a model, puts them on it and fills them, and says how often they cut
// each other, what came out and how long it took:
//   remesh_bench [--no-fill] SIZE MODEL
// SIZE is the largest edge; with a % behind it, of the box's diagonal.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/quality/tet_quality.hpp"
#include "tessera/surface/on_geometry.hpp"
#include "tessera/surface/overlap.hpp"

#include "netgen/loaders.hpp"
#include "netgen/model_mesher.hpp"

namespace tessera {
namespace {

// CPU time, so that what else runs on the machine does not matter.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

using Corners = std::array<Vec3, 3>;

// Of triangles: percentiles of the smallest angle of each, and the middle of all edges.
void print_shapes(const std::vector<Corners>& triangles, double max_size)
{
  std::vector<double> angles;
  std::vector<double> lengths;
  for (const Corners& p : triangles) {
    double smallest = std::numbers::pi;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = p[(c + 1) % 3] - p[c];
      const Vec3 b = p[(c + 2) % 3] - p[c];
      smallest = std::min(smallest, std::atan2(norm(cross(a, b)), dot(a, b)));
      lengths.push_back(norm(a));
    }
    angles.push_back(smallest * 180.0 / std::numbers::pi);
  }
  std::ranges::sort(angles);
  std::ranges::sort(lengths);
  std::printf(
      "%zu triangles, smallest angle %.2f deg, 1st percentile %.1f, 10th %.1f; median edge %.2f of "
      "the largest",
      angles.size(), angles.front(), angles[angles.size() / 100], angles[angles.size() / 10],
      lengths[lengths.size() / 2] / max_size);
}

std::vector<Corners> triangles_of(const surface::PatchSurface& surface)
{
  std::vector<Corners> triangles;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    triangles.push_back(surface.corners(t));
  return triangles;
}

std::vector<Corners> triangles_of(const mesh::CoarseMesh& mesh)
{
  std::vector<Corners> triangles;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* const v = &mesh.face_vertices[3 * at(f)];
    triangles.push_back({mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2])});
  }
  return triangles;
}

double smallest_dihedral_deg(const mesh::CoarseMesh& mesh)
{
  double largest_cosine = -1.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto v = mesh.tet(t);
    const quality::TetShape shape = quality::shape_of(
        {mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]), mesh.position(v[3])});
    largest_cosine = std::max(largest_cosine, shape.largest_cosine);
  }
  return quality::angle_deg(largest_cosine);
}

double size_from(const std::string& word, const geometry::LoadedModel& model)
{
  const double number = std::stod(word);
  return word.back() == '%' ? 0.01 * number * model.box_diagonal() : number;
}

// The surface as a run makes it, and its tets.
void fill(const geometry::LoadedModel& model, surface::CoarseOptions options,
          surface::SurfaceMesher mesher)
{
  options.surface_mesher = mesher;
  const double begin = cpu_seconds();
  std::printf("  %s: ", mesher == surface::SurfaceMesher::netgen ? "NETGEN" : "remeshed");
  try {
    surface::CoarseSurface surface = model.mesh_surface(options, cut::CutTree{});
    print_shapes(triangles_of(surface.mesh), options.max_size);
    std::printf(", %.1f s", cpu_seconds() - begin);
    std::vector<surface::DomainTets> tets;
    for (LocalIndex d = 1; d <= surface.num_domains(); ++d) {
      tets.push_back(netgen::ModelMesher(model).mesh_domain(surface::skin_of(surface, d), options));
    }
    const mesh::CoarseMesh mesh = surface::fill_surface(std::move(surface), tets).mesh;
    std::printf("; %d tets, smallest dihedral angle %.2f deg, %.1f s\n", mesh.num_tets(),
                smallest_dihedral_deg(mesh), cpu_seconds() - begin);
  } catch (const std::exception& error) {
    std::printf("FAILED after %.1f s: %.160s\n", cpu_seconds() - begin, error.what());
  }
}

void run(const std::string& size, const std::string& file, bool with_fill)
{
  const auto model = netgen::load_any_model(netgen::import_model(file, {}));
  surface::CoarseOptions options;
  options.surface_mesher = surface::SurfaceMesher::remesh;
  options.max_size = size_from(size, *model);
  const surface::SurfaceReference reference(model->triangles_for_fit(options.max_size).triangles);
  const std::size_t num_given = reference.surface().triangles.size();
  const std::size_t given_cuts = surface::find_overlaps(reference.surface()).size();

  const double begin = cpu_seconds();
  const surface::PatchSurface surface =
      surface::remesh_on_geometry(reference, *model, options).surface;
  const double seconds = cpu_seconds() - begin;
  std::printf("%s: %zu triangles that cut at %zu pairs -> ",
              file.substr(file.rfind('/') + 1).c_str(), num_given, given_cuts);
  print_shapes(triangles_of(surface), options.max_size);
  std::printf(" that cut at %zu pairs; %.2f s, %.0f triangles a second\n",
              surface::find_overlaps(surface).size(), seconds,
              static_cast<double>(surface.triangles.size()) / seconds);
  std::fflush(stdout);
  if (!with_fill) return;
  fill(*model, options, surface::SurfaceMesher::remesh);
  fill(*model, options, surface::SurfaceMesher::netgen);
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  const bool with_fill = argc > 1 && std::string_view(argv[1]) != "--no-fill";
  const int first = with_fill ? 1 : 2;
  if (argc != first + 2) {
    std::fprintf(stderr, "usage: remesh_bench [--no-fill] SIZE MODEL\n");
    return 64;
  }
  try {
    tessera::run(argv[first], argv[first + 1], with_fill);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: error: %s\n", argv[first + 1], error.what());
    return 1;
  }
  return 0;
}

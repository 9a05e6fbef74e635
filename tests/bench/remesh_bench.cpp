// SPDX-License-Identifier: BSD-3-Clause
// Remeshes the triangles of a model, puts them on it and fills them, and says how often they cut
// each other, what came out and how long it took:
//   remesh_bench [--no-fill] SIZE MODEL
// SIZE is the largest edge; with a % behind it, of the box's diagonal.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/base/box_diagonal.hpp"
#include "tessera/coarse/on_geometry.hpp"
#include "tessera/coarse/surface_overlap.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "netgen/loaded_model.hpp"

namespace tessera {
namespace {

// CPU time, so that what else runs on the machine does not matter.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double smallest_angle_deg(const coarse::PatchSurface& surface)
{
  double smallest = std::numbers::pi;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto p = surface.corners(t);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = p[(c + 1) % 3] - p[c];
      const Vec3 b = p[(c + 2) % 3] - p[c];
      smallest = std::min(smallest, std::atan2(norm(cross(a, b)), dot(a, b)));
    }
  }
  return smallest * 180.0 / std::numbers::pi;
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

double size_from(const std::string& word, const netgen::LoadedModel& model)
{
  const double number = std::stod(word);
  return word.back() == '%' ? 0.01 * number * model.box_diagonal() : number;
}

void fill(const netgen::LoadedModel& model, const coarse::CoarseOptions& options)
{
  const double begin = cpu_seconds();
  try {
    coarse::CoarseSurface surface = model.mesh_surface(options, cut::CutTree{});
    std::vector<coarse::DomainTets> tets;
    for (LocalIndex d = 1; d <= surface.num_domains(); ++d) {
      tets.push_back(model.mesh_domain(coarse::skin_of(surface, d), options));
    }
    const mesh::CoarseMesh mesh = coarse::fill_surface(std::move(surface), tets).mesh;
    std::printf("  ok, %d tets, smallest dihedral angle %.2f deg, in %.1f s\n", mesh.num_tets(),
                smallest_dihedral_deg(mesh), cpu_seconds() - begin);
  } catch (const std::exception& error) {
    std::printf("  FAILED after %.1f s: %.160s\n", cpu_seconds() - begin, error.what());
  }
}

void run(const std::string& size, const std::string& file, bool with_fill)
{
  const auto model = netgen::load_any_model(netgen::import_model(file, {}));
  coarse::CoarseOptions options;
  options.surface_mesher = coarse::SurfaceMesher::remesh;
  options.max_size = size_from(size, *model);
  const coarse::SurfaceReference reference(model->triangles_for_fit(options.max_size).triangles);
  const std::size_t num_given = reference.surface().triangles.size();
  const std::size_t given_cuts = coarse::find_overlaps(reference.surface()).size();

  const double begin = cpu_seconds();
  const coarse::PatchSurface surface =
      coarse::remesh_on_geometry(reference, reference.surface(), *model, options);
  const double seconds = cpu_seconds() - begin;
  const std::size_t num_made = surface.triangles.size();
  std::printf(
      "%s: %zu triangles that cut at %zu pairs -> %zu at %zu, smallest angle %.2f deg; %.2f s, "
      "%.2f M triangles a minute\n",
      file.substr(file.rfind('/') + 1).c_str(), num_given, given_cuts, num_made,
      coarse::find_overlaps(surface).size(), smallest_angle_deg(surface), seconds,
      60e-6 * static_cast<double>(num_given + num_made) / seconds);
  std::fflush(stdout);
  if (with_fill) fill(*model, options);
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

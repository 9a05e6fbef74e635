// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/fill/fill_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "netgen/fill/skin_mesh.hpp"
#include "netgen/mesh_conversion.hpp"
#include "netgen/session.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

using fill::FillInput;
using fill::FillOutput;
using fill::KernelSettings;

LocalIndex num_skin_vertices(const FillInput& input)
{
  return static_cast<LocalIndex>(input.vertex_xyz.size() / 3);
}

// Distance of neighbouring interior points, as a part of the wanted edge length.
//
// NETGEN puts one point into every cell of an octree, and its optimiser moves them; so this factor
// decides the edge length. The octree is built such that its cells have this very size (see
// align_octree()). In NETGEN's own octree a cell is anything from half the wanted size to the
// whole. With that, the median edge was 0.85 to 1.28 of the wanted one.
//
// Measured on surfaces of unit cubes (9, 11, 13 cells a side) and a sphere (1280 triangles). The
// wanted edge is the mean edge of the skin; 3 optimisation steps, grading 0.3. Columns: median edge
// / wanted edge; then the worst of the four in share of edges below 1.6 times the wanted one and in
// mean of mean ratio.
//   0.75: 0.88 to 1.03, 99.7 %, 0.892      0.80: 0.97 to 1.08, 99.2 %, 0.861
//   0.78: 0.93 to 1.06, 99.4 %, 0.877      0.82: 1.00 to 1.08, 99.1 %, 0.860
constexpr double kPointSpacing = 0.78;

// A cell may exceed its size by this factor before it is split. Cells come in powers of two, so
// under a varying size they are 0.6 to 1.2 of it. At sqrt(2), which would be fair on average, cells
// between two samples stay too large: on the sphere at 0.75, median 1.07 in place of 1.04.
constexpr double kCellTolerance = 1.2;

// Interior points keep this part of a skin triangle's diameter off it. NETGEN's own 0.1 gave on the
// same skins the same quality and more long edges next to the skin (99.2 % below 1.6).
constexpr double kDistanceFromSkin = 0.05;

// The largest cell that is not split where `size` is the wanted edge length.
double largest_cell(double size) { return kCellTolerance * kPointSpacing * size; }

// How many points the octree has for one that the sizes ask for, if `cell` halved some times are
// its cells.
double point_surplus(const std::vector<double>& sizes, double cell)
{
  double sum = 0.0;
  for (const double size : sizes) {
    const double halvings = std::ceil(std::log2(cell / largest_cell(size)));
    sum += std::pow(kPointSpacing * size / std::ldexp(cell, -static_cast<int>(halvings)), 3.0);
  }
  return sum / static_cast<double>(sizes.size());
}

// The cell, within one octave, with which the number of points comes nearest to what the sizes ask
// for. The median size would not do: a skin with sizes of 1 and 0.8 got cells of 0.78 and 0.39. On
// shaft (L = 3, K = 16) two of 16 pieces then had 25 % too many tets, a mean ratio of 0.78 and
// angles of 2 deg. The others had 0.87 and 8 deg or more.
double best_cell(const std::vector<double>& sizes)
{
  constexpr int kCandidates = 16;  // 4 % apart.
  double best = sizes.front();
  double least = std::numeric_limits<double>::infinity();
  for (int candidate = 0; candidate < kCandidates; ++candidate) {
    const double cell = sizes.front() * std::exp2(static_cast<double>(candidate) / kCandidates);
    const double misfit = std::abs(std::log(point_surplus(sizes, cell)));
    if (misfit < least) {
      least = misfit;
      best = cell;
    }
  }
  return best;
}

// Gives NETGEN's octree a root from which halving leads to cells of exactly `cell`.
void align_octree(::netgen::Mesh& mesh, double cell, double grading)
{
  ::netgen::Point3d low;
  ::netgen::Point3d high;
  mesh.GetBox(low, high);
  const ::netgen::Point<3> center = ::netgen::Center(low, high);
  const auto make = [&](double side) {
    const ::netgen::Vec<3> half(0.5 * side, 0.5 * side, 0.5 * side);
    mesh.SetLocalH(center - half, center + half, grading);
  };
  const double extent = std::max({high.X() - low.X(), high.Y() - low.Y(), high.Z() - low.Z()});
  // NETGEN makes the root somewhat larger than asked; an undivided root has its side as size.
  make(extent);
  const double enlargement = mesh.LocalHFunction().GetH(center) / extent;
  double root = cell;
  while (root < enlargement * extent) root *= 2.0;
  make(root / enlargement);
}

// Where there are samples, they alone count. NETGEN's sizes from the skin halve every cell whose
// skin edge is a little shorter than it (shaft, L = 2, K = 32: smallest angle 5.2 deg in place of
// 7.7).
void set_sizes(::netgen::Mesh& mesh, const FillInput& input, double grading)
{
  if (input.size_h.empty()) {
    mesh.CalcLocalH(grading);
    return;
  }
  align_octree(mesh, best_cell(input.size_h), grading);
  for (std::size_t s = 0; s < input.size_h.size(); ++s) {
    mesh.RestrictLocalH(to_point3d(point_at(std::span(input.size_xyz), s)),
                        largest_cell(input.size_h[s]));
  }
}

// NETGEN's step for tets that are there: it swaps edges and faces. Our own optimiser goes over what
// comes of it, in a tenth of the time that NETGEN's other steps take; docs/decisions.md has what
// each of them gave.
constexpr const char* kStepsForStart = "s";

::netgen::MeshingParameters parameters_of(const FillInput& input, const KernelSettings& settings)
{
  ::netgen::MeshingParameters parameters;
  parameters.grading = settings.grading;
  parameters.optsteps3d = settings.optimize_steps;
  parameters.filldist = kDistanceFromSkin;
  if (input.has_start()) parameters.optimize3d = kStepsForStart;
  // NETGEN divides cells above 1.5 times maxh: this closes the gaps between sparse samples.
  const auto largest = std::max_element(input.size_h.begin(), input.size_h.end());
  if (largest != input.size_h.end()) parameters.maxh = largest_cell(*largest);
  return parameters;
}

// Children with this mean ratio are as good as swaps make them.
//
// On four of five models all children took 1.2 to 1.8 times as long; on the fifth few are good. The
// mean of the mean ratio falls by 0.0001 to 0.0005. 1st percentiles change by 0.002 at most there,
// and fall by up to 0.008 on cases of configs/cases; over the corpus they stay.
constexpr double kGood = 0.75;

// Leaves to NETGEN the tets that are not good, and those with two of their vertices: all that a
// swap of an edge of theirs takes. Most others are of a lattice. NETGEN begins at no fixed tet.
void fix_good_tets(const FillOutput& start, ::netgen::Mesh& mesh)
{
  const std::size_t num_tets = start.tet_vertices.size() / 4;
  std::vector<std::uint8_t> is_of_poor_tet(start.vertex_xyz.size() / 3, 0);
  for (std::size_t t = 0; t < num_tets; ++t) {
    if (quality::mean_ratio(corners_at<4>(start.vertex_xyz, start.tet_vertices, t)) >= kGood) {
      continue;
    }
    for (std::size_t c = 0; c < 4; ++c) is_of_poor_tet[at(start.tet_vertices[4 * t + c])] = 1;
  }
  for (std::size_t t = 0; t < num_tets; ++t) {
    const auto tet = std::span(start.tet_vertices).subspan(4 * t, 4);
    const auto num_poor =
        std::ranges::count_if(tet, [&](LocalIndex v) { return is_of_poor_tet[at(v)] != 0; });
    if (num_poor < 2) fix_tet(mesh, static_cast<int>(t));
  }
}

class FillKernel final : public fill::Kernel {
 public:
  [[nodiscard]] FillOutput fill(const FillInput& input,
                                const KernelSettings& settings) const override
  {
    if (input.has_start() && settings.optimize_steps == 0) return input.start;
    NetgenSession session(parameters_of(input, settings));
    return session.run("fill", [&] {
      OrderedTets tets =
          input.has_start() ? improve(input, session) : mesh_skin(input, settings, session);
      return FillOutput{std::move(tets.vertex_xyz), std::move(tets.tet_vertices)};
    });
  }

 private:
  static OrderedTets improve(const FillInput& input, NetgenSession& session)
  {
    const auto num_vertices = static_cast<LocalIndex>(input.start.vertex_xyz.size() / 3);
    ::netgen::Mesh mesh;
    add_surface(mesh, input.start.vertex_xyz, input.triangle_vertices,
                point_order(num_vertices, 0));
    add_tets(mesh, input.start.tet_vertices);
    fix_good_tets(input.start, mesh);
    ::netgen::OptimizeVolume(session.parameters(), mesh);
    mesh.Compress();
    return tets_of(mesh, point_order(num_skin_vertices(input), 0));
  }

  static OrderedTets mesh_skin(const FillInput& input, const KernelSettings& settings,
                               NetgenSession& session)
  {
    const std::vector<LocalIndex> order =
        point_order(num_skin_vertices(input), settings.point_order_seed);
    ::netgen::Mesh mesh;
    add_surface(mesh, input.vertex_xyz, input.triangle_vertices, order);
    set_sizes(mesh, input, settings.grading);
    mesh_volume(session.parameters(), mesh);
    ::netgen::RemoveIllegalElements(mesh);
    if (settings.optimize_steps > 0) ::netgen::OptimizeVolume(session.parameters(), mesh);
    mesh.Compress();
    return tets_of(mesh, order);
  }
};

}  // namespace

std::unique_ptr<fill::Kernel> make_netgen_kernel() { return std::make_unique<FillKernel>(); }

}  // namespace tessera::netgen

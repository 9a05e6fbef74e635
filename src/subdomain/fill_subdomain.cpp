// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/fill_subdomain.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "tessera/fill/check.hpp"
#include "tessera/fill/size_samples.hpp"
#include "tessera/fill/subdivide.hpp"
#include "tessera/optimize/optimize.hpp"
#include "tessera/quality/tet_quality.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/measure_piece.hpp"

#include "subdomain/boundary_triangles.hpp"

namespace tessera::subdomain {
namespace {

// A skin, and the tets that some kernel put into it, unchecked.
struct RawFill {
  mesh::Skin skin{};
  mesh::ModelDistance distance{};
  fill::FillOutput tets{};
};

fill::FillInput input_of(const mesh::Skin& skin)
{
  return {.vertex_xyz = skin.vertex_xyz, .triangle_vertices = skin.triangle_vertices};
}

RawFill subdivide(const PartitionedMesh& cut, const refine::RefineContext& refine,
                  LocalIndex subdomain)
{
  const mesh::TetComplex complex = mesh::tet_complex(cut.coarse, cut.skeleton, cut.tets[subdomain]);
  const mesh::RefinedLattice lattice = refine::refine_lattice(complex.faces, refine);
  return {refine::extract_skin(complex.faces, lattice, cut.skeleton, subdomain), lattice.distance,
          fill::subdivide(complex, lattice)};
}

// The children of the coarse tets, made better by NETGEN.
RawFill improve_children(const PartitionedMesh& cut, const refine::RefineContext& refine,
                         LocalIndex subdomain, const fill::KernelSettings& settings,
                         const fill::Kernel& netgen)
{
  RawFill raw = subdivide(cut, refine, subdomain);
  if (!fill::all_positive(raw.tets)) {
    throw MeshError("children of coarse tets are folded: nothing to begin with");
  }
  fill::FillInput input = input_of(raw.skin);
  input.start = std::move(raw.tets);
  raw.tets = netgen.fill(input, settings);
  return raw;
}

// The triangles of a skin that are on the geometry.
std::vector<LocalIndex> outer_triangles(const mesh::Skin& skin, const mesh::Skeleton& skeleton)
{
  std::vector<LocalIndex> outer;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    if (skeleton.triangle_patch[at(skin.triangle_parent[at(t)])] == kNoIndex) continue;
    const auto first = skin.triangle_vertices.begin() + 3 * std::ptrdiff_t{t};
    outer.insert(outer.end(), first, first + 3);
  }
  return outer;
}

// Makes tets better by our own optimiser. Children that are to stay are divided only.
void optimize_tets(const PartitionedMesh& cut, const fill::FillTry& how, RawFill& raw)
{
  optimize::TetMesh tets{.vertex_xyz = std::move(raw.tets.vertex_xyz),
                         .tet_vertices = std::move(raw.tets.tet_vertices)};
  optimize::Schedule schedule = optimize::standard_schedule();
  if (how.split_corners) {
    tets.outer_triangles = outer_triangles(raw.skin, cut.skeleton);
    schedule.steps.insert(schedule.steps.begin(), optimize::Step::divide);
  }
  if (how.kernel == fill::KernelKind::subdivide) {
    tets.vertex_fixed.assign(tets.vertex_xyz.size() / 3, 1);
    schedule.steps = optimize::parse_steps("dmmww");
  }
  const bool may_be_folded = how.kernel == fill::KernelKind::optimize;
  optimize::OptimizeResult better = optimize::optimize(tets, schedule, {.untangle = may_be_folded});
  raw.tets = {std::move(better.vertex_xyz), std::move(better.tet_vertices)};
}

// The smallest angle of each tet.
std::vector<double> angles_deg(const fill::FillOutput& tets)
{
  std::vector<double> angles;
  for (std::size_t t = 0; t < tets.tet_vertices.size(); t += 4) {
    quality::TetCorners corners{};
    for (std::size_t c = 0; c < 4; ++c) {
      const double* const p = &tets.vertex_xyz[3 * at(tets.tet_vertices[t + c])];
      corners[c] = {p[0], p[1], p[2]};
    }
    angles.push_back(quality::angle_deg(quality::shape_of(corners).largest_cosine));
  }
  return angles;
}

// Puts vertices into the worst tets that NETGEN leaves, as across a thin wall, where tets have four
// corners on the skin. Beside a needle of the skin nothing gets much better: then all stays. So it
// does where the skin has far too long edges for its walls.
void mend_worst_tets(const PartitionedMesh& cut, RawFill& raw)
{
  constexpr double kPoor_deg = 8.0;      // That a fill gets another try for.
  constexpr std::ptrdiff_t kFewOf = 10;  // Tets for each poor one.
  constexpr double kMendBelow = 0.35;    // Mean ratio.
  constexpr double kLeastGain = 1.1;     // Of the smallest angle.
  if (raw.tets.tet_vertices.empty() || !fill::all_positive(raw.tets)) return;
  const std::vector<double> before = angles_deg(raw.tets);
  const auto num_poor = std::ranges::count_if(before, [](double a) { return a < kPoor_deg; });
  if (num_poor == 0 || kFewOf * num_poor > std::ssize(before)) return;
  optimize::OptimizeResult result = optimize::optimize(
      {.vertex_xyz = raw.tets.vertex_xyz,
       .tet_vertices = raw.tets.tet_vertices,
       .outer_triangles = outer_triangles(raw.skin, cut.skeleton)},
      {.steps = optimize::parse_steps("iwwsiwwsiww"), .insert_below = kMendBelow});
  fill::FillOutput mended{std::move(result.vertex_xyz), std::move(result.tet_vertices)};
  if (std::ranges::min(angles_deg(mended)) > kLeastGain * std::ranges::min(before)) {
    raw.tets = std::move(mended);
  }
}

// What NETGEN makes of the skin alone.
RawFill mesh_skin(const PartitionedMesh& cut, const refine::RefineContext& refine,
                  LocalIndex subdomain, const fill::KernelSettings& settings,
                  const fill::Kernel& netgen)
{
  const mesh::Complex complex = mesh::skin_complex(cut.skeleton, subdomain);
  const mesh::RefinedLattice lattice = refine::refine_lattice(complex, refine);
  RawFill raw{
      refine::extract_skin(complex, lattice, cut.skeleton, subdomain), lattice.distance, {}};
  fill::FillInput input = input_of(raw.skin);
  fill::add_size_samples(cut.coarse, cut.tets[subdomain], cut.vertex_size, refine.levels, input);
  raw.tets = netgen.fill(input, settings);
  return raw;
}

RawFill filled_by_kernel(const PartitionedMesh& cut, const refine::RefineContext& refine,
                         LocalIndex subdomain, const fill::FillTry& how, const fill::Kernel& netgen)
{
  if (how.kernel != fill::KernelKind::netgen) return subdivide(cut, refine, subdomain);
  const auto start = how.start == fill::FillStart::children ? improve_children : mesh_skin;
  return start(cut, refine, subdomain, how.settings, netgen);
}

RawFill raw_fill(const PartitionedMesh& cut, const refine::RefineContext& refine,
                 LocalIndex subdomain, const fill::FillTry& how, const fill::Kernel& netgen)
{
  RawFill raw = filled_by_kernel(cut, refine, subdomain, how, netgen);
  if (how.kernel == fill::KernelKind::optimize
      || (how.split_corners && fill::all_positive(raw.tets))) {
    optimize_tets(cut, how, raw);
  }
  if (how.kernel == fill::KernelKind::netgen) mend_worst_tets(cut, raw);
  return raw;
}

FilledPiece check_and_measure(const PartitionedMesh& cut, LocalIndex subdomain, RawFill& raw)
{
  const fill::FillFacts facts = fill::check_fill(input_of(raw.skin), raw.tets);
  FilledPiece filled;
  mesh::Piece& piece = filled.piece;
  piece.subdomain = subdomain;
  piece.material = cut.decomposition.subdomain_material[at(subdomain)];
  piece.vertex_xyz = std::move(raw.tets.vertex_xyz);
  piece.skin_host = raw.skin.vertex_host;
  piece.skin_index = raw.skin.vertex_index;
  piece.tet_vertices = std::move(raw.tets.tet_vertices);
  add_boundary(raw.skin, cut.skeleton, facts.triangle_tet, piece);

  filled.result = measure_filled_piece(cut, raw.skin, piece);
  PieceSummary& summary = filled.result.summary;
  summary.num_held_back = raw.distance.num_held_back;
  summary.model_distance = raw.distance.largest;
  summary.held_back_distance = raw.distance.largest_held_back;
  summary.volume = facts.volume;
  return filled;
}

}  // namespace

FilledPiece fill_subdomain(const PartitionedMesh& cut, const refine::RefineContext& refine,
                           LocalIndex subdomain, const fill::FillTry& how,
                           const fill::Kernel& netgen)
{
  RawFill raw = raw_fill(cut, refine, subdomain, how, netgen);
  FilledPiece filled;
  try {
    filled = check_and_measure(cut, subdomain, raw);
  } catch (const MeshError&) {
    // Of what was subdivided nothing else can be wrong than that it is folded.
    const bool is_subdivision = how.kernel == fill::KernelKind::subdivide;
    if (!is_subdivision || fill::all_positive(raw.tets)) throw;
    filled.result.summary.is_folded = true;
  }
  filled.result.summary.subdomain = subdomain;
  filled.result.summary.kernel = how.kernel;
  return filled;
}

}  // namespace tessera::subdomain

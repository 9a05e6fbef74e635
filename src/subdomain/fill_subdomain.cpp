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
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/measure_piece.hpp"

#include "subdomain/files/boundary_triangles.hpp"
#include "subdomain/files/line_edges.hpp"
#include "subdomain/layers/layer_columns.hpp"
#include "subdomain/layers/measure_layers.hpp"
#include "subdomain/refine/piece_schedule.hpp"

namespace tessera::subdomain {
namespace {

// A skin, and the tets that some kernel put into it, unchecked.
struct RawFill {
  mesh::Skin skin{};
  mesh::Columns columns{};
  mesh::ModelDistance distance{};
  fill::FillOutput tets{};
};

RawFill skin_of(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                const refine::RefineContext& refine, LocalIndex subdomain)
{
  RawFill raw;
  raw.skin = refine::extract_skin(complex, lattice, refine.skeleton, subdomain);
  raw.columns = make_columns(complex, lattice, raw.skin, refine, subdomain);
  raw.distance = lattice.distance;
  return raw;
}

fill::FillInput input_of(const mesh::Skin& skin)
{
  return {.vertex_xyz = skin.vertex_xyz, .triangle_vertices = skin.triangle_vertices};
}

RawFill subdivide(const PartitionedMesh& cut, const refine::RefineContext& refine,
                  LocalIndex subdomain)
{
  const mesh::TetComplex complex = mesh::tet_complex(cut.coarse, cut.skeleton, cut.tets[subdomain]);
  const mesh::RefinedLattice lattice = refine::refine_lattice(complex.faces, refine);
  RawFill raw = skin_of(complex.faces, lattice, refine, subdomain);
  raw.tets = fill::subdivide(complex, lattice);
  return raw;
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

// The triangles of a skin that are on the geometry. In front of a wall there are layers.
std::vector<LocalIndex> outer_triangles(const mesh::Skin& skin, const PartitionedMesh& cut)
{
  std::vector<LocalIndex> outer;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    const LocalIndex patch = cut.skeleton.triangle_patch[at(skin.triangle_parent[at(t)])];
    if (patch == kNoIndex || cut.coarse.layers.is_wall(patch)) continue;
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
  optimize::Schedule schedule = piece_schedule(how.split_corners);
  if (how.split_corners) tets.outer_triangles = outer_triangles(raw.skin, cut);
  if (how.kernel == fill::KernelKind::subdivide) {
    tets.vertex_fixed.assign(tets.vertex_xyz.size() / 3, 1);
    schedule.steps = optimize::parse_steps("dmmww");
  }
  const bool may_be_folded = how.kernel == fill::KernelKind::optimize;
  optimize::OptimizeResult better = optimize::optimize(tets, schedule, {.untangle = may_be_folded});
  raw.tets = {std::move(better.vertex_xyz), std::move(better.tet_vertices)};
}

// What NETGEN makes of the skin alone.
RawFill mesh_skin(const PartitionedMesh& cut, const refine::RefineContext& refine,
                  LocalIndex subdomain, const fill::KernelSettings& settings,
                  const fill::Kernel& netgen)
{
  const mesh::Complex complex = mesh::skin_complex(cut.skeleton, subdomain);
  const mesh::RefinedLattice lattice = refine::refine_lattice(complex, refine);
  RawFill raw = skin_of(complex, lattice, refine, subdomain);
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

// Our optimiser goes over all but children that stay as they are. What NETGEN leaves inverted is
// for the check, and so for the next try.
bool is_optimized(const fill::FillTry& how, const RawFill& raw)
{
  switch (how.kernel) {
    case fill::KernelKind::optimize:
      return true;
    case fill::KernelKind::netgen:
      return fill::all_positive(raw.tets);
    case fill::KernelKind::subdivide:
      return how.split_corners && fill::all_positive(raw.tets);
  }
  return false;
}

RawFill raw_fill(const PartitionedMesh& cut, const refine::RefineContext& refine,
                 LocalIndex subdomain, const fill::FillTry& how, const fill::Kernel& netgen)
{
  RawFill raw = filled_by_kernel(cut, refine, subdomain, how, netgen);
  if (is_optimized(how, raw)) optimize_tets(cut, how, raw);
  return raw;
}

FilledPiece check_and_measure(const PartitionedMesh& cut, LocalIndex subdomain,
                              const LayerTables* layers, RawFill& raw)
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
  add_line_edges(cut, piece);

  filled.result = measure_filled_piece(cut, raw.skin, piece);
  PieceSummary& summary = filled.result.summary;
  summary.num_held_back = raw.distance.num_held_back;
  summary.model_distance = raw.distance.largest;
  summary.held_back_distance = raw.distance.largest_held_back;
  summary.volume = facts.volume;
  piece.columns = std::move(raw.columns);
  if (layers != nullptr) measure_layers(filled.piece, *layers, summary);
  return filled;
}

}  // namespace

FilledPiece fill_subdomain(const PartitionedMesh& cut, const refine::RefineContext& refine,
                           LocalIndex subdomain, const fill::FillTry& how,
                           const fill::Kernel& netgen, const LayerTables* layers)
{
  RawFill raw = raw_fill(cut, refine, subdomain, how, netgen);
  FilledPiece filled;
  try {
    filled = check_and_measure(cut, subdomain, layers, raw);
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

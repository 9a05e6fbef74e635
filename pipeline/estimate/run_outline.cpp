// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/estimate/run_outline.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/subdomain/count_pieces.hpp"
#include "tessera/subdomain/layer_tables.hpp"

namespace tessera::pipeline {
namespace {

// Fine ones. On the geometry there are those between materials, and they are no seams.
GlobalIndex num_seam_triangles(const mesh::Skeleton& skeleton, const mesh::LatticeLevels& levels,
                               LocalIndex subdomain)
{
  GlobalIndex sum = 0;
  for (const LocalIndex t : skeleton.triangles_of(subdomain)) {
    if (skeleton.triangle_patch[at(t)] != kNoIndex) continue;
    sum += mesh::num_small_triangles(skeleton, levels, t);
  }
  return sum;
}

template <class Count>
GlobalIndex sum_over(const subdomain::SubdomainRange& range, Count&& count)
{
  GlobalIndex sum = 0;
  for (LocalIndex s = range.first; s < range.last; ++s) sum += count(s);
  return sum;
}

// A split makes eight of every tet, of those as well that were cut beside a finer edge. Vertices
// stay those of as many levels more.
void count_split_tets(const subdomain::PartitionedMesh& cut, int splits,
                      std::vector<number::PieceCounts>& pieces)
{
  const auto split = subdomain::count_subdivided_pieces(cut, cut.levels, splits);
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    pieces[s].tets = split[s].tets;
    pieces[s].boundary_triangles = split[s].boundary_triangles;
    pieces[s].line_edges = split[s].line_edges;
  }
}

std::vector<subdomain::SubdomainRange> one_by_one(
    const std::vector<subdomain::SubdomainRange>& files)
{
  std::vector<subdomain::SubdomainRange> single;
  for (const subdomain::SubdomainRange& file : files) {
    for (LocalIndex s = file.first; s < file.last; ++s) single.push_back({s, s, s + 1});
  }
  return single;
}

void count_seam_triangles(const subdomain::PartitionedMesh& cut, RunOutline& outline)
{
  const mesh::LatticeLevels filled = mesh::lattice_levels(cut.skeleton, cut.levels);
  for (LocalIndex s = 0; s < cut.num_subdomains(); ++s) {
    if (outline.kernels[at(s)] == fill::KernelKind::subdivide) continue;
    outline.seam_triangles[at(s)] = num_seam_triangles(cut.skeleton, filled, s);
  }
}

}  // namespace

bool are_counts_known(const std::vector<fill::KernelKind>& kernels)
{
  return std::ranges::all_of(
      kernels, [](fill::KernelKind kernel) { return kernel == fill::KernelKind::subdivide; });
}

bool divides_corners(const fill::FillOptions& options, const std::vector<fill::KernelKind>& kernels)
{
  return std::ranges::any_of(
      kernels, [&](fill::KernelKind kernel) { return fill::splits_corners(options, kernel); });
}

GlobalIndex RunOutline::tets_of(const subdomain::SubdomainRange& range) const
{
  return sum_over(range, [&](LocalIndex s) { return pieces[at(s)].tets; });
}

GlobalIndex RunOutline::boundary_triangles_of(const subdomain::SubdomainRange& range) const
{
  return sum_over(range, [&](LocalIndex s) { return pieces[at(s)].boundary_triangles; });
}

int splits_after_fill(const fill::FillOptions& options,
                      const std::vector<fill::KernelKind>& kernels, int levels)
{
  return are_counts_known(kernels) ? 0 : levels - fill::fill_levels(options, levels);
}

RunOutline outline_run(const subdomain::PartitionedMesh& cut,
                       const std::vector<fill::KernelKind>& kernels,
                       const std::vector<subdomain::SubdomainRange>& files,
                       const PieceChoices& choices)
{
  const mesh::EdgeLevels all = cut.levels.shifted(choices.splits);
  RunOutline outline{.levels = all.largest(),
                     .fill_levels = cut.levels.largest(),
                     .num_coarse_tets = cut.coarse.num_tets(),
                     .kernels = kernels,
                     .pieces = subdomain::count_subdivided_pieces(cut, all),
                     .files = files,
                     .improves_seams = choices.improves_seams,
                     .has_files = choices.has_files,
                     .is_curved = choices.is_curved};
  if (choices.splits > 0) count_split_tets(cut, choices.splits, outline.pieces);
  outline.are_counts_exact = are_counts_known(kernels) && !choices.divides_corners;
  outline.is_one_pass = outline.are_counts_exact && choices.has_files && !choices.is_curved;
  outline.jobs = outline.is_one_pass ? files : one_by_one(files);
  const mesh::LatticeLevels of_skeleton = mesh::lattice_levels(cut.skeleton, all);
  outline.num_skeleton_vertices = mesh::num_skeleton_points(cut.skeleton, of_skeleton);
  if (const auto layers = subdomain::layer_tables(cut, choices.splits)) {
    outline.num_skeleton_vertices += layers->num_points();
  }
  outline.seam_triangles.resize(kernels.size());
  if (choices.improves_seams) count_seam_triangles(cut, outline);
  return outline;
}

std::optional<std::string> file_too_large(const RunOutline& outline, const config::Case& run_case)
{
  const GlobalIndex most =
      outline.is_curved ? 4 * subdomain::kMostTetsOfFile / 10 : subdomain::kMostTetsOfFile;
  for (const subdomain::SubdomainRange& file : outline.files) {
    const GlobalIndex num_tets = outline.tets_of(file);
    if (num_tets <= most) continue;
    const char* const key = run_case.output.parts > 0   ? "output.parts"
                            : run_case.output.files > 0 ? "output.files"
                                                        : "decompose.subdomains";
    return fmt::format(
        "{}: file {} of {} would hold {} tets, and its 32-bit indices reach to {}; choose more",
        key, file.number, outline.files.size(), num_tets, most);
  }
  return std::nullopt;
}

}  // namespace tessera::pipeline

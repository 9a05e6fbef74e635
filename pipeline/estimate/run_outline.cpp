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

// A split makes eight of every tet, of those as well that were cut beside a finer edge.
void count_split_tets(const subdomain::PartitionedMesh& cut, int splits,
                      std::vector<number::PieceCounts>& pieces)
{
  const auto filled = subdomain::count_subdivided_pieces(cut, cut.levels);
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    pieces[s].tets = filled[s].tets << 3 * splits;
    pieces[s].boundary_triangles = filled[s].boundary_triangles << 2 * splits;
    pieces[s].line_edges = filled[s].line_edges << splits;
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

bool RunOutline::improves_seams() const
{
  return std::ranges::any_of(seam_triangles, [](GlobalIndex count) { return count > 0; });
}

void RunOutline::hand_over_pieces()
{
  has_files = false;
  fill_into_store();
}

void RunOutline::curve_pieces()
{
  is_curved = true;
  fill_into_store();
}

void RunOutline::divide_corners()
{
  are_counts_exact = false;
  fill_into_store();
}

void RunOutline::fill_into_store()
{
  if (!is_one_pass) return;
  is_one_pass = false;
  jobs.clear();
  for (const subdomain::SubdomainRange& file : files) {
    for (LocalIndex s = file.first; s < file.last; ++s) jobs.push_back({s, s, s + 1});
  }
}

int splits_after_fill(const fill::FillOptions& options,
                      const std::vector<fill::KernelKind>& kernels, int levels)
{
  return are_counts_known(kernels) ? 0 : levels - fill::fill_levels(options, levels);
}

RunOutline outline_run(const subdomain::PartitionedMesh& cut,
                       const std::vector<fill::KernelKind>& kernels, int splits,
                       const std::vector<subdomain::SubdomainRange>& files, bool improve_seams)
{
  const mesh::EdgeLevels all = cut.levels.shifted(splits);
  RunOutline outline{.levels = all.largest(),
                     .fill_levels = cut.levels.largest(),
                     .num_coarse_tets = cut.coarse.num_tets(),
                     .kernels = kernels,
                     .pieces = subdomain::count_subdivided_pieces(cut, all),
                     .files = files};
  if (splits > 0) count_split_tets(cut, splits, outline.pieces);
  outline.are_counts_exact = are_counts_known(kernels);
  outline.is_one_pass = outline.are_counts_exact;
  const mesh::LatticeLevels of_skeleton = mesh::lattice_levels(cut.skeleton, all);
  outline.num_skeleton_vertices = mesh::num_skeleton_points(cut.skeleton, of_skeleton);
  if (const auto layers = subdomain::layer_tables(cut.coarse, cut.skeleton, of_skeleton)) {
    outline.num_skeleton_vertices += layers->num_points();
  }
  const mesh::LatticeLevels filled = mesh::lattice_levels(cut.skeleton, cut.levels);
  outline.seam_triangles.resize(kernels.size());
  for (LocalIndex s = 0; improve_seams && s < cut.num_subdomains(); ++s) {
    if (kernels[at(s)] == fill::KernelKind::subdivide) continue;
    outline.seam_triangles[at(s)] = num_seam_triangles(cut.skeleton, filled, s);
  }
  outline.jobs = outline.is_one_pass ? files : subdomain::file_ranges(cut.num_subdomains(), 0);
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

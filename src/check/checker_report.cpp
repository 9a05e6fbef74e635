// SPDX-License-Identifier: BSD-3-Clause
// What Checker found, summed over the ranks.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "check/checker.hpp"

namespace tessera::check {
namespace {

// Adds to the last figures if they are of the same subdomain.
void add_to(std::vector<SubdomainFigures>& subdomains, const SubdomainFigures& figures)
{
  if (subdomains.empty() || subdomains.back().id != figures.id)
    subdomains.push_back({.id = figures.id, .material = figures.material});
  SubdomainFigures& sum = subdomains.back();
  sum.num_tets += figures.num_tets;
  sum.volume += figures.volume;
  sum.digest += figures.digest;
}

}  // namespace

GlobalIndex Checker::num_pieces() const
{
  return tets_.num_pieces + (boundary_ == nullptr ? 0 : boundary_->num_pieces);
}

CheckReport Checker::report(const Findings* id_findings)
{
  constexpr std::array kIdKinds{Kind::point_position, Kind::point_id_twice, Kind::point_id_hole};
  if (id_findings != nullptr) findings_.merge(*id_findings, kIdKinds);
  sum_over_ranks(counts_);
  CheckReport report;
  set_counts(report);
  set_sums(report);
  if (report.num_tets == 0 && comm_.rank() == 0)
    findings_.add(Kind::no_tets, {}, [] { return "the mesh has no tets"; });

  Findings all;
  for (const Findings& found : comm_.all_gather_values(findings_)) all.merge(found);
  report.defects = all.to_defects();
  report.conforms = report.defects.empty();
  report.notes = notes();
  if (looks_partial(all))
    report.notes.emplace_back(
        "these are the defects of a mesh of which only some pieces were made; --partial accepts "
        "such a mesh");
  return report;
}

void Checker::sum_over_ranks(Counts& counts) const
{
  constexpr std::array kMembers{&Counts::num_pieces_with_point_ids,
                                &Counts::num_tet_pieces_with_point_ids,
                                &Counts::num_pieces_with_cell_ids,
                                &Counts::num_pieces_with_subdomains,
                                &Counts::num_pieces_of_second_order,
                                &Counts::num_other_cells,
                                &Counts::num_boundary_pieces_without_tet,
                                &Counts::num_boundary_pieces_without_patch,
                                &Counts::num_vertices,
                                &Counts::num_edges,
                                &Counts::num_edge_halves,
                                &Counts::num_triangles,
                                &Counts::num_outside,
                                &Counts::num_seam,
                                &Counts::num_interface,
                                &Counts::num_unlisted,
                                &Counts::num_nonmanifold_edges};
  static_assert(sizeof(Counts) == kMembers.size() * sizeof(GlobalIndex), "a member is missing");
  std::vector<GlobalIndex> values;
  values.reserve(kMembers.size());
  for (const auto member : kMembers) values.push_back(counts.*member);
  comm_.sum_in_place(values);
  for (std::size_t i = 0; i < kMembers.size(); ++i) counts.*kMembers[i] = values[i];
}

void Checker::set_counts(CheckReport& report) const
{
  report.has_global_ids = counts_.num_tet_pieces_with_point_ids == tets_.num_pieces
                          && counts_.num_pieces_with_cell_ids == tets_.num_pieces;
  report.has_digest = counts_.num_tet_pieces_with_point_ids == tets_.num_pieces;
  report.is_partial = is_partial_;
  report.matched_by_ids = identity_ == VertexIdentity::ids;
  report.num_vertices = counts_.num_vertices;
  report.num_edges = counts_.num_edges + counts_.num_edge_halves / 2;
  report.num_triangles = counts_.num_triangles;
  report.num_boundary_triangles = counts_.num_outside;
  report.num_interface_triangles = counts_.num_interface;
  report.num_seam_triangles = counts_.num_seam;
  report.num_open_seam_triangles = boundary_ == nullptr ? 0 : counts_.num_unlisted;
  report.num_nonmanifold_edges = counts_.num_nonmanifold_edges;
  report.num_components = num_components_;
  report.num_boundary_components = num_boundary_components_;
}

void Checker::set_sums(CheckReport& report)
{
  ShapeSums shapes;
  ShapeSums seam_shapes;
  for (const PieceRecord& record : all_records(records_, comm_)) {
    add_to(report.subdomains, record.figures);
    report.num_tets += record.figures.num_tets;
    report.volume += record.figures.volume;
    report.digest += record.figures.digest;
    report.boundary_area += record.boundary_area;
    report.scaled_jacobian_min = std::min(report.scaled_jacobian_min, record.min_scaled_jacobian);
    shapes.add(record.shapes);
    seam_shapes.add(record.seam_shapes);
  }
  report.order = counts_.num_pieces_of_second_order > 0 ? 2 : 1;
  const GlobalIndex num_nodes = report.order == 2 ? report.num_edges : 0;
  report.euler_characteristic =
      report.num_vertices - num_nodes - report.num_edges + report.num_triangles - report.num_tets;

  comm_.sum_in_place(mean_ratios_.counts());
  comm_.sum_in_place(seam_mean_ratios_.counts());
  comm_.sum_in_place(edge_lengths_.counts());
  report.quality = quality_figures(shapes, mean_ratios_);
  report.seam_quality = quality_figures(seam_shapes, seam_mean_ratios_);
  report.seam_ks_distance = ks_distance(seam_mean_ratios_, mean_ratios_);
  report.edge_length = edge_lengths_.figures();
}

std::vector<std::string> Checker::notes() const
{
  std::vector<std::string> notes;
  const auto note = [&](GlobalIndex count, const std::string& text) {
    if (count > 0) notes.push_back(fmt::format("{} {}", count, text));
  };
  note(num_pieces() - counts_.num_pieces_with_point_ids, "pieces have no point ids");
  note(tets_.num_pieces - counts_.num_pieces_with_cell_ids, "pieces have no cell ids");
  note(counts_.num_other_cells, "cells are no tets and were left out");
  note(counts_.num_boundary_pieces_without_tet,
       "boundary pieces have no array \"tet\", so only their triangles were compared");
  note(counts_.num_boundary_pieces_without_patch, "boundary pieces have no array \"patch\"");
  if (counts_.num_pieces_with_subdomains > 0)
    note(tets_.num_pieces - counts_.num_pieces_with_subdomains,
         "pieces have no array \"subdomain\", so the piece's number took its place");
  if (identity_ == VertexIdentity::positions)
    notes.emplace_back("points of different pieces were matched by the bits of their positions");
  if (boundary_ == nullptr)
    notes.emplace_back("no boundary file: triangles on one tet are taken for the boundary");
  return notes;
}

// Whether holes in the ids and open seams are all there is.
bool Checker::looks_partial(const Findings& findings) const
{
  constexpr std::array kKinds{Kind::point_id_hole, Kind::cell_id_hole, Kind::boundary_missing};
  GlobalIndex num_others = 0;
  for (std::size_t k = 0; k < kNumKinds; ++k) num_others += findings.count(static_cast<Kind>(k));
  for (const Kind kind : kKinds) num_others -= findings.count(kind);
  const bool has_holes =
      findings.count(Kind::point_id_hole) > 0 || findings.count(Kind::cell_id_hole) > 0;
  const bool has_open_seams = boundary_ == nullptr || counts_.num_unlisted > 0;
  return !is_partial_ && num_others == 0 && has_holes && has_open_seams;
}

}  // namespace tessera::check

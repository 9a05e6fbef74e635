// SPDX-License-Identifier: BSD-3-Clause
#include "check/checker.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "check/match_edges.hpp"
#include "check/piece_topology.hpp"
#include "check/second_order.hpp"

namespace tessera::check {
namespace {

// Enough for the ranks of a node; few enough that their surfaces fit into memory beside the rest.
constexpr LocalIndex kPiecesInBatch = 32;

GlobalIndex num_tets(const PieceRecords& records)
{
  GlobalIndex num_tets = 0;
  for (const PieceRecord& record : records.all()) num_tets += record.figures.num_tets;
  return num_tets;
}

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

// Runs what reads a piece. Whatever is wrong then is so with the piece's file.
template <class Work>
void with_piece_name(PieceName name, const Work& work)
{
  try {
    work();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: {}", to_text(name), error.what()));
  }
}

}  // namespace

Checker::Checker(const PieceSource& tets, const PieceSource* boundary,
                 const comm::Communicator& comm, CheckerOptions options)
    : tets_(tets),
      boundary_(boundary),
      comm_(comm),
      identity_(options.identity),
      is_partial_(options.is_partial),
      triangles_(boundary == nullptr  ? BoundaryFile::none
                 : options.is_partial ? BoundaryFile::partial
                                      : BoundaryFile::complete,
                 comm, findings_),
      vertices_(comm, findings_)
{
}

template <class Visit>
void Checker::for_each_own_piece(Range range, bool is_boundary, const Visit& visit) const
{
  comm::all_or_none(comm_, [&] {
    for (LocalIndex p = range.begin; p < range.end; ++p) {
      if (p % comm_.size() != comm_.rank()) continue;
      const PieceName name{p, is_boundary};
      with_piece_name(name, [&] { visit(name); });
    }
  });
}

// The same whatever the number of ranks, since what is reported may depend on it.
LocalIndex Checker::num_batches() const
{
  return std::max<LocalIndex>(1, (tets_.num_pieces + kPiecesInBatch - 1) / kPiecesInBatch);
}

Checker::Range Checker::batch_of(LocalIndex num_pieces, LocalIndex batch) const
{
  const auto cut = [&](GlobalIndex b) {
    return static_cast<LocalIndex>(b * num_pieces / num_batches());
  };
  return {cut(batch), cut(GlobalIndex{batch} + 1)};
}

PieceMesh Checker::load(PieceName name, Findings& findings) const
{
  const PieceSource& source = name.is_boundary ? *boundary_ : tets_;
  return make_piece_mesh(name, source.read(name.piece), identity_, findings);
}

bool Checker::match()
{
  for (LocalIndex batch = 0; batch < num_batches(); ++batch) {
    if (!read_batch(batch)) return false;
    match_batch();
  }
  match_rest();
  return true;
}

// Whether the pieces read so far have point ids, all or none.
bool Checker::read_batch(LocalIndex batch)
{
  const Range tets = batch_of(tets_.num_pieces, batch);
  GlobalIndex num_read = tets.end;
  for_each_own_piece(tets, false, [&](PieceName name) { read_tets(name); });
  if (boundary_ != nullptr) {
    const Range listed = batch_of(boundary_->num_pieces, batch);
    num_read += listed.end;
    for_each_own_piece(listed, true, [&](PieceName name) { read_boundary(name); });
  }
  const GlobalIndex num_with_ids = comm_.sum(counts_.num_pieces_with_point_ids);
  if (identity_ == VertexIdentity::ids && num_with_ids > 0 && num_with_ids < num_read) return false;
  // Pieces without ids were matched by position as they were read.
  if (num_with_ids == 0) identity_ = VertexIdentity::positions;
  return true;
}

void Checker::read_tets(PieceName name)
{
  PieceMesh mesh = load(name, findings_);
  const PieceTopology topology = analyse_topology(mesh, edge_lengths_, findings_);
  PieceSurface& surface = surfaces_.emplace_back(make_surface(mesh, topology, shown_, seam_keys_));
  records_.push_back(measure(mesh, mean_ratios_, findings_));

  if (mesh.has_point_ids) {
    ++counts_.num_pieces_with_point_ids;
    ++counts_.num_tet_pieces_with_point_ids;
  }
  if (mesh.has_cell_ids) ++counts_.num_pieces_with_cell_ids;
  if (mesh.has_subdomains) ++counts_.num_pieces_with_subdomains;
  if (mesh.is_of_second_order()) ++counts_.num_pieces_of_second_order;
  counts_.num_other_cells += mesh.arrays.num_other_cells;
  counts_.num_triangles += topology.num_inner_triangles;
  counts_.num_edges += topology.num_edges;
  num_components_ += topology.num_components;
  take_ids(mesh, surface);
  if (comm_.size() < tets_.num_pieces) return;
  mesh.arrays.cell_ints["subdomain"] = std::move(mesh.subdomain);
  only_piece_ = std::move(mesh.arrays);
}

void Checker::read_boundary(PieceName name)
{
  const PieceMesh mesh = load(name, findings_);
  append_boundary(mesh, shown_);
  if (mesh.has_point_ids) ++counts_.num_pieces_with_point_ids;
  if (mesh.num_cells() == 0) return;
  if (!mesh.arrays.cell_longs.contains("tet")) ++counts_.num_boundary_pieces_without_tet;
  if (!mesh.arrays.cell_ints.contains("patch")) ++counts_.num_boundary_pieces_without_patch;
}

// Counts the vertices that no other piece can have, and takes their ids and those of the cells.
void Checker::take_ids(const PieceMesh& mesh, const PieceSurface& surface)
{
  std::vector<bool> is_taken(static_cast<std::size_t>(mesh.num_points()), false);
  for (const VertexRecord& vertex : surface.vertices)
    is_taken[static_cast<std::size_t>(vertex.point)] = true;
  std::vector<GlobalIndex> inner_ids;
  for_each_used_vertex(mesh, [&](LocalIndex v) {
    if (is_taken[static_cast<std::size_t>(v)]) return;
    is_taken[static_cast<std::size_t>(v)] = true;
    ++counts_.num_vertices;
    inner_ids.push_back(mesh.point_id(v));
  });
  const LocalIndex piece = mesh.name.piece;
  if (mesh.identity == VertexIdentity::ids)
    append_runs(std::move(inner_ids), piece, point_id_space(), point_ids_, findings_);
  if (mesh.has_cell_ids)
    append_runs(mesh.arrays.cell_ids, piece, cell_id_space(), cell_ids_, findings_);
}

GlobalIndex Checker::num_pieces() const
{
  return tets_.num_pieces + (boundary_ == nullptr ? 0 : boundary_->num_pieces);
}

void Checker::match_batch()
{
  const auto verdicts = triangles_.add(std::exchange(shown_.triangles, {}));
  vertices_.add(std::exchange(shown_.vertices, {}), identity_);
  apply_all(verdicts);
}

void Checker::apply_all(std::span<const TriangleVerdict> verdicts)
{
  for (const TriangleVerdict& verdict : verdicts)
    apply(verdict, surface_of(verdict.piece), seam_keys_);
  std::set<LocalIndex> pieces;
  for (const TriangleVerdict& verdict : verdicts) pieces.insert(verdict.piece);
  for (const LocalIndex piece : pieces) {
    close_edges(surface_of(piece), edges_);
    shrink(surface_of(piece));
  }
  vertices_.mark_seam(std::exchange(seam_keys_, {}));
}

// Rank r has the pieces r, r + size, …
PieceSurface& Checker::surface_of(LocalIndex piece)
{
  return surfaces_[static_cast<std::size_t>(piece / comm_.size())];
}

void Checker::match_rest()
{
  const auto verdicts = triangles_.finish();
  for (const TriangleVerdict& verdict : verdicts)
    apply(verdict, surface_of(verdict.piece), seam_keys_);
  vertices_.mark_seam(std::exchange(seam_keys_, {}));
  take_triangles();
  match_last_edges();
  match_last_vertices();
}

void Checker::take_triangles()
{
  for (std::size_t s = 0; s < surfaces_.size(); ++s) add_outside_areas(surfaces_[s], records_[s]);
  const TriangleCounts& counts = triangles_.counts();
  counts_.num_triangles += counts.num_triangles;
  counts_.num_outside += counts.num_outside;
  counts_.num_seam += counts.num_seam;
  counts_.num_interface += counts.num_interface;
  counts_.num_unlisted += counts.num_unlisted;
  num_components_ = count_components(num_components_, triangles_.links(), comm_);
}

// Flags of the vertices of all surfaces, one surface after the other.
std::vector<VertexFlags> Checker::flags_of_surfaces() const
{
  std::vector<VertexKey> keys;
  for (const PieceSurface& surface : surfaces_)
    for (const VertexRecord& vertex : surface.vertices)
      keys.push_back(key_of(vertex, surface.identity));
  return vertices_.flags(keys);
}

void Checker::match_last_edges()
{
  const std::vector<VertexFlags> all_flags = flags_of_surfaces();
  std::span<const VertexFlags> left(all_flags);
  EdgeMatch own;
  for (PieceSurface& surface : surfaces_) {
    const auto flags = left.first(surface.vertices.size());
    left = left.subspan(flags.size());
    for (std::size_t v = 0; v < flags.size(); ++v) {
      const VertexRecord& vertex = surface.vertices[v];
      if (flags[v].is_on_seam && !vertex.is_on_seam) surface.seam_points.push_back(vertex.point);
    }
    match_own_edges(close_last_edges(surface, flags, edges_), own, findings_);
  }
  const EdgeMatch shared = match_edges(std::exchange(edges_.shared, {}), comm_, findings_);
  for (const EdgeMatch& match : {own, shared}) {
    counts_.num_edges += match.num_edges;
    counts_.num_edge_halves -= match.num_halves;
    counts_.num_nonmanifold_edges += match.num_nonmanifold;
  }
  counts_.num_edges -= edges_.num_edges;  // They are counted again, once for all pieces.
  counts_.num_edge_halves += edges_.num_halves;
  num_boundary_components_ = count_components(edges_.num_boundary_components, shared.links, comm_);
}

void Checker::match_last_vertices()
{
  VertexTotals totals = vertices_.finish();
  counts_.num_vertices += totals.num_vertices;
  match_ids(std::move(totals.ids));
  has_unusable_ids_ = has_unusable_ids_
                      || 2 * comm_.sum(totals.num_contradicted) > comm_.sum(totals.num_shared_ids);
}

void Checker::match_ids(std::vector<PointId> shared)
{
  append_runs(std::move(shared), point_id_space(), point_ids_, findings_);
  check_ids(point_ids_, point_id_space(!is_partial_), comm_, findings_);
  const GlobalIndex num_defects =
      findings_.count(Kind::point_id_hole) + findings_.count(Kind::point_id_twice);
  has_unusable_ids_ = comm_.sum(num_defects) > 0;

  // Where some pieces have no cell ids, the others' need not be dense.
  if (comm_.sum(counts_.num_pieces_with_cell_ids) == tets_.num_pieces)
    check_ids(cell_ids_, cell_id_space(!is_partial_), comm_, findings_);
}

void Checker::measure_seams()
{
  std::size_t s = 0;
  for_each_own_piece({0, tets_.num_pieces}, false, [&](PieceName name) {
    const std::vector<LocalIndex>& seam_points = surfaces_[s].seam_points;
    PieceRecords& records = records_[s];
    ++s;
    if (seam_points.empty()) return;
    mesh::MeshArrays mesh = only_piece_ ? *std::exchange(only_piece_, {}) : tets_.read(name.piece);
    static_cast<void>(take_nodes(mesh));  // Shapes are those of the straight tets.
    if (mesh.num_cells() != num_tets(records)) throw InputError("changed while it was read");
    std::vector<bool> is_on_seam(static_cast<std::size_t>(mesh.num_points()), false);
    for (const LocalIndex point : seam_points)
      is_on_seam.at(static_cast<std::size_t>(point)) = true;
    measure_seam_tets(mesh, is_on_seam, records, seam_mean_ratios_);
  });
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

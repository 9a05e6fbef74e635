// SPDX-License-Identifier: BSD-3-Clause
#include "check/checker.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <malloc.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "check/piece/second_order.hpp"
#include "check/piece/topology.hpp"

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
      limits_(options.limits),
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
    match_batch(batch);
  }
  if (!read_listed_vertices()) return false;
  match_last_triangles();
  take_triangles();
  triangles_.close();
  match_last_edges();
  match_last_vertices();
  if (!is_partial_) periodic_.finish(comm_, findings_);
  ::malloc_trim(0);
  return true;
}

// By what points are matched from here on. False if only some of the pieces so far have ids.
bool Checker::settle_identity(GlobalIndex num_read)
{
  const GlobalIndex num_with_ids = comm_.sum(counts_.num_pieces_with_point_ids);
  if (identity_ == VertexIdentity::ids && num_with_ids > 0 && num_with_ids < num_read) return false;
  // Pieces without ids were matched by position as they were read.
  if (num_with_ids == 0) identity_ = VertexIdentity::positions;
  return true;
}

bool Checker::read_batch(LocalIndex batch)
{
  const Range tets = batch_of(tets_.num_pieces, batch);
  for_each_own_piece(tets, false, [&](PieceName name) { read_tets(name); });
  return settle_identity(tets.end);
}

// All of them behind the tets, so that every side of a triangle is known when its like in the
// boundary file is looked at.
bool Checker::read_listed_vertices()
{
  if (boundary_ == nullptr) return true;
  for (LocalIndex batch = 0; batch < num_batches(); ++batch) {
    const Range listed = batch_of(boundary_->num_pieces, batch);
    std::vector<VertexRecord> vertices;
    for_each_own_piece(listed, true, [&](PieceName name) { read_boundary(name, vertices); });
    if (!settle_identity(tets_.num_pieces + listed.end)) return false;
    vertices_.add(vertices, identity_);
  }
  return true;
}

void Checker::read_tets(PieceName name)
{
  PieceMesh mesh = load(name, findings_);
  const PieceTopology topology = analyse_topology(mesh, edge_lengths_, findings_);
  PieceSurface& surface = surfaces_.emplace_back(make_surface(mesh, topology, inner_, seam_keys_));
  report_equal_points_inside(mesh, surface, findings_);
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
  mesh.arrays.cell_ints["subdomain"] = mesh.subdomain.to_vector();
  only_piece_ = std::move(mesh.arrays);
}

void Checker::read_boundary(PieceName name, std::vector<VertexRecord>& vertices)
{
  const PieceMesh mesh = load(name, findings_);
  std::ranges::move(listed_vertices(mesh), std::back_inserter(vertices));
  if (mesh.has_point_ids) ++counts_.num_pieces_with_point_ids;
  periodic_.add(mesh, findings_);
  has_splits_ = has_splits_ || !mesh.split_patches().empty();
  if (mesh.num_cells() == 0) return;
  if (!mesh.arrays.cell_longs.contains("tet")) ++counts_.num_boundary_pieces_without_tet;
  if (!mesh.arrays.cell_ints.contains("patch")) ++counts_.num_boundary_pieces_without_patch;
}

// Counts the vertices that no other piece can have, and takes their ids and those of the cells.
void Checker::take_ids(const PieceMesh& mesh, const PieceSurface& surface)
{
  std::vector<bool> is_taken = points_of_surface(mesh, surface);
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
    append_runs(mesh.cell_ids.to_vector(), piece, cell_id_space(), cell_ids_, findings_);
}

// Of this rank. They stand in the order of pieces.
std::span<PieceSurface> Checker::surfaces_of(Range pieces)
{
  const auto piece_of = [](const PieceSurface& surface) { return surface.name.piece; };
  const auto begin = std::ranges::lower_bound(surfaces_, pieces.begin, {}, piece_of);
  return {begin, std::ranges::lower_bound(surfaces_, pieces.end, {}, piece_of)};
}

// Calls back with the triangles of this rank's pieces of the boundary file. What is wrong with a
// piece is reported when it is read for its vertices.
template <class Visit>
void Checker::for_each_own_listed(Range range, const Visit& visit) const
{
  Findings elsewhere;
  for_each_own_piece(range, true,
                     [&](PieceName name) { for_each_listed(load(name, elsewhere), visit); });
}

// Of the boundary file's pieces with these numbers, ascending.
std::vector<TriangleKey> Checker::read_listed_keys(Range pieces) const
{
  std::vector<TriangleKey> keys;
  if (boundary_ == nullptr) return keys;
  for_each_own_listed({pieces.begin, std::min(pieces.end, boundary_->num_pieces)},
                      [&](const TriangleRecord& record) { keys.push_back(record.key); });
  std::sort(keys.begin(), keys.end());
  return keys;
}

// Triangles that the boundary file lists beside their piece are held back until the end: to most of
// them no second side will come.
std::vector<TriangleSide> Checker::new_sides(Range pieces)
{
  const std::vector<TriangleKey> listed = read_listed_keys(pieces);
  std::vector<TriangleSide> sides;
  for (const PieceSurface& surface : surfaces_of(pieces)) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const TriangleSide side = surface.side(t);
      if (!std::binary_search(listed.begin(), listed.end(), side.key)) sides.push_back(side);
    }
  }
  return sides;
}

std::vector<VertexRecord> Checker::new_vertices(Range pieces)
{
  std::vector<VertexRecord> vertices;
  for (const PieceSurface& surface : surfaces_of(pieces))
    std::ranges::move(surface.vertex_records(), std::back_inserter(vertices));
  return vertices;
}

// What pieces share is sent for one piece of each rank at a time: several copies are made of it.
void Checker::match_batch(LocalIndex batch)
{
  const Range pieces = batch_of(tets_.num_pieces, batch);
  for (Range some = pieces; some.begin < pieces.end; some.begin = some.end) {
    some.end = std::min<LocalIndex>(some.begin + comm_.size(), pieces.end);
    triangles_.add(new_sides(some), std::exchange(inner_, {}));
    vertices_.add(new_vertices(some), identity_);
  }
  apply_all(triangles_.match());
  ::malloc_trim(0);  // What surfaces leave when they shrink lies between those that stay.
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

std::size_t Checker::num_open_triangles() const
{
  std::size_t num_open = 0;
  for (const PieceSurface& surface : surfaces_)
    num_open += static_cast<std::size_t>(std::ranges::count(surface.roles, TriangleRole::unknown));
  return num_open;
}

// In rounds, so that only a part of the triangles is sent at a time. The boundary file is read
// again for every few of them, so that only a part of it is held.
void Checker::match_last_triangles()
{
  const auto most = static_cast<std::uint64_t>(
      comm_.max(static_cast<double>(num_open_triangles() + triangles_.num_inner())));
  triangles_.drop_open();
  const std::uint64_t num_readings = 1 + most / limits_.num_triangles_in_reading;
  const std::uint64_t in_reading = 1 + most / num_readings / limits_.num_triangles_in_round;
  const std::uint64_t num_rounds = num_readings * in_reading;
  for (std::uint64_t first = 0; first < num_rounds; first += in_reading) {
    const TriangleRounds rounds{first, in_reading, num_rounds};
    std::vector<std::vector<TriangleRecord>> listed = read_listed_triangles(rounds);
    std::vector<std::vector<SurfaceRow>> open = open_triangles(rounds);
    for (std::uint64_t r = 0; r < in_reading; ++r)
      decide({first + r, num_rounds}, std::exchange(open[r], {}), std::exchange(listed[r], {}));
  }
}

// Triangles of the boundary file, by round.
std::vector<std::vector<TriangleRecord>> Checker::read_listed_triangles(TriangleRounds rounds) const
{
  std::vector<std::vector<TriangleRecord>> by_round(rounds.count);
  if (boundary_ == nullptr) return by_round;
  const TriangleRound all{rounds.first, rounds.num_rounds};
  for_each_own_listed({0, boundary_->num_pieces}, [&](const TriangleRecord& record) {
    const std::uint64_t round = all.number_of(record.key) - rounds.first;
    if (round < rounds.count) by_round[round].push_back(record);
  });
  return by_round;
}

// Triangles of this rank's surfaces without a verdict, by round.
std::vector<std::vector<Checker::SurfaceRow>> Checker::open_triangles(TriangleRounds rounds) const
{
  std::vector<std::vector<SurfaceRow>> by_round(rounds.count);
  const TriangleRound all{rounds.first, rounds.num_rounds};
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    const PieceSurface& surface = surfaces_[s];
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (surface.roles[t] != TriangleRole::unknown) continue;
      const std::uint64_t round = all.number_of(surface.triangle_key(t)) - rounds.first;
      if (round >= rounds.count) continue;
      by_round[round].push_back({static_cast<LocalIndex>(s), static_cast<LocalIndex>(t)});
    }
  }
  return by_round;
}

void Checker::decide(TriangleRound round, std::vector<SurfaceRow> open,
                     std::vector<TriangleRecord> records)
{
  records.reserve(records.size() + open.size());
  for (const SurfaceRow& row : open) {
    records.push_back(surfaces_[static_cast<std::size_t>(row.surface)].record(
        static_cast<std::size_t>(row.triangle)));
  }
  for (const TriangleVerdict& verdict : triangles_.decide(std::move(records), round))
    apply(verdict, surface_of(verdict.piece), seam_keys_);
  vertices_.mark_seam(std::exchange(seam_keys_, {}));
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

// Flags of the vertices of surfaces, one surface after the other.
std::vector<VertexFlags> Checker::flags_of(std::span<const PieceSurface> surfaces) const
{
  std::vector<VertexKey> keys;
  for (const PieceSurface& surface : surfaces)
    for (LocalIndex v = 0; v < static_cast<LocalIndex>(surface.vertices.size()); ++v)
      keys.push_back(surface.key(v));
  return vertices_.flags(keys);
}

void Checker::match_last_edges()
{
  EdgeMatch own;
  for (LocalIndex batch = 0; batch < num_batches(); ++batch)
    match_last_edges(surfaces_of(batch_of(tets_.num_pieces, batch)), own);
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

// Keeps of the surfaces only the points on seams.
void Checker::match_last_edges(std::span<PieceSurface> surfaces, EdgeMatch& own)
{
  const std::vector<VertexFlags> all_flags = flags_of(surfaces);
  std::span<const VertexFlags> left(all_flags);
  for (PieceSurface& surface : surfaces) {
    const auto flags = left.first(surface.vertices.size());
    left = left.subspan(flags.size());
    for (std::size_t v = 0; v < flags.size(); ++v) {
      const SurfaceVertex& vertex = surface.vertices[v];
      if (flags[v].is_on_seam && !vertex.is_on_seam) surface.seam_points.push_back(vertex.point);
    }
    match_own_edges(close_last_edges(surface, flags, edges_), own, findings_);
    PieceSurface rest;
    rest.name = surface.name;
    rest.seam_points = std::move(surface.seam_points);
    surface = std::move(rest);
  }
}

void Checker::match_last_vertices()
{
  VertexTotals totals = vertices_.finish(comm_.sum(has_splits_ ? 1 : 0) > 0);
  counts_.num_vertices += totals.num_vertices;
  match_ids(std::move(totals.ids));
  has_unusable_ids_ = has_unusable_ids_
                      || 2 * comm_.sum(totals.num_contradicted) > comm_.sum(totals.num_shared_ids);
}

void Checker::match_ids(std::vector<PointId> shared)
{
  append_runs(std::move(shared), point_id_space(), point_ids_, findings_);
  check_ids(point_ids_, point_id_space(!is_partial_), comm_, findings_);
  has_unusable_ids_ =
      comm_.sum(findings_.count(Kind::point_id_hole) + findings_.count(Kind::point_id_twice)) > 0;

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

}  // namespace tessera::check

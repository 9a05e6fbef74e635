// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/formats/export_mesh.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "tessera/comm/all_or_none.hpp"

#include "formats/foam/cyclic.hpp"
#include "formats/foam/faces.hpp"
#include "formats/link/ghosts.hpp"
#include "formats/link/link_pieces.hpp"
#include "formats/link/match_periodic.hpp"
#include "formats/piece_source.hpp"
#include "formats/writer.hpp"

namespace tessera::formats {
namespace {

using Writers = std::vector<std::unique_ptr<Writer>>;

// Makes all writers before any writes: a format that cannot hold the mesh leaves nothing behind.
Writers make_writers(const ExportRequest& request, const Outline& outline)
{
  Writers writers;
  for (const io::Format format : request.formats) {
    if (format == io::Format::pvtu) continue;
    writers.push_back(make_writer(format, {outline, request.folder}));
  }
  return writers;
}

void on_first_rank(const comm::Communicator& comm, const Writers& writers, void (Writer::*step)())
{
  all_or_none(comm, [&] {
    if (comm.rank() != 0) return;
    for (const auto& writer : writers) ((*writer).*step)();
  });
}

// What is written, as far as it is in memory.
struct LinkedPieces {
  LinkedMesh mesh{};
  std::vector<Ghosts> ghosts{};  // By this rank's pieces; empty if no writer needs them.
  std::vector<std::vector<PeriodicPoint>> periodic_points{};  // The same.
  std::vector<std::vector<CyclicFace>> cyclic_faces{};        // The same.
};

// Pieces are read once more for it: their faces take the place of closed forms.
void count_faces_of_cells(const PieceSource& source, LinkedMesh& mesh,
                          const comm::Communicator& comm, const std::function<void()>& before_each)
{
  std::vector<CellFaceCounts> own;
  all_or_none(comm, [&] {
    const Outline& outline = mesh.outline;
    for_each_piece(source, mesh, comm.rank(), before_each, [&](const Piece& piece, std::size_t) {
      own.push_back(count_cell_faces(piece, outline.first_cell[at(piece.number)],
                                     outline.patch_names.size(), outline.material_names.size()));
    });
  });
  mesh.outline.cell_faces = comm.all_gather_rows(own);
}

struct PeriodicNeeds {
  bool points = false;
  bool faces = false;
};

void match_periodic(const PieceSource& source, LinkedPieces& linked, const PeriodicNeeds& needs,
                    const comm::Communicator& comm, const std::function<void()>& before_each)
{
  Outline& outline = linked.mesh.outline;
  all_or_none(comm, [&] { outline.periodic = periodic_patches(source.names(), outline); });
  if (outline.periodic.empty()) return;
  if (needs.points)
    linked.periodic_points = match_periodic_points(source, linked.mesh, comm, before_each);
  if (needs.faces) linked.cyclic_faces = match_cyclic_faces(source, linked.mesh, comm, before_each);
}

// Ghosts and the like go with the piece, so memory is given back on the way.
void write_pieces(const PieceSource& source, LinkedPieces& linked, const Writers& writers,
                  Rank rank, const std::function<void()>& before_each)
{
  for_each_piece(source, linked.mesh, rank, before_each, [&](Piece piece, std::size_t i) {
    if (!linked.ghosts.empty()) piece.ghosts = std::move(linked.ghosts[i]);
    if (!linked.periodic_points.empty())
      piece.periodic_points = std::move(linked.periodic_points[i]);
    if (!linked.cyclic_faces.empty()) piece.cyclic_faces = std::move(linked.cyclic_faces[i]);
    for (const auto& writer : writers) writer->write(piece);
  });
  for (const auto& writer : writers) writer->close();
}

}  // namespace

std::vector<io::SharedPoints> shared_points(const std::vector<PieceCounts>& pieces)
{
  std::vector<io::SharedPoints> pairs;
  for (LocalIndex p = 0; at(p) < pieces.size(); ++p) {
    for (const PieceNeighbour& other : pieces[at(p)].neighbours) {
      if (other.piece > p) pairs.push_back({p, other.piece, other.num_shared_points});
    }
  }
  return pairs;
}

Outline export_mesh(const ExportRequest& request, const comm::Communicator& comm,
                    const std::function<void()>& before_each)
{
  const PieceSource source(request.mesh, comm, request.layers);
  const auto has = [&](io::Format format) {
    return std::ranges::find(request.formats, format) != request.formats.end();
  };
  const bool has_nodes = has(io::Format::msh) || has(io::Format::msh2) || has(io::Format::abaqus)
                         || has(io::Format::xdmf);
  const bool has_polyhedra = has(io::Format::openfoam) || has(io::Format::openfoam_serial);
  const bool has_periodic = !source.names().periodic.empty() && (has_nodes || has_polyhedra);
  const LinkOptions options{
      .shared_edges = has(io::Format::mfem) || has(io::Format::mfem_sets),
      .face_numbers = has(io::Format::openfoam),
      .patch_points = has_periodic || has(io::Format::abaqus) || has(io::Format::exodus)};
  LinkedPieces linked{.mesh = link_pieces(source, comm, before_each, options)};
  if (has_polyhedra && linked.mesh.outline.has_prisms())
    count_faces_of_cells(source, linked.mesh, comm, before_each);
  if (has_periodic) match_periodic(source, linked, {has_nodes, has_polyhedra}, comm, before_each);
  Writers writers;
  all_or_none(comm, [&] { writers = make_writers(request, linked.mesh.outline); });
  if (std::ranges::any_of(writers, [](const auto& writer) { return writer->needs_ghosts(); }))
    linked.ghosts = collect_ghosts(source, linked.mesh, comm, before_each);
  on_first_rank(comm, writers, &Writer::begin);
  all_or_none(comm, [&] { write_pieces(source, linked, writers, comm.rank(), before_each); });
  on_first_rank(comm, writers, &Writer::commit);
  return std::move(linked.mesh.outline);
}

Outline outline_of(const std::filesystem::path& mesh, const comm::Communicator& comm,
                   const std::function<void()>& before_each)
{
  return link_pieces(PieceSource(mesh, comm), comm, before_each).outline;
}

}  // namespace tessera::formats

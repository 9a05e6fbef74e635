// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/mesh_input.hpp"

#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

std::vector<mesh::MeshArrays> read_own(const std::vector<std::filesystem::path>& files,
                                       int vertices_per_cell, const comm::Communicator& comm)
{
  const auto first_of = [&](int rank) {
    return files.size() * static_cast<std::size_t>(rank) / static_cast<std::size_t>(comm.size());
  };
  std::vector<mesh::MeshArrays> pieces;
  for (std::size_t f = first_of(comm.rank()); f < first_of(comm.rank() + 1); ++f) {
    throw_if_stop_requested();
    mesh::MeshArrays piece = io::read_vtu(files[f]);
    if (piece.num_cells() > 0 && piece.vertices_per_cell != vertices_per_cell) {
      throw InputError(fmt::format("{}: it has no {}", files[f].string(),
                                   vertices_per_cell == 4 ? "tets" : "triangles"));
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace

std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& index,
                                             const comm::Communicator& comm)
{
  const Bytes bytes = on_root(comm, [&] {
    std::vector<std::string> names;
    for (const auto& piece : io::piece_files(index)) names.push_back(piece.string());
    ByteWriter out;
    out.put(names);
    return std::move(out).take();
  });
  std::vector<std::filesystem::path> pieces;
  for (const std::string& name : ByteReader(bytes).get_strings()) pieces.emplace_back(name);
  return pieces;
}

std::optional<std::vector<std::filesystem::path>> boundary_pieces_of(
    const std::filesystem::path& mesh, const comm::Communicator& comm)
{
  const std::filesystem::path boundary = mesh.parent_path() / "boundary.pvtu";
  bool is_there = false;
  if (comm.rank() == 0 && mesh.filename() == "mesh.pvtu") {
    std::error_code error;  // What cannot be looked at is as good as absent.
    is_there = std::filesystem::exists(boundary, error);
  }
  if (comm.sum(is_there ? 1 : 0) == 0) return std::nullopt;
  return pieces_of(boundary, comm);
}

migrate::MeshPieces read_pieces(const std::filesystem::path& index, const comm::Communicator& comm)
{
  migrate::MeshPieces pieces;
  const auto tet_files = pieces_of(index, comm);
  const auto boundary_files = boundary_pieces_of(index, comm);
  all_or_none(comm, [&] {
    pieces.tets = read_own(tet_files, 4, comm);
    if (boundary_files) pieces.boundary = read_own(*boundary_files, 3, comm);
  });
  pieces.has_boundary = boundary_files.has_value();
  return pieces;
}

}  // namespace tessera::pipeline

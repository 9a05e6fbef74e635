// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/mesh_input.hpp"

#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/vtu.hpp"

namespace tessera::subdomain {
namespace {

std::vector<mesh::MeshArrays> read_own(const std::vector<std::filesystem::path>& files,
                                       int vertices_per_cell, const comm::Communicator& comm,
                                       const std::function<void()>& before_each)
{
  const auto first_of = [&](int rank) {
    return files.size() * static_cast<std::size_t>(rank) / static_cast<std::size_t>(comm.size());
  };
  std::vector<mesh::MeshArrays> pieces;
  for (std::size_t f = first_of(comm.rank()); f < first_of(comm.rank() + 1); ++f) {
    before_each();
    mesh::MeshArrays piece = io::read_vtu(files[f], io::CellOrder::up_to_second);
    if (piece.vertices_per_cell > 4) {
      throw InputError(fmt::format(
          "{}: its cells are of second order, which only tessera check reads; make the mesh with "
          "output.order = 1",
          files[f].string()));
    }
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
  const std::vector<std::string> names = on_root(comm, [&] {
    std::vector<std::string> own;
    for (const auto& piece : io::piece_files(index)) own.push_back(piece.string());
    return own;
  });
  return {names.begin(), names.end()};
}

std::optional<std::vector<std::filesystem::path>> pieces_beside(const std::filesystem::path& mesh,
                                                                const std::string& name,
                                                                const comm::Communicator& comm)
{
  const std::filesystem::path index = mesh.parent_path() / name;
  bool is_there = false;
  if (comm.rank() == 0 && mesh.filename() == "mesh.pvtu") {
    std::error_code error;  // What cannot be looked at is as good as absent.
    is_there = std::filesystem::exists(index, error);
  }
  if (comm.sum(is_there ? 1 : 0) == 0) return std::nullopt;
  return pieces_of(index, comm);
}

migrate::MeshPieces read_pieces(const std::filesystem::path& index, const comm::Communicator& comm,
                                const std::function<void()>& before_each)
{
  migrate::MeshPieces pieces;
  const auto tet_files = pieces_of(index, comm);
  const auto boundary_files = pieces_beside(index, "boundary.pvtu", comm);
  comm::all_or_none(comm, [&] {
    pieces.tets = read_own(tet_files, 4, comm, before_each);
    if (boundary_files) pieces.boundary = read_own(*boundary_files, 3, comm, before_each);
  });
  pieces.has_boundary = boundary_files.has_value();
  return pieces;
}

Texts field_texts_of(const migrate::MeshPieces& pieces, const comm::Communicator& comm)
{
  const auto has_texts = [](const mesh::MeshArrays& piece) { return !piece.field_texts.empty(); };
  const auto piece = std::ranges::find_if(pieces.tets, has_texts);
  const Texts own = piece == pieces.tets.end() ? Texts{} : piece->field_texts;
  Texts all{{"material_names", {}}, {"patch_names", {}}, {"length_unit", {}}};
  for (const Texts& texts : comm.all_gather_values(own)) {
    if (texts.empty()) continue;
    for (const auto& [name, lines] : texts) all[name] = lines;
    break;
  }
  return all;
}

migrate::AssembledMesh assemble_pieces(const std::filesystem::path& index,
                                       const migrate::MeshPieces& pieces,
                                       const comm::Communicator& comm)
{
  try {
    return migrate::assemble(comm, pieces);
  } catch (const comm::Collective<InputError>& error) {
    throw comm::Collective<InputError>(index.string() + ": " + error.what() + "; `tessera check "
                                       + index.string() + "` says where");
  }
}

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_file.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tessera/io/files.hpp"
#include "tessera/io/vtu.hpp"

namespace tessera::subdomain {
namespace {

// Which points of a piece others may have: those of its skin, and those of layers.
struct SharedPoints {
  std::size_t num_skin = 0;
  std::size_t num_of_tets = 0;  // Those of layers follow.

  [[nodiscard]] bool has(std::size_t point) const
  {
    return point < num_skin || point >= num_of_tets;
  }
};

template <class T>
void append(std::map<std::string, std::vector<T>>& to,
            const std::map<std::string, std::vector<T>>& from)
{
  for (const auto& [name, values] : from) {
    to[name].insert(to[name].end(), values.begin(), values.end());
  }
}

// Appends the points that are not there yet; those that are shared may be.
template <class PointOfId>
std::vector<LocalIndex> append_points(const mesh::MeshArrays& from, const SharedPoints& shared,
                                      PointOfId& known, mesh::MeshArrays& to)
{
  std::vector<LocalIndex> place(from.point_ids.size());
  for (std::size_t p = 0; p < place.size(); ++p) {
    const auto next = static_cast<LocalIndex>(to.num_points());
    if (shared.has(p)) {
      const auto [found, is_new] = known.emplace(from.point_ids[p], next);
      place[p] = found->second;
      if (!is_new) continue;
    } else {
      place[p] = next;
    }
    to.point_xyz.insert(to.point_xyz.end(), &from.point_xyz[3 * p], &from.point_xyz[3 * p] + 3);
    to.point_ids.push_back(from.point_ids[p]);
    for (const auto& [name, values] : from.point_ints) to.point_ints[name].push_back(values[p]);
  }
  return place;
}

template <class PointOfId>
void append(const mesh::MeshArrays& from, const SharedPoints& shared, PointOfId& known,
            mesh::MeshArrays& to)
{
  const std::vector<LocalIndex> place = append_points(from, shared, known, to);
  to.cell_points.reserve(to.cell_points.size() + from.cell_points.size());
  for (const LocalIndex point : from.cell_points) {
    to.cell_points.push_back(place[at(point)]);
  }
  to.cell_ids.insert(to.cell_ids.end(), from.cell_ids.begin(), from.cell_ids.end());
  append(to.cell_ints, from.cell_ints);
  append(to.cell_longs, from.cell_longs);
  append(to.cell_doubles, from.cell_doubles);
}

template <class PointOfId>
void remember(const mesh::MeshArrays& first, const SharedPoints& shared, PointOfId& known)
{
  for (std::size_t p = 0; p < first.point_ids.size(); ++p) {
    if (!shared.has(p)) continue;
    known.emplace(first.point_ids[p], static_cast<LocalIndex>(p));
  }
}

// Appends the files, relative to `folder`, to `written`.
void write_vtu_files(const PieceArrays& arrays, LocalIndex file, io::Compression compression,
                     const std::filesystem::path& folder,
                     std::vector<std::filesystem::path>& written)
{
  const auto write = [&](const mesh::MeshArrays& cells, const char* kind) {
    written.push_back(piece_path(kind, file));
    io::write_vtu(cells, folder / written.back(), compression);
  };
  write(arrays.tets, "mesh");
  if (arrays.boundary.num_cells() > 0) write(arrays.boundary, "boundary");
  if (arrays.lines.num_cells() == 0) return;
  io::make_own_folder(folder / "lines");
  write(arrays.lines, "lines");
}

}  // namespace

std::vector<SubdomainRange> file_ranges(LocalIndex num_subdomains, LocalIndex files)
{
  const LocalIndex num_files = files == 0 ? num_subdomains : std::min(files, num_subdomains);
  const auto first_of = [&](LocalIndex file) {
    return static_cast<LocalIndex>(GlobalIndex{num_subdomains} * file / num_files);
  };
  std::vector<SubdomainRange> ranges;
  for (LocalIndex f = 0; f < num_files; ++f) ranges.push_back({f, first_of(f), first_of(f + 1)});
  return ranges;
}

std::vector<SubdomainRange> part_ranges(const std::vector<LocalIndex>& offsets)
{
  std::vector<SubdomainRange> ranges;
  for (std::size_t part = 0; part + 1 < offsets.size(); ++part) {
    ranges.push_back({static_cast<LocalIndex>(part), offsets[part], offsets[part + 1]});
  }
  return ranges;
}

std::vector<SubdomainRange> single_ranges(const std::vector<LocalIndex>& subdomains)
{
  std::vector<SubdomainRange> ranges;
  for (const LocalIndex s : subdomains) ranges.push_back({s, s, s + 1});
  return ranges;
}

std::filesystem::path piece_path(const std::string& folder, LocalIndex file)
{
  return std::filesystem::path(folder) / fmt::format("piece_{:06}.vtu", file);
}

PieceFile::PieceFile(const WriteContext& mesh, const io::OutputOptions& options)
    : mesh_(mesh), options_(options)
{
}

Hash128 PieceFile::add(mesh::Piece piece)
{
  const SharedPoints shared{at(piece.num_skin_vertices()), at(piece.num_vertices())};
  PieceArrays added = piece_arrays(std::move(piece), mesh_, options_.cell_quality);
  const Hash128 digest = digest_of(added.tets);
  const auto num_boundary = added.boundary.point_ids.size();
  const auto num_on_lines = added.lines.point_ids.size();
  if (arrays_.tets.num_cells() == 0) {
    arrays_ = std::move(added);
    num_skin_of_first_ = shared.num_skin;
    num_of_tets_of_first_ = shared.num_of_tets;
    return digest;
  }
  if (tet_points_.empty()) {  // Most files hold one piece: only now it is known that this does not.
    remember(arrays_.tets, {num_skin_of_first_, num_of_tets_of_first_}, tet_points_);
    remember(arrays_.boundary, {.num_skin = arrays_.boundary.point_ids.size()}, boundary_points_);
    remember(arrays_.lines, {.num_skin = arrays_.lines.point_ids.size()}, line_points_);
  }
  append(added.tets, shared, tet_points_, arrays_.tets);
  append(added.boundary, {.num_skin = num_boundary}, boundary_points_, arrays_.boundary);
  append(added.lines, {.num_skin = num_on_lines}, line_points_, arrays_.lines);
  return digest;
}

std::vector<std::filesystem::path> PieceFile::write(const std::filesystem::path& folder,
                                                    LocalIndex file) const
{
  std::vector<std::filesystem::path> written;
  write_vtu_files(arrays_, file, options_.compression, folder, written);
  return written;
}

}  // namespace tessera::subdomain

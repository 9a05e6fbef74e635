// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/attach_boundary.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/record_exchange.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "migrate/dense_ids.hpp"

namespace tessera::migrate {
namespace {

constexpr GlobalIndex kNoId = -1;

// A face of a tet, or a triangle of the boundary file.
struct Record {
  TriangleKey key{};
  GlobalIndex tet_id = kNoId;       // In the boundary file: the one named there.
  GlobalIndex boundary_id = kNoId;  // In the boundary file, if it has ids.
  Rank rank = 0;
  LocalIndex tet = 0;
  LocalIndex corner = 0;
  std::int32_t patch = 0;
  bool is_listed = false;  // In the boundary file.

  static auto fields(auto& self)
  {
    return std::tie(self.key, self.tet_id, self.boundary_id, self.rank, self.tet, self.corner,
                    self.patch, self.is_listed);
  }
};

struct Defects {
  GlobalIndex num_without_tet = 0;
  GlobalIndex num_unlisted = 0;
  GlobalIndex num_twice = 0;
};

TriangleKey key_of(std::array<VertexKey, 3> vertices)
{
  std::ranges::sort(vertices);
  return key_of_vertices(vertices);
}

// Faces on one tet of this rank, or between two materials; all of a mesh with patches inside.
void add_faces(const BoundaryMatch& match, Rank rank, std::vector<Record>& records)
{
  const MeshBlock& block = match.joined.block;
  for (std::size_t side = 0; side < match.behind.size(); ++side) {
    const auto tet = static_cast<LocalIndex>(side / 4);
    const LocalIndex other = match.behind[side];
    const bool is_inner =
        other != kNoIndex && block.tet_material[at(other)] == block.tet_material[at(tet)];
    if (is_inner && !match.has_inside_patches) continue;
    std::array<VertexKey, 3> keys;
    for (std::size_t i = 0; i < 3; ++i) {
      keys[i] = match.joined.vertex_keys[at(block.tet(tet)[mesh::kTetFaceCorners[side % 4][i]])];
    }
    records.push_back({.key = key_of(keys),
                       .tet_id = match.tet_ids.empty() ? kNoId : match.tet_ids[at(tet)],
                       .rank = rank,
                       .tet = tet,
                       .corner = static_cast<LocalIndex>(side % 4)});
  }
}

template <class T, class Name>
const std::vector<T>* find_array(const std::map<std::string, std::vector<T>>& arrays,
                                 const Name& name)
{
  const auto found = arrays.find(name);
  return found == arrays.end() ? nullptr : &found->second;
}

void add_listed(const mesh::MeshArrays& piece, const BoundaryMatch& match, Rank rank,
                std::vector<Record>& records)
{
  const auto* const patch = find_array(piece.cell_ints, "patch");
  const auto* const tet_ids = find_array(piece.cell_longs, "tet");
  for (std::size_t c = 0; c < piece.cell_points.size() / 3; ++c) {
    std::array<VertexKey, 3> keys;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto point = static_cast<std::size_t>(piece.cell_points[3 * c + i]);
      keys[i] = key_of_point(piece, point, match.identity);
    }
    records.push_back({.key = key_of(keys),
                       .tet_id = tet_ids == nullptr ? kNoId : (*tet_ids)[c],
                       .boundary_id = piece.cell_ids.empty() ? kNoId : piece.cell_ids[c],
                       .rank = rank,
                       .patch = patch == nullptr ? 0 : (*patch)[c],
                       .is_listed = true});
  }
}

// The tet behind a listed triangle: the one it names, or else the first.
const Record& tet_behind(const Record& listed, std::span<const Record> received,
                         std::span<const std::size_t> tets)
{
  for (const std::size_t row : tets) {
    if (listed.tet_id != kNoId && received[row].tet_id == listed.tet_id) return received[row];
  }
  return received[tets.front()];
}

// Decides about records with one key, those of tets first; what is on the boundary goes to `found`.
void match_group(std::span<const Record> received, std::span<const std::size_t> rows,
                 bool has_boundary, std::vector<Record>& found, Defects& defects)
{
  const auto num_tets = static_cast<std::size_t>(
      std::ranges::count_if(rows, [&](std::size_t row) { return !received[row].is_listed; }));
  const auto tets = rows.first(num_tets);
  const auto listed = rows.subspan(num_tets);
  if (listed.empty()) {
    if (tets.size() > 1) return;
    if (has_boundary) ++defects.num_unlisted;
    found.push_back(received[tets.front()]);
  } else if (listed.size() > 1) {
    ++defects.num_twice;
  } else if (tets.empty()) {
    ++defects.num_without_tet;
  } else {
    Record record = tet_behind(received[listed.front()], received, tets);
    record.boundary_id = received[listed.front()].boundary_id;
    record.patch = received[listed.front()].patch;
    found.push_back(record);
  }
}

void throw_defects(const comm::Communicator& comm, const Defects& defects)
{
  std::vector<GlobalIndex> counts{defects.num_without_tet, defects.num_unlisted, defects.num_twice};
  comm.sum_in_place(counts);
  std::string text;
  const auto add = [&](GlobalIndex count, const std::string& what) {
    if (count > 0) text += fmt::format("{}{}{}", text.empty() ? "" : ", ", count, what);
  };
  add(counts[0], " triangles of the boundary file are no face of a tet");
  add(counts[1], " triangles on one tet are not in the boundary file");
  add(counts[2], " triangles are in the boundary file more than once");
  if (!text.empty()) throw comm::Collective<InputError>("the mesh does not conform: " + text);
}

void add_to_block(const comm::Communicator& comm, std::vector<Record> records, MeshBlock& block)
{
  std::ranges::sort(records, {}, [](const Record& r) { return std::tuple(r.tet, r.corner); });
  std::vector<GlobalIndex> ids;
  for (const Record& record : records) {
    ids.push_back(record.boundary_id);
    block.boundary_tet.push_back(record.tet);
    block.boundary_corner.push_back(record.corner);
    block.boundary_patch.push_back(record.patch);
  }
  block.boundary_ids = dense_ids(comm, std::move(ids), records.size());
}

}  // namespace

void attach_boundary(const comm::Communicator& comm, const BoundaryMatch& match, MeshBlock& block)
{
  std::vector<Record> records;
  add_faces(match, comm.rank(), records);
  for (const mesh::MeshArrays& piece : match.pieces) add_listed(piece, match, comm.rank(), records);

  const comm::RecordExchange<Record> meeting(
      records, [](const Record& record) { return record.key[0]; }, comm);
  std::vector<Record> found;
  Defects defects;
  comm::for_each_group(
      meeting.received(), [](const Record& record) { return record.key; },
      [](const Record& r) { return std::tuple(r.is_listed, r.tet_id, r.rank, r.tet); },
      [&](std::span<const std::size_t> rows) {
        match_group(meeting.received(), rows, match.has_boundary, found, defects);
      });
  throw_defects(comm, defects);
  comm::RecordExchange<Record> way_back(
      found, [](const Record& record) { return static_cast<std::uint64_t>(record.rank); }, comm);
  add_to_block(comm, std::move(way_back).take_received(), block);
}

}  // namespace tessera::migrate

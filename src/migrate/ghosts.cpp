// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/ghosts.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "tessera/base/sort_unique.hpp"
#include "tessera/migrate/partition.hpp"

#include "migrate/block_merge.hpp"
#include "migrate/list_streams.hpp"

namespace tessera::migrate {
namespace {

using Ids = std::vector<GlobalIndex>;
using PartsOfVertex = std::map<GlobalIndex, std::vector<LocalIndex>>;

// A part and what it knows of its surroundings so far.
struct Surroundings {
  GhostTets ghosts{};
  Ids own_vertices{};        // Ascending.
  PartsOfVertex frontier{};  // Vertices whose tets it has not asked for yet.
  PartsOfVertex known{};     // Vertices of ghosts.
};

// Some tets with their vertices, and the parts of these.
struct Answer {
  LocalIndex for_part = 0;
  MeshBlock block{};
  IndexLists vertex_parts{};

  static auto fields(auto& self) { return std::tie(self.for_part, self.block, self.vertex_parts); }
};

std::vector<Surroundings> own_parts(const comm::Communicator& comm, const DistributedMesh& mesh,
                                    const IndexLists& vertex_parts, LocalIndex num_parts)
{
  std::vector<Surroundings> parts;
  std::map<LocalIndex, std::size_t> row;
  for (LocalIndex part = 0; part < num_parts; ++part) {
    if (rank_of_part(part, num_parts, comm.size()) != comm.rank()) continue;
    row[part] = parts.size();
    parts.emplace_back().ghosts.part = part;
  }
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const auto of_vertex = vertex_parts[v];
    for (const LocalIndex part : of_vertex) {
      const auto found = row.find(part);
      if (found == row.end()) continue;
      Surroundings& own = parts[found->second];
      own.own_vertices.push_back(mesh.vertex_ids[at(v)]);
      if (of_vertex.size() < 2) continue;
      own.frontier[mesh.vertex_ids[at(v)]].assign(of_vertex.begin(), of_vertex.end());
    }
  }
  return parts;
}

// Lists (asking part, asked part, vertices…) to the ranks of the asked parts.
void ask(std::vector<Surroundings>& parts, LocalIndex num_parts, int num_ranks,
         ListStreams<GlobalIndex>& questions)
{
  for (Surroundings& own : parts) {
    const LocalIndex part = own.ghosts.part;
    std::map<LocalIndex, Ids> vertices_of;
    for (const auto& [vertex, of_vertex] : own.frontier) {
      for (const LocalIndex other : of_vertex) {
        if (other != part) vertices_of[other].push_back(vertex);
      }
    }
    own.frontier.clear();
    for (auto& [other, vertices] : vertices_of) {
      vertices.insert(vertices.begin(), {part, other});
      questions.put(rank_of_part(other, num_parts, num_ranks), vertices);
    }
  }
}

void add_vertices(const DistributedMesh& mesh, const IndexLists& vertex_parts,
                  const std::vector<LocalIndex>& vertices, Answer& answer)
{
  for (const LocalIndex v : vertices) {
    answer.block.vertex_ids.push_back(mesh.vertex_ids[at(v)]);
    std::ranges::copy(mesh.position(v), std::back_inserter(answer.block.vertex_xyz));
    std::ranges::copy(vertex_parts[v], std::back_inserter(answer.vertex_parts.values));
    answer.vertex_parts.end_list();
  }
}

Answer answer_to(std::span<const GlobalIndex> question, const DistributedMesh& mesh,
                 const IndexLists& vertex_parts, const IndexLists& tets_around)
{
  Answer answer{.for_part = static_cast<LocalIndex>(question[0])};
  std::vector<LocalIndex> tets;
  for (const LocalIndex v : places_of(question.subspan(2), mesh.vertex_ids)) {
    for (const LocalIndex t : tets_around[v]) {
      if (mesh.tet_part[at(t)] == question[1]) tets.push_back(t);
    }
  }
  sort_unique(tets);
  std::vector<LocalIndex> vertices;
  for (const LocalIndex t : tets) std::ranges::copy(mesh.tet(t), std::back_inserter(vertices));
  sort_unique(vertices);
  add_vertices(mesh, vertex_parts, vertices, answer);
  MeshBlock& block = answer.block;
  block.tet_columns.resize(mesh.tet_columns.size());
  for (const LocalIndex t : tets) {
    block.tet_ids.push_back(mesh.tet_ids[at(t)]);
    for (const LocalIndex v : mesh.tet(t)) {
      block.tet_vertices.push_back(
          static_cast<LocalIndex>(std::ranges::lower_bound(vertices, v) - vertices.begin()));
    }
    block.tet_material.push_back(mesh.tet_material[at(t)]);
    block.tet_part.push_back(mesh.tet_part[at(t)]);
    for (std::size_t c = 0; c < mesh.tet_columns.size(); ++c) {
      block.tet_columns[c].push_back(mesh.tet_columns[c][at(t)]);
    }
  }
  return answer;
}

// Adds one more layer; its vertices that are new are the next frontier.
void take_answers(std::vector<Answer> answers, Surroundings& own)
{
  std::vector<MeshBlock> blocks{std::move(own.ghosts.block)};
  for (Answer& answer : answers) {
    for (LocalIndex v = 0; v < answer.block.num_vertices(); ++v) {
      const GlobalIndex vertex = answer.block.vertex_ids[at(v)];
      const auto parts = answer.vertex_parts[v];
      const bool is_new = own.known.try_emplace(vertex, parts.begin(), parts.end()).second;
      if (is_new && !std::ranges::binary_search(own.own_vertices, vertex)) {
        own.frontier.emplace(vertex, std::vector<LocalIndex>(parts.begin(), parts.end()));
      }
    }
    blocks.push_back(std::move(answer.block));
  }
  own.ghosts.block = merge_blocks(blocks);
}

void add_layer(const comm::Communicator& comm, const DistributedMesh& mesh,
               const IndexLists& vertex_parts, const IndexLists& tets_around, LocalIndex num_parts,
               std::vector<Surroundings>& parts)
{
  Traffic traffic;
  ListStreams<GlobalIndex> questions(comm);
  ask(parts, num_parts, comm.size(), questions);
  questions.exchange(traffic);
  std::vector<comm::Message> messages;
  for (const Rank rank : questions.senders()) {
    while (questions.has_more(rank)) {
      messages.push_back(
          {rank, to_bytes(answer_to(questions.get(rank), mesh, vertex_parts, tets_around))});
    }
  }
  std::map<LocalIndex, std::vector<Answer>> answers;
  for (const comm::Message& message : exchange(comm, std::move(messages), traffic)) {
    Answer answer = from_bytes<Answer>(message.bytes);
    answers[answer.for_part].push_back(std::move(answer));
  }
  for (Surroundings& own : parts) take_answers(std::move(answers[own.ghosts.part]), own);
}

}  // namespace

std::vector<GhostTets> find_ghosts(const comm::Communicator& comm, const DistributedMesh& mesh,
                                   const IndexLists& vertex_parts, LocalIndex num_parts,
                                   int num_layers)
{
  std::vector<Surroundings> parts = own_parts(comm, mesh, vertex_parts, num_parts);
  const IndexLists tets_around =
      num_layers > 0 ? rows_by_key(mesh.tet_vertices, mesh.num_vertices(), 4) : IndexLists{};
  for (int layer = 0; layer < num_layers; ++layer) {
    add_layer(comm, mesh, vertex_parts, tets_around, num_parts, parts);
  }
  std::vector<GhostTets> ghosts;
  for (Surroundings& own : parts) {
    GhostTets& of_part = ghosts.emplace_back(std::move(own.ghosts));
    of_part.block.tet_columns.resize(mesh.tet_columns.size());
    for (const GlobalIndex vertex : of_part.block.vertex_ids) {
      of_part.vertex_owner.push_back(own.known.at(vertex).front());
    }
  }
  return ghosts;
}

}  // namespace tessera::migrate

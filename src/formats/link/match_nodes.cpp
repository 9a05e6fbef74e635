// SPDX-License-Identifier: BSD-3-Clause
#include "formats/link/match_nodes.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <unordered_set>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/record_exchange.hpp"

namespace tessera::formats {
namespace {

// Two pieces with a node each on one edge.
struct Dispute {
  SkinNode one{};
  SkinNode other{};

  static auto fields(auto& self) { return std::tie(self.one, self.other); }
};

std::string to_text(const Vec3& p)
{
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", p[0], p[1], p[2]);
}

std::string to_text(const Dispute& dispute, const PieceSource& source)
{
  const auto& [one, other] = dispute;
  // At one place keys can differ only if they are ids.
  const std::string how =
      one.position == other.position
          ? fmt::format("it has id {} in the one, {} in the other", one.key[0], other.key[0])
          : fmt::format("it is at {} in the one, at {} in the other", to_text(one.position),
                        to_text(other.position));
  return fmt::format(
      "{} and {} disagree on the node of the edge from {} to {}: {}; `tessera check` lists what "
      "does "
      "not fit",
      source.file(one.piece).string(), source.file(other.piece).string(), to_text(one.ends[0]),
      to_text(one.ends[1]), how);
}

// The first one of this rank's share, as a list of none or one.
std::vector<Dispute> find_dispute(std::span<const SkinNode> nodes)
{
  std::vector<Dispute> found;
  comm::for_each_group(
      nodes, [](const SkinNode& node) { return node.edge; },
      [](const SkinNode& node) { return node.piece; },
      [&](std::span<const std::size_t> rows) {
        const SkinNode& first = nodes[rows.front()];
        const auto differs = [&](std::size_t row) {
          return nodes[row].key != first.key || nodes[row].position != first.position;
        };
        const auto other = std::ranges::find_if(rows, differs);
        if (other != rows.end() && found.empty()) found.push_back({first, nodes[*other]});
      });
  return found;
}

}  // namespace

void add_skin_nodes(const LoadedPiece& piece, LocalIndex number,
                    const std::vector<LocalIndex>& behind, std::vector<SkinNode>& nodes)
{
  if (piece.tet_nodes.empty()) return;
  const auto position = [&](LocalIndex row) { return point_at(std::span(piece.point_xyz), row); };
  std::unordered_set<LocalIndex> known;
  for (std::size_t side = 0; side < behind.size(); ++side) {
    if (behind[side] != kNoIndex) continue;
    const std::vector<LocalIndex> points = piece.points_of_side(static_cast<LocalIndex>(side));
    for (std::size_t i = 0; i < 3; ++i) {
      const LocalIndex node = points[3 + i];
      if (!known.insert(node).second) continue;
      std::array<LocalIndex, 2> ends{points[i], points[(i + 1) % 3]};
      std::ranges::sort(ends, {}, [&](LocalIndex end) { return piece.point_keys[at(end)]; });
      const std::array<VertexKey, 2> keys{piece.point_keys[at(ends[0])],
                                          piece.point_keys[at(ends[1])]};
      nodes.push_back({key_of_vertices(keys),
                       piece.point_keys[at(node)],
                       position(node),
                       {position(ends[0]), position(ends[1])},
                       number});
    }
  }
}

void require_same_nodes(const std::vector<SkinNode>& nodes, const PieceSource& source,
                        const comm::Communicator& comm)
{
  const comm::RecordExchange<SkinNode> exchange(
      nodes, [](const SkinNode& node) { return hash_of(node.edge); }, comm);
  std::vector<Dispute> disputes = comm.all_gather_rows(find_dispute(exchange.received()));
  if (disputes.empty()) return;
  const auto place = [](const Dispute& dispute) {
    return std::tuple(dispute.one.piece, dispute.other.piece, dispute.one.ends);
  };
  throw comm::Collective<InputError>(
      to_text(*std::ranges::min_element(disputes, {}, place), source));
}

}  // namespace tessera::formats

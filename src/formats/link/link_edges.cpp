// SPDX-License-Identifier: BSD-3-Clause
#include "formats/link/link_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <unordered_set>

#include "tessera/comm/record_exchange.hpp"

#include "formats/joined_tets.hpp"

namespace tessera::formats {
namespace {

using Edge = std::array<LocalIndex, 2>;

struct EdgeHash {
  std::size_t operator()(const Edge& edge) const { return hash_of(edge); }
};

EdgeKey key_of(const LoadedPiece& piece, const Edge& edge)
{
  std::array<VertexKey, 2> keys{piece.point_keys[at(edge[0])], piece.point_keys[at(edge[1])]};
  std::ranges::sort(keys);
  return key_of_vertices(keys);
}

// An edge whose ends are shared with one and the same piece.
struct Candidate {
  EdgeKey key{};
  LocalIndex piece = 0;

  static auto fields(auto& self) { return std::tie(self.key, self.piece); }
};

class SharersOfPoints {
 public:
  explicit SharersOfPoints(const PieceLinks& links) : links_(links) {}

  [[nodiscard]] bool have_common(const Edge& edge) const
  {
    const std::span<const LocalIndex> a = of(edge[0]);
    const std::span<const LocalIndex> b = of(edge[1]);
    return std::ranges::any_of(
        a, [&](LocalIndex piece) { return std::ranges::binary_search(b, piece); });
  }

 private:
  [[nodiscard]] std::span<const LocalIndex> of(LocalIndex point) const
  {
    const auto found = std::ranges::lower_bound(links_.shared_points, point);
    if (found == links_.shared_points.end() || *found != point) return {};
    return links_.sharers[static_cast<LocalIndex>(found - links_.shared_points.begin())];
  }

  const PieceLinks& links_;
};

std::vector<OtherPieces> others_with_edge(const std::vector<Candidate>& candidates,
                                          const comm::Communicator& comm)
{
  const comm::RecordExchange<Candidate> exchange(
      candidates, [](const Candidate& edge) { return hash_of(edge.key); }, comm);
  const std::span<const Candidate> received = exchange.received();
  std::vector<OtherPieces> others(received.size());
  comm::for_each_group(
      received, [](const Candidate& edge) { return edge.key; },
      [](const Candidate& edge) { return edge.piece; },
      [&](std::span<const std::size_t> rows) {
        for (const std::size_t row : rows)
          for (const std::size_t other : rows)
            if (other != row) others[row].pieces.push_back(received[other].piece);
      });
  return exchange.answer<OtherPieces>(others, comm);
}

}  // namespace

SkinEdges skin_edges(const LoadedPiece& piece, const std::vector<LocalIndex>& behind)
{
  const JoinedTets tets(piece);
  std::vector<LocalIndex> sides;
  for (std::size_t side = 0; side < behind.size(); ++side)
    if (behind[side] == kNoIndex) sides.push_back(static_cast<LocalIndex>(side));
  SkinEdges edges;
  std::unordered_set<Edge, EdgeHash> known;
  for (const JoinedSide& side : joined_sides(tets, sides)) {
    const std::vector<LocalIndex> corners = corners_of(tets, sides, side);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
      const Edge edge{low, high};
      if (!known.insert(edge).second) continue;
      edges.points.push_back(edge);
      edges.keys.push_back(key_of(piece, edge));
    }
  }
  return edges;
}

void link_edges(std::vector<SkinEdges> edges, LocalIndex first_piece,
                const comm::Communicator& comm, std::vector<PieceLinks>& links)
{
  std::vector<Candidate> candidates;
  std::vector<Edge> points;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const SharersOfPoints sharers(links[i]);
    for (std::size_t e = 0; e < edges[i].keys.size(); ++e) {
      if (!sharers.have_common(edges[i].points[e])) continue;
      candidates.push_back({edges[i].keys[e], first_piece + static_cast<LocalIndex>(i)});
      points.push_back(edges[i].points[e]);
    }
    edges[i] = {};
  }
  const std::vector<OtherPieces> others = others_with_edge(candidates, comm);
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (others[c].pieces.empty()) continue;
    PieceLinks& own = links[at(candidates[c].piece - first_piece)];
    own.shared_edges.push_back(points[c]);
    own.edge_sharers.add(others[c].pieces);
  }
}

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#include "formats/patch_points.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "tessera/comm/record_exchange.hpp"

namespace tessera::formats {
namespace {

// A point on a patch that other pieces have too.
struct SharedPatchPoint {
  VertexKey key{};
  std::int32_t patch = 0;
  LocalIndex piece = 0;

  static auto fields(auto& self) { return std::tie(self.key, self.patch, self.piece); }
};

bool is_before(const PatchPoint& a, const PatchPoint& b)
{
  return std::tie(a.patch, a.point) < std::tie(b.patch, b.point);
}

void sort_out(const Tags& tags, std::vector<PatchPoint>& points)
{
  for (PatchPoint& point : points) point.patch = tags.tag_of_patch.at(point.patch);
  std::ranges::sort(points, is_before);
  const auto is_again = [](const PatchPoint& a, const PatchPoint& b) {
    return !is_before(a, b) && !is_before(b, a);
  };
  points.erase(std::unique(points.begin(), points.end(), is_again), points.end());
}

// Calls `visit(point, row)` for those among the shared points, which are ascending.
template <class Visit>
void for_each_shared(PieceLinks& links, const Visit& visit)
{
  for (PatchPoint& point : links.patch_points) {
    const auto found = std::ranges::lower_bound(links.shared_points, point.point);
    if (found == links.shared_points.end() || *found != point.point) continue;
    visit(point, static_cast<std::size_t>(found - links.shared_points.begin()));
  }
}

std::vector<std::uint8_t> find_first_pieces(std::span<const SharedPatchPoint> points)
{
  std::vector<std::uint8_t> is_first(points.size(), 0);
  comm::for_each_group(
      points, [](const SharedPatchPoint& point) { return point.key; },
      [](const SharedPatchPoint& point) { return std::tuple(point.patch, point.piece); },
      [&](std::span<const std::size_t> rows) {
        std::int32_t last_patch = 0;  // Tags begin with 1.
        for (const std::size_t row : rows) {
          is_first[row] = points[row].patch != last_patch ? 1 : 0;
          last_patch = points[row].patch;
        }
      });
  return is_first;
}

}  // namespace

void add_patch_points(std::span<const LocalIndex> corners, std::int32_t patch,
                      std::vector<PatchPoint>& points)
{
  for (const LocalIndex corner : corners) points.push_back({corner, patch});
}

void share_out_patch_points(std::vector<PieceLinks>& links, std::span<const VertexKey> keys,
                            const Tags& tags, LocalIndex first, const comm::Communicator& comm)
{
  std::vector<SharedPatchPoint> shared;
  std::size_t first_key = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    sort_out(tags, links[i].patch_points);
    const LocalIndex number = first + static_cast<LocalIndex>(i);
    for_each_shared(links[i], [&](const PatchPoint& point, std::size_t row) {
      shared.push_back({keys[first_key + row], point.patch, number});
    });
    first_key += links[i].shared_points.size();
  }
  const comm::RecordExchange<SharedPatchPoint> exchange(
      shared, [](const SharedPatchPoint& point) { return hash_of(point.key); }, comm);
  const auto is_first = exchange.answer<std::uint8_t>(find_first_pieces(exchange.received()), comm);
  auto next = is_first.begin();
  for (PieceLinks& piece : links) {
    for_each_shared(piece, [&](PatchPoint& point, std::size_t /*row*/) {
      if (*next++ == 0) point.patch = kNoPatch;
    });
    std::erase_if(piece.patch_points,
                  [](const PatchPoint& point) { return point.patch == kNoPatch; });
  }
}

}  // namespace tessera::formats

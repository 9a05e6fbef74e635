// SPDX-License-Identifier: BSD-3-Clause
#include "flat_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "tessera/base/triangle.hpp"

#include "surface_weld.hpp"

namespace tessera::model {
namespace {

// What one triangle leaves for its neighbours is done in the next pass.
constexpr int kMostPasses = 20;

constexpr std::array<std::size_t, 3> kNext{1, 2, 0};

using Triangle = std::array<LocalIndex, 3>;
constexpr Triangle kNone{kNoIndex, kNoIndex, kNoIndex};

class FlatTriangles {
 public:
  FlatTriangles(TriangleSurface& surface, double height)
      : surface_(surface), height_(height), around_(at(surface.num_vertices()))
  {
    for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
      for (const LocalIndex v : triangle(t)) around_[at(v)].push_back(t);
    }
  }

  MendedTriangles run()
  {
    MendedTriangles mended;
    std::vector<LocalIndex> some(at(surface_.num_triangles()));
    std::iota(some.begin(), some.end(), 0);
    for (int pass = 0; pass < kMostPasses && !some.empty(); ++pass) {
      for (const LocalIndex t : some) {
        if (triangle(t) != kNone && (is_flat(triangle(t)) ? take_out(t) : unfold(t)))
          ++mended.num_steps;
      }
      some = triangles_near_changes();
    }
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (triangle(t) == kNone) mended.gone.push_back(t);
    }
    if (mended.num_steps > 0) drop_gone();
    return mended;
  }

 private:
  [[nodiscard]] Triangle triangle(LocalIndex t) const
  {
    const LocalIndex* v = &surface_.triangle_vertices[3 * at(t)];
    return {v[0], v[1], v[2]};
  }

  [[nodiscard]] double length(LocalIndex a, LocalIndex b) const
  {
    return norm(surface_.position(b) - surface_.position(a));
  }

  // The corner from which the longest edge begins.
  [[nodiscard]] std::size_t longest_edge(const Triangle& v) const
  {
    std::size_t longest = 0;
    for (const std::size_t c : {1U, 2U}) {
      if (length(v[c], v[kNext[c]]) > length(v[longest], v[kNext[longest]])) longest = c;
    }
    return longest;
  }

  [[nodiscard]] bool is_flat(const Triangle& v) const
  {
    const std::size_t c = longest_edge(v);
    const Vec3 origin = surface_.position(v[c]);
    const Vec3 along = surface_.position(v[kNext[c]]) - origin;
    const Vec3 up = surface_.position(v[kNext[kNext[c]]]) - origin;
    return norm(cross(along, up)) <= height_ * norm(along);
  }

  bool take_out(LocalIndex t)
  {
    const Triangle v = triangle(t);
    const std::size_t c = longest_edge(v);
    const LocalIndex a = v[c];
    const LocalIndex b = v[kNext[c]];
    const LocalIndex apex = v[kNext[kNext[c]]];
    const LocalIndex end = length(a, apex) < length(b, apex) ? a : b;
    if (length(apex, end) <= height_) return collapse(apex, end) || collapse(end, apex);
    return flip_longest_edge(t, c);
  }

  bool collapse(LocalIndex gone, LocalIndex kept)
  {
    const std::vector<LocalIndex> old = around_[at(gone)];
    std::vector<Triangle> made;
    for (const LocalIndex t : old) {
      Triangle v = triangle(t);
      const bool vanishes = std::ranges::find(v, kept) != v.end();
      std::ranges::replace(v, gone, kept);
      made.push_back(vanishes ? kNone : v);
    }
    return replace(old, made);
  }

  // Two triangles at an edge, and what they would be if it were flipped.
  struct Pair {
    LocalIndex other = kNoIndex;  // Beside the one that was asked for.
    LocalIndex apex = kNoIndex;
    LocalIndex across = kNoIndex;
    Triangle first{};
    Triangle second{};
  };

  // Those of the end of an edge that has fewer: a hub may have very many.
  [[nodiscard]] const std::vector<LocalIndex>& fewer_around(LocalIndex a, LocalIndex b) const
  {
    return around_[at(a)].size() <= around_[at(b)].size() ? around_[at(a)] : around_[at(b)];
  }

  [[nodiscard]] static bool has_corners(const Triangle& v, LocalIndex a, LocalIndex b)
  {
    return std::ranges::find(v, a) != v.end() && std::ranges::find(v, b) != v.end();
  }

  // At the edge from corner c of triangle t.
  [[nodiscard]] Pair pair_at(LocalIndex t, std::size_t c) const
  {
    const Triangle v = triangle(t);
    const LocalIndex a = v[c];
    const LocalIndex b = v[kNext[c]];
    Pair pair{.apex = v[kNext[kNext[c]]]};
    for (const LocalIndex other : fewer_around(a, b)) {
      const Triangle w = triangle(other);
      if (other == t || !has_corners(w, a, b)) continue;
      pair.other = other;
      pair.across = w[0] + w[1] + w[2] - a - b;  // The third corner.
      pair.first = {pair.apex, a, pair.across};
      pair.second = {pair.apex, pair.across, b};
    }
    return pair;
  }

  bool flip(LocalIndex t, const Pair& pair)
  {
    if (pair.across == pair.apex) return replace({t, pair.other}, {kNone, kNone});
    return replace({t, pair.other}, {pair.first, pair.second});
  }

  // Of a triangle whose apex lies on its longest edge.
  bool flip_longest_edge(LocalIndex t, std::size_t c)
  {
    const Pair pair = pair_at(t, c);
    if (pair.other == kNoIndex) return false;
    const Triangle v = triangle(t);
    const bool is_less_flat = !is_flat(pair.first) && !is_flat(pair.second);
    if (!is_less_flat && length(pair.apex, pair.across) >= length(v[c], v[kNext[c]])) return false;
    if (!flip(t, pair)) return false;
    surface_.triangle_solid[at(t)] = surface_.triangle_solid[at(pair.other)];
    return true;
  }

  // A fold that encloses nothing: its two triangles lie in each other. Solids stay apart.
  bool unfold(LocalIndex t)
  {
    for (std::size_t c = 0; c < 3; ++c) {
      const Pair pair = pair_at(t, c);
      if (pair.other == kNoIndex) continue;
      if (surface_.triangle_solid[at(t)] != surface_.triangle_solid[at(pair.other)]) continue;
      const Vec3 normal = area_normal(triangle(t));
      const Vec3 up = surface_.position(pair.across) - surface_.position(pair.apex);
      if (dot(normal, area_normal(triangle(pair.other))) >= 0.0) continue;
      if (std::abs(dot(normal, up)) > height_ * norm(normal)) continue;
      const double before = twice_area(triangle(t)) + twice_area(triangle(pair.other));
      const double after = twice_area(pair.first) + twice_area(pair.second);
      if (after < before && flip(t, pair)) return true;
    }
    return false;
  }

  // As long as the triangle is large, twice.
  [[nodiscard]] Vec3 area_normal(const Triangle& v) const
  {
    return normal_of({surface_.position(v[0]), surface_.position(v[1]), surface_.position(v[2])});
  }

  [[nodiscard]] double twice_area(const Triangle& v) const { return norm(area_normal(v)); }

  // Unless an edge would not have two triangles then.
  bool replace(const std::vector<LocalIndex>& old, const std::vector<Triangle>& made)
  {
    std::vector<std::pair<LocalIndex, Triangle>> undo;
    const auto change = [&](LocalIndex t, const Triangle& v) {
      undo.emplace_back(t, triangle(t));
      put(t, v);
    };
    for (std::size_t i = 0; i < old.size(); ++i) change(old[i], made[i]);
    for (const LocalIndex t : old) {
      const LocalIndex other = face_to_face(t);
      if (other == kNoIndex) continue;
      change(t, kNone);
      change(other, kNone);
    }
    const bool is_closed =
        std::ranges::all_of(undo, [&](const auto& one) { return has_closed_edges(one.second); })
        && std::ranges::all_of(made, [&](const Triangle& v) { return has_closed_edges(v); });
    if (is_closed) {
      for (const auto& [t, v] : undo) {
        if (v != kNone) changed_.insert(changed_.end(), v.begin(), v.end());
      }
      return true;
    }
    for (; !undo.empty(); undo.pop_back()) put(undo.back().first, undo.back().second);
    return false;
  }

  void put(LocalIndex t, const Triangle& v)
  {
    if (triangle(t) != kNone) {
      for (const LocalIndex corner : triangle(t)) std::erase(around_[at(corner)], t);
    }
    std::ranges::copy(v, surface_.triangle_vertices.begin() + 3 * std::ptrdiff_t{t});
    if (v == kNone) return;
    for (const LocalIndex corner : v) around_[at(corner)].push_back(t);
  }

  std::vector<LocalIndex> triangles_near_changes()
  {
    std::set<LocalIndex> near;
    for (const LocalIndex v : std::exchange(changed_, {})) {
      near.insert(around_[at(v)].begin(), around_[at(v)].end());
    }
    return {near.begin(), near.end()};
  }

  // Another triangle with the same corners.
  [[nodiscard]] LocalIndex face_to_face(LocalIndex t) const
  {
    if (triangle(t) == kNone) return kNoIndex;
    const Triangle v = triangle(t);
    for (const LocalIndex other : around_[at(v[0])]) {
      if (other != t && std::ranges::is_permutation(triangle(other), v)) return other;
    }
    return kNoIndex;
  }

  [[nodiscard]] bool has_closed_edges(const Triangle& v) const
  {
    if (v == kNone) return true;
    return std::ranges::all_of(std::array{0U, 1U, 2U}, [&](std::size_t c) {
      const LocalIndex b = v[kNext[c]];
      const auto count = std::ranges::count_if(
          fewer_around(v[c], b), [&](LocalIndex t) { return has_corners(triangle(t), v[c], b); });
      return count == 0 || count == 2;
    });
  }

  void drop_gone()
  {
    for (LocalIndex& v : surface_.triangle_vertices) v = std::max(v, LocalIndex{0});
    static_cast<void>(drop_bad_triangles(surface_));
  }

  TriangleSurface& surface_;
  double height_;
  std::vector<std::vector<LocalIndex>> around_;  // Triangles of each vertex.
  std::vector<LocalIndex> changed_{};            // Vertices.
};

}  // namespace

MendedTriangles mend_flat_triangles(TriangleSurface& surface, double height)
{
  return FlatTriangles(surface, height).run();
}

}  // namespace tessera::model

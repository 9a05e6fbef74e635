// SPDX-License-Identifier: BSD-3-Clause
#include "flat_triangles.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

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

  LocalIndex run()
  {
    LocalIndex num_steps = 0;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      const LocalIndex before = num_steps;
      for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
        if (triangle(t) != kNone && is_flat(triangle(t)) && take_out(t)) ++num_steps;
      }
      if (num_steps == before) break;
    }
    if (num_steps > 0) drop_gone();
    return num_steps;
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
    return flip(t, a, b, apex);
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

  bool flip(LocalIndex t, LocalIndex a, LocalIndex b, LocalIndex apex)
  {
    for (const LocalIndex other : around_[at(a)]) {
      const Triangle w = triangle(other);
      if (other == t || std::ranges::find(w, b) == w.end()) continue;
      const LocalIndex across = w[0] + w[1] + w[2] - a - b;  // The third corner.
      if (across == apex) return replace({t, other}, {kNone, kNone});
      const Triangle first{apex, a, across};
      const Triangle second{apex, across, b};
      const bool is_less_flat = !is_flat(first) && !is_flat(second);
      if (!is_less_flat && length(apex, across) >= length(a, b)) return false;
      if (!replace({t, other}, {first, second})) return false;
      surface_.triangle_solid[at(t)] = surface_.triangle_solid[at(other)];
      return true;
    }
    return false;
  }

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
    if (is_closed) return true;
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
      const auto count = std::ranges::count_if(around_[at(v[c])], [&](LocalIndex t) {
        return std::ranges::count(triangle(t), v[kNext[c]]) > 0;
      });
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
};

}  // namespace

LocalIndex take_out_flat_triangles(TriangleSurface& surface, double height)
{
  return FlatTriangles(surface, height).run();
}

}  // namespace tessera::model

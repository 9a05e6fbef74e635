// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/polish.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::surface {
namespace {

// A triangle with a worse shape is polished: an angle below 44 degrees.
constexpr double kPolished = 0.8;

constexpr int kMostSweeps = 12;

class Polisher {
 public:
  explicit Polisher(SurfaceEditor& editor) : editor_(editor), surface_(editor.surface()) {}

  void run()
  {
    int since = kNever;
    for (int i = 0; i < kMostSweeps; ++i) {
      const auto worst = bad_triangles(since);
      since = editor_.begin_pass();
      int count = 0;
      for (const auto& [shape, t] : worst) {
        if (surface_.is_triangle(t) && editor_.shape(t) < kPolished) count += polish(t) ? 1 : 0;
      }
      if (count == 0) return;
    }
  }

 private:
  // Those around which something has changed since.
  [[nodiscard]] std::vector<std::pair<double, LocalIndex>> bad_triangles(int since)
  {
    std::vector<std::pair<double, LocalIndex>> bad;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (!surface_.is_triangle(t)) continue;
      const bool has_changed = std::ranges::any_of(
          surface_.triangle(t), [&](LocalIndex v) { return editor_.has_changed(v, since); });
      if (!has_changed) continue;
      const double shape = editor_.shape(t);
      if (shape < kPolished) bad.emplace_back(shape, t);
    }
    std::ranges::sort(bad);
    return bad;
  }

  bool polish(LocalIndex t)
  {
    polished_at_.resize(at(surface_.num_triangles()), kNever);
    const PatchSurface::Triangle v = surface_.triangle(t);
    if (std::ranges::all_of(v, [&](LocalIndex corner) {
          return editor_.is_as_it_was(corner, polished_at_[at(t)]);
        })) {
      return false;
    }
    const int now = editor_.num_changes();
    if (take_step(v)) return true;
    polished_at_[at(t)] = now;
    return false;
  }

  bool take_step(const PatchSurface::Triangle& v)
  {
    for (std::size_t c = 0; c < 3; ++c) {
      if (editor_.flip_if_better(mesh::sorted_edge(v[c], v[(c + 1) % 3]))) return true;
    }
    bool has_moved = false;
    for (const LocalIndex corner : v) has_moved = pull(corner) || has_moved;
    if (has_moved) return true;
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex a = v[c];
      const LocalIndex b = v[(c + 1) % 3];
      if (remove(a, b) || remove(b, a)) return true;
    }
    return false;
  }

  [[nodiscard]] double better_than_around(LocalIndex v)
  {
    return std::max(editor_.worst_shape(surface_.triangles_of(v)), 0.0) + kGain;
  }

  bool remove(LocalIndex gone, LocalIndex kept)
  {
    return editor_.collapse(gone, kept, better_than_around(gone));
  }

  bool pull(LocalIndex v)
  {
    pulled_at_.resize(at(surface_.num_vertices()), kNever);
    if (surface_.freedom(v) == Freedom::none || editor_.is_as_it_was(v, pulled_at_[at(v)])) {
      return false;
    }
    const int now = editor_.num_changes();
    if (take_pull(v)) return true;
    pulled_at_[at(v)] = now;
    return false;
  }

  bool take_pull(LocalIndex v)
  {
    const Vec3 before = surface_.xyz(v);
    const double least = better_than_around(v);
    std::vector<Vec3> targets{surface_.middle_of_neighbours(v)};
    if (surface_.freedom(v) == Freedom::patch) targets.insert(targets.begin(), best_corner(v));
    for (const double step : {1.0, 0.5, 0.25, 0.1}) {
      for (const Vec3& target : targets) {
        if (editor_.move(v, before + step * (target - before), least)) return true;
      }
    }
    return false;
  }

  // Where the third corner of equilateral triangles on the opposite sides would be, those of bad
  // triangles counting most.
  [[nodiscard]] Vec3 best_corner(LocalIndex v)
  {
    constexpr double kLeastWeight = 1e-3;
    Vec3 sum{};
    double weights = 0.0;
    for (const LocalIndex t : surface_.triangles_of(v)) {
      const auto [p, a, b] = surface_.corners_from(t, v);
      const Vec3 inward = unit(cross(normal_of({p, a, b}), b - a));
      const double height = 0.5 * std::sqrt(3.0) * norm(b - a);
      const double bad = 1.0 - std::max(editor_.shape(t), 0.0);
      const double weight = bad * bad + kLeastWeight;
      sum = sum + weight * (midpoint(a, b) + height * inward);
      weights += weight;
    }
    return (1.0 / weights) * sum;
  }

  SurfaceEditor& editor_;
  const EditableSurface& surface_;
  // Number of changes when no step was found, of each triangle and vertex: what was tried then need
  // not be tried again as long as nothing has changed around.
  std::vector<int> polished_at_{};
  std::vector<int> pulled_at_{};
};

}  // namespace

void polish_surface(SurfaceEditor& editor) { Polisher(editor).run(); }

}  // namespace tessera::surface

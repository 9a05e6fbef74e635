// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/divide_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::surface {
namespace {

using Edge = SurfaceEditor::Edge;
using Chain = std::vector<LocalIndex>;  // Vertices along a curve.

// In parts of the spacing: a vertex so near to a place of the division takes it.
constexpr double kNear = 0.25;

// A curve that closes without a vertex that stays.
constexpr double kLeastOfLoop = 3.0;

class ChainFinder {
 public:
  explicit ChainFinder(const EditableSurface& surface) : surface_(surface) {}

  // A curve without a vertex that stays begins and ends at its lowest one.
  std::vector<Chain> run() &&
  {
    for (const auto& [edge, curve] : surface_.curves()) {
      for (const LocalIndex end : edge) {
        if (surface_.freedom(end) == Freedom::none) follow(end, edge[0] + edge[1] - end);
      }
    }
    for (const auto& [edge, curve] : surface_.curves()) follow(edge[0], edge[1]);
    return std::move(chains_);
  }

 private:
  void follow(LocalIndex first, LocalIndex second)
  {
    if (!seen_.insert(mesh::sorted_edge(first, second)).second) return;
    Chain chain{first, second};
    while (chain.back() != first && surface_.freedom(chain.back()) == Freedom::curve) {
      const LocalIndex before = chain[chain.size() - 2];
      const std::vector<LocalIndex> two = surface_.curve_neighbours(chain.back());
      chain.push_back(two.front() == before ? two.back() : two.front());
      seen_.insert(mesh::sorted_edge(chain[chain.size() - 2], chain.back()));
    }
    chains_.push_back(std::move(chain));
  }

  const EditableSurface& surface_;
  std::set<Edge> seen_{};
  std::vector<Chain> chains_{};
};

class Divider {
 public:
  Divider(SurfaceEditor& editor, const Chain& chain) : editor_(editor), chain_(chain)
  {
    for (std::size_t i = 1; i < chain.size(); ++i) {
      lengths_.push_back(editor.relative_length(mesh::sorted_edge(chain[i - 1], chain[i])));
    }
    next_at_ = lengths_.front();
  }

  void run()
  {
    const double whole = std::accumulate(lengths_.begin(), lengths_.end(), 0.0);
    const double least = chain_.front() == chain_.back() ? kLeastOfLoop : 1.0;
    const auto count = static_cast<int>(std::max(least, std::round(whole)));
    const double spacing = whole / count;
    for (int i = 1; i < count; ++i) put_vertex(i * spacing, kNear * spacing);
    while (next_ + 1 < chain_.size()) pass_next(true);
    for (const LocalIndex v : gone_) leave(v);
  }

 private:
  // The next vertex of the chain is behind us.
  void pass_next(bool goes)
  {
    last_ = chain_[next_];
    last_at_ = next_at_;
    if (goes) gone_.push_back(last_);
    next_at_ += lengths_[next_++];
  }

  [[nodiscard]] bool is_second_nearer(double place) const
  {
    return std::abs(next_at_ + lengths_[next_] - place) < std::abs(next_at_ - place);
  }

  // The next vertex moves to the place, if that can be.
  void take_next(double place)
  {
    const EditableSurface& surface = editor_.surface();
    const LocalIndex v = chain_[next_];
    const bool is_before = place < next_at_;
    const double length = is_before ? next_at_ - last_at_ : lengths_[next_];
    const Vec3& beside = surface.xyz(is_before ? last_ : chain_[next_ + 1]);
    if (length > 0.0) {
      const double part = std::abs(place - next_at_) / length;
      editor_.move(v, surface.xyz(v) + part * (beside - surface.xyz(v)), editor_.fair_shape(v));
    }
    pass_next(false);
  }

  // All as lengths along the chain.
  void put_vertex(double place, double near)
  {
    while (next_ + 1 < chain_.size() && next_at_ < place && is_second_nearer(place)) {
      pass_next(true);
    }
    if (std::abs(next_at_ - place) <= near && next_ + 1 < chain_.size()) return take_next(place);
    if (next_at_ < place && next_ + 1 < chain_.size()) pass_next(true);
    const Edge edge = mesh::sorted_edge(last_, chain_[next_]);
    const double part = (place - last_at_) / (next_at_ - last_at_);
    last_ = editor_.split(edge, edge[0] == last_ ? part : 1.0 - part);
    last_at_ = place;
  }

  // Into the nearer one of its neighbours, if that can be.
  void leave(LocalIndex v)
  {
    const EditableSurface& surface = editor_.surface();
    std::vector<LocalIndex> two = surface.curve_neighbours(v);
    std::ranges::sort(two, {}, [&](LocalIndex other) {
      return std::pair(editor_.relative_length(mesh::sorted_edge(v, other)), other);
    });
    for (const LocalIndex kept : two) {
      if (editor_.collapse(v, kept, editor_.fair_shape(v))) return;
    }
  }

  SurfaceEditor& editor_;
  const Chain& chain_;
  std::vector<double> lengths_{};  // In parts of the wanted ones.
  std::vector<LocalIndex> gone_{};
  LocalIndex last_ = chain_.front();
  double last_at_ = 0.0;
  std::size_t next_ = 1;  // Row of chain_.
  double next_at_ = 0.0;
};

// Whether sizes along an edge are not about what they are at its ends.
bool hides_sizes(const SurfaceEditor& editor, const Edge& edge)
{
  constexpr double kAlike = 0.25;
  const EditableSurface& surface = editor.surface();
  const double at_ends = 0.5 * (surface.size(edge[0]) + surface.size(edge[1]));
  const double in_middle = editor.size_at(midpoint(surface.xyz(edge[0]), surface.xyz(edge[1])));
  return editor.relative_length(edge) > 1.0 && std::abs(in_middle - at_ends) > kAlike * at_ends;
}

// A straight edge of the CAD is one edge, however sizes change along it: it gets vertices for them.
void show_sizes(SurfaceEditor& editor)
{
  constexpr int kMostSweeps = 12;
  for (int i = 0; i < kMostSweeps; ++i) {
    std::vector<Edge> hiding;
    for (const auto& [edge, curve] : editor.surface().curves()) {
      if (hides_sizes(editor, edge)) hiding.push_back(edge);
    }
    if (hiding.empty()) return;
    for (const Edge& edge : hiding) editor.split(edge);
  }
}

}  // namespace

void divide_curves(SurfaceEditor& editor)
{
  editor.begin_pass();
  show_sizes(editor);
  const std::vector<Chain> chains = ChainFinder(editor.surface()).run();
  for (const Chain& chain : chains) Divider(editor, chain).run();
}

}  // namespace tessera::surface

// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/seam_mover.hpp"

#include <algorithm>
#include <cstddef>

namespace tessera::decompose {
namespace {

// A move that only shortens a seam may not make a subdomain lighter or heavier than these shares of
// the mean; METIS itself balances to 3 %.
constexpr double kLightestShare = 0.8;
constexpr double kHeaviestShare = 1.1;

bool share_a_vertex(std::span<const LocalIndex, 4> a, std::span<const LocalIndex, 4> b)
{
  return std::any_of(a.begin(), a.end(),
                     [&](LocalIndex v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

}  // namespace

SeamMover::SeamMover(const TetGraph& graph, TetPartition& partition,
                     NonManifoldVertices& non_manifold)
    : graph_(&graph),
      partition_(&partition),
      non_manifold_(&non_manifold),
      is_queued_(static_cast<std::size_t>(graph.num_tets()), false),
      visit_(static_cast<std::size_t>(graph.num_tets()), 0)
{
}

void SeamMover::push(LocalIndex t)
{
  if (is_queued_[static_cast<std::size_t>(t)]) return;
  is_queued_[static_cast<std::size_t>(t)] = true;
  queue_.push_back(t);
}

LocalIndex SeamMover::run(std::span<const LocalIndex> tets)
{
  mean_weight_ = partition_->mean_weight();
  for (const LocalIndex t : tets) push(t);
  LocalIndex num_moves = 0;
  while (!queue_.empty()) {
    const LocalIndex t = queue_.front();
    queue_.pop_front();
    is_queued_[static_cast<std::size_t>(t)] = false;
    if (!try_move(t)) continue;
    ++num_moves;
    for (const LocalIndex v : graph_->vertices(t)) {
      for (const LocalIndex around : graph_->tets_at(v)) push(around);
    }
  }
  return num_moves;
}

bool SeamMover::try_move(LocalIndex t)
{
  if (partition_->num_tets(partition_->of(t)) == 1) return false;
  const Change change = best_change(t);
  if (change.to == kNoIndex || !keeps_connected(t)) return false;
  partition_->assign(t, change.to);
  non_manifold_->refresh(std::span(&t, 1));
  return true;
}

SeamMover::Change SeamMover::best_change(LocalIndex t)
{
  const LocalIndex from = partition_->of(t);
  const auto neighbours = graph_->neighbours(t);
  const auto face_cost = graph_->face_cost(t);
  const auto price_towards = [&](LocalIndex part) {
    std::int64_t price = 0;
    for (std::size_t face = 0; face < 4; ++face) {
      const bool is_shared =
          neighbours[face] != kNoIndex && partition_->of(neighbours[face]) == part;
      if (is_shared) price += face_cost[face];
    }
    return price;
  };
  const bool near_non_manifold = is_near_non_manifold(t);
  Change best;
  for (const LocalIndex neighbour : neighbours) {
    if (neighbour == kNoIndex) continue;
    const LocalIndex to = partition_->of(neighbour);
    if (to == from || to == best.to) continue;
    Change change{to, 0, price_towards(from) - price_towards(to)};
    if (!near_non_manifold && change.price >= 0) continue;
    change.non_manifold = non_manifold_change(t, to);
    const auto is_less = [](const Change& a, const Change& b) {
      return a.non_manifold != b.non_manifold ? a.non_manifold < b.non_manifold : a.price < b.price;
    };
    if (!is_less(change, best)) continue;
    if (change.non_manifold < 0 || keeps_balance(t, to)) best = change;
  }
  return best;
}

int SeamMover::non_manifold_change(LocalIndex t, LocalIndex to)
{
  const LocalIndex from = partition_->of(t);
  const int before = non_manifold_->count_at_tet(t, from, to);
  partition_->pretend(t, to);
  const int after = non_manifold_->count_at_tet(t, from, to);
  partition_->pretend(t, from);
  return after - before;
}

bool SeamMover::is_near_non_manifold(LocalIndex t) const
{
  const auto vertices = graph_->vertices(t);
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](LocalIndex v) { return non_manifold_->total(v) > 0; });
}

bool SeamMover::keeps_balance(LocalIndex t, LocalIndex to) const
{
  const double from_before = partition_->weight(partition_->of(t));
  const double to_after = partition_->weight(to) + graph_->weight(t);
  if (to_after <= from_before) return true;
  return from_before - graph_->weight(t) >= kLightestShare * mean_weight_
         && to_after <= kHeaviestShare * mean_weight_;
}

// Without `t`, its neighbours of its own part must still reach each other through tets that touch
// `t`. A way around elsewhere does not count: it would be a ring that the move cuts open, and to
// refuse that move is no loss.
bool SeamMover::keeps_connected(LocalIndex t)
{
  const LocalIndex part = partition_->of(t);
  const auto is_own = [&](LocalIndex n) { return n != kNoIndex && partition_->of(n) == part; };
  const auto neighbours = graph_->neighbours(t);
  auto missing = std::count_if(neighbours.begin(), neighbours.end(), is_own);
  if (missing < 2) return true;

  const LocalIndex search = ++num_searches_;
  visit_[static_cast<std::size_t>(t)] = search;
  const LocalIndex start = *std::find_if(neighbours.begin(), neighbours.end(), is_own);
  visit_[static_cast<std::size_t>(start)] = search;
  stack_.assign(1, start);
  while (!stack_.empty()) {
    const LocalIndex current = stack_.back();
    stack_.pop_back();
    const bool is_neighbour =
        std::find(neighbours.begin(), neighbours.end(), current) != neighbours.end();
    if (is_neighbour && --missing == 0) return true;
    for (const LocalIndex next : graph_->neighbours(current)) {
      if (!is_own(next) || visit_[static_cast<std::size_t>(next)] == search) continue;
      if (!share_a_vertex(graph_->vertices(t), graph_->vertices(next))) continue;
      visit_[static_cast<std::size_t>(next)] = search;
      stack_.push_back(next);
    }
  }
  return false;
}

}  // namespace tessera::decompose

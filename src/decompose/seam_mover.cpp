// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/seam_mover.hpp"

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

SeamMover::SeamMover(const TetGraph& graph, Labelling& labelling, Spots& spots)
    : graph_(&graph),
      labelling_(&labelling),
      spots_(&spots),
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
  mean_weight_ = labelling_->mean_weight();
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
  if (labelling_->num_tets(labelling_->of(t)) == 1) return false;
  const Change change = best_change(t);
  if (change.to == kNoIndex || !keeps_connected(t)) return false;
  labelling_->assign(t, change.to);
  spots_->refresh(std::span(&t, 1));
  return true;
}

SeamMover::Change SeamMover::best_change(LocalIndex t)
{
  const LocalIndex from = labelling_->of(t);
  const auto neighbours = graph_->neighbours(t);
  const auto face_cost = graph_->face_cost(t);
  const auto price_towards = [&](LocalIndex label) {
    std::int64_t price = 0;
    for (std::size_t face = 0; face < 4; ++face) {
      const bool is_shared =
          neighbours[face] != kNoIndex && labelling_->of(neighbours[face]) == label;
      if (is_shared) price += face_cost[face];
    }
    return price;
  };
  const bool near_spot = is_near_spot(t);
  Change best;
  for (const LocalIndex neighbour : neighbours) {
    if (neighbour == kNoIndex) continue;
    const LocalIndex to = labelling_->of(neighbour);
    if (to == from || to == best.to) continue;
    Change change{to, 0, price_towards(from) - price_towards(to)};
    if (!near_spot && change.price >= 0) continue;
    change.spots = spots_change(t, to);
    const auto is_less = [](const Change& a, const Change& b) {
      return a.spots != b.spots ? a.spots < b.spots : a.price < b.price;
    };
    if (!is_less(change, best)) continue;
    if (change.spots < 0 || keeps_balance(t, to)) best = change;
  }
  return best;
}

int SeamMover::spots_change(LocalIndex t, LocalIndex to)
{
  const LocalIndex from = labelling_->of(t);
  const int before = spots_->count_at_tet(t, from, to);
  labelling_->pretend(t, to);
  const int after = spots_->count_at_tet(t, from, to);
  labelling_->pretend(t, from);
  return after - before;
}

bool SeamMover::is_near_spot(LocalIndex t) const
{
  const auto vertices = graph_->vertices(t);
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](LocalIndex v) { return spots_->total(v) > 0; });
}

bool SeamMover::keeps_balance(LocalIndex t, LocalIndex to) const
{
  const double from_before = labelling_->weight(labelling_->of(t));
  const double to_after = labelling_->weight(to) + graph_->weight(t);
  if (to_after <= from_before) return true;
  return from_before - graph_->weight(t) >= kLightestShare * mean_weight_
         && to_after <= kHeaviestShare * mean_weight_;
}

// Without `t`, its neighbours of its own label must still reach each other, here through tets that
// touch `t`: a way around elsewhere would be a ring that the move cuts open, which is no loss to
// refuse.
bool SeamMover::keeps_connected(LocalIndex t)
{
  const LocalIndex label = labelling_->of(t);
  const auto is_own = [&](LocalIndex n) { return n != kNoIndex && labelling_->of(n) == label; };
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

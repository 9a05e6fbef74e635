// SPDX-License-Identifier: BSD-3-Clause
#include "formats/link/ghosts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include "tessera/base/sort_unique.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/record_exchange.hpp"

#include "formats/cells.hpp"

namespace tessera::formats {
namespace {

constexpr std::size_t kMostCorners = 6;

// A cell on its way to a piece that it touches.
struct GhostCell {
  LocalIndex target = 0;
  LocalIndex piece = 0;
  Shape shape = Shape::tet;
  GlobalIndex number = 0;  // Of those of its shape in its piece; then in the whole mesh.
  std::array<GlobalIndex, kMostCorners> points{};

  static auto fields(auto& self)
  {
    return std::tie(self.target, self.piece, self.shape, self.number, self.points);
  }
};

// A point of such a cell.
struct GhostPoint {
  LocalIndex target = 0;
  GlobalIndex number = 0;
  Vec3 position{};

  static auto fields(auto& self) { return std::tie(self.target, self.number, self.position); }
};

struct GhostSet {
  std::vector<GhostCell> cells{};
  std::vector<GhostPoint> points{};
};

// What other pieces need of one.
class GhostFinder {
 public:
  explicit GhostFinder(const Piece& piece) : piece_(piece)
  {
    list_of_.assign(at(piece.num_points()), kNoIndex);
    for (std::size_t s = 0; s < piece.shared_points.size(); ++s)
      list_of_[at(piece.shared_points[s])] = static_cast<LocalIndex>(s);
  }

  GhostSet find()
  {
    const PieceCells cells(piece_);
    for (const Shape shape : kCellShapes) {
      const ElementList list = cells[shape];
      for (std::size_t row = 0; row < list.size(); ++row) {
        const GhostCell cell{
            .piece = piece_.number, .shape = shape, .number = static_cast<GlobalIndex>(row)};
        for (const LocalIndex target : targets_of(list.of(row))) add(cell, list.of(row), target);
      }
    }
    sort_unique(needed_);
    for (const auto& [target, row] : needed_) {
      found_.points.push_back(
          {target, piece_.point_numbers[at(row)], point_at(std::span(piece_.point_xyz), row)});
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::span<const LocalIndex> sharers(LocalIndex row) const
  {
    const LocalIndex list = list_of_[at(row)];
    return list == kNoIndex ? std::span<const LocalIndex>{} : piece_.sharers[list];
  }

  const std::vector<LocalIndex>& targets_of(std::span<const LocalIndex> corners)
  {
    targets_.clear();
    for (const LocalIndex row : corners)
      targets_.insert(targets_.end(), sharers(row).begin(), sharers(row).end());
    sort_unique(targets_);
    return targets_;
  }

  void add(GhostCell ghost, std::span<const LocalIndex> corners, LocalIndex target)
  {
    ghost.target = target;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      ghost.points[c] = piece_.point_numbers[at(corners[c])];
      if (!std::ranges::binary_search(sharers(corners[c]), target))
        needed_.push_back({target, corners[c]});
    }
    found_.cells.push_back(ghost);
  }

  const Piece& piece_;
  std::vector<LocalIndex> list_of_{};  // By row: of its sharers.
  std::vector<LocalIndex> targets_{};
  std::vector<std::pair<LocalIndex, LocalIndex>> needed_{};  // Target and row.
  GhostSet found_{};
};

// Sends records to the ranks of their targets, and sorts out by target what comes.
class Delivery {
 public:
  Delivery(const PieceSource& source, const comm::Communicator& comm)
      : comm_(comm), first_(source.first_of(comm.rank()))
  {
    for (Rank rank = 0; rank < comm.size(); ++rank) {
      const LocalIndex num_pieces = source.first_of(rank + 1) - source.first_of(rank);
      rank_of_.insert(rank_of_.end(), at(num_pieces), rank);
    }
  }

  template <class Record>
  void send(std::span<const Record> records, std::vector<std::vector<Record>*> received) const
  {
    const auto rank_of = [&](const Record& record) {
      return static_cast<std::uint64_t>(rank_of_[at(record.target)]);
    };
    const comm::RecordExchange<Record> exchange(records, rank_of, comm_);
    for (const Record& record : exchange.received())
      received[at(record.target - first_)]->push_back(record);
  }

 private:
  const comm::Communicator& comm_;
  LocalIndex first_;
  std::vector<Rank> rank_of_{};
};

void deliver(const GhostSet& sent, const Delivery& delivery, std::vector<GhostSet>& received)
{
  std::vector<std::vector<GhostCell>*> cells;
  std::vector<std::vector<GhostPoint>*> points;
  for (GhostSet& set : received) {
    cells.push_back(&set.cells);
    points.push_back(&set.points);
  }
  delivery.send(std::span(sent.cells), cells);
  delivery.send(std::span(sent.points), points);
}

// Ghosts in the order of their numbers, which does not depend on who sent when.
Ghosts sorted(GhostSet set, const Outline& outline)
{
  Ghosts ghosts;
  for (GhostCell& cell : set.cells) cell.number += outline.first_number(cell.shape, cell.piece);
  std::ranges::sort(set.cells, {}, &GhostCell::number);
  for (const GhostCell& cell : set.cells) {
    ghosts.cells.push_back(cell.number);
    ghosts.cell_shape.push_back(cell.shape);
    ghosts.cell_piece.push_back(cell.piece);
    ghosts.cell_points.add(std::span(cell.points).first(num_corners(cell.shape)));
  }
  set.cells = {};
  std::ranges::sort(set.points, {}, &GhostPoint::number);
  for (const GhostPoint& point : set.points) {
    if (!ghosts.points.empty() && ghosts.points.back() == point.number) continue;
    ghosts.points.push_back(point.number);
    ghosts.point_xyz.insert(ghosts.point_xyz.end(), point.position.begin(), point.position.end());
  }
  return ghosts;
}

LocalIndex most_pieces_of_a_rank(const PieceSource& source, int num_ranks)
{
  LocalIndex most = 0;
  for (Rank rank = 0; rank < num_ranks; ++rank)
    most = std::max(most, source.first_of(rank + 1) - source.first_of(rank));
  return most;
}

}  // namespace

std::vector<Ghosts> collect_ghosts(const PieceSource& source, const LinkedMesh& mesh,
                                   const comm::Communicator& comm,
                                   const std::function<void()>& before_each)
{
  const Delivery delivery(source, comm);
  const LocalIndex num_rounds = most_pieces_of_a_rank(source, comm.size());
  std::vector<GhostSet> received(mesh.links.size());
  // A piece at a time on each rank, so that little is under way at once.
  for (LocalIndex round = 0; round < num_rounds; ++round) {
    GhostSet sent;
    all_or_none(comm, [&] {
      if (at(round) >= mesh.links.size()) return;
      before_each();
      const LocalIndex number = source.first_of(comm.rank()) + round;
      sent =
          GhostFinder(build_piece(source.load(number), number, mesh.links[at(round)], mesh)).find();
    });
    deliver(sent, delivery, received);
  }
  std::vector<Ghosts> ghosts;
  for (GhostSet& set : received) ghosts.push_back(sorted(std::exchange(set, {}), mesh.outline));
  return ghosts;
}

}  // namespace tessera::formats

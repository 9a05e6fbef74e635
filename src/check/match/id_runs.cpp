// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/id_runs.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace tessera::check {
namespace {

constexpr GlobalIndex kMaxId = GlobalIndex{1} << 62;

// Reports each id of [begin, end); describes as many as can be among the first ones.
template <class Describe>
void report_ids(Kind kind, GlobalIndex begin, GlobalIndex end, Findings& findings,
                const Describe& describe)
{
  const auto num_described = std::min<GlobalIndex>(end - begin, Findings::kNumKept);
  for (GlobalIndex id = begin; id < begin + num_described; ++id)
    findings.add(kind, {-1, id}, [&] { return describe(id); });
  findings.add_uncited(kind, end - begin - num_described);
}

std::string describe_twice(const IdSpace& space, GlobalIndex id, std::span<const IdRun> runs)
{
  std::vector<LocalIndex> pieces;
  for (const IdRun& run : runs)
    if (run.begin <= id && id < run.end) pieces.push_back(run.piece);
  std::sort(pieces.begin(), pieces.end());
  std::string text = fmt::format("{} id {} is given more than once, in piece", space.of, id);
  for (const LocalIndex piece : pieces) text += fmt::format(" {}", piece);
  return text;
}

// Looks at the ids of [begin, end). @pre runs are ascending and within the range.
void sweep(std::span<const IdRun> runs, GlobalIndex begin, GlobalIndex end, const IdSpace& space,
           Findings& findings)
{
  const auto report_hole = [&](GlobalIndex from, GlobalIndex to) {
    if (!space.is_dense) return;
    report_ids(space.hole, from, to, findings, [&](GlobalIndex id) {
      return fmt::format("no {} has id {}, but higher ids exist", space.of, id);
    });
  };
  GlobalIndex covered = begin;
  for (const IdRun& run : runs) {
    if (run.begin > covered) report_hole(covered, run.begin);
    if (run.begin < covered) {
      report_ids(space.twice, run.begin, std::min(run.end, covered), findings,
                 [&](GlobalIndex id) { return describe_twice(space, id, runs); });
    }
    covered = std::max(covered, run.end);
  }
  if (covered < end) report_hole(covered, end);
}

GlobalIndex max_over_ranks(GlobalIndex value, const comm::Communicator& comm)
{
  std::vector<GlobalIndex> values(static_cast<std::size_t>(comm.size()), 0);
  values[static_cast<std::size_t>(comm.rank())] = value;
  comm.sum_in_place(values);
  return *std::max_element(values.begin(), values.end());
}

// Cuts runs at multiples of `block` and gives each part to the rank of its block.
std::vector<IdRun> send_to_blocks(std::span<const IdRun> runs, GlobalIndex block,
                                  const comm::Communicator& comm)
{
  std::vector<std::vector<IdRun>> to_rank(static_cast<std::size_t>(comm.size()));
  for (IdRun run : runs) {
    while (run.begin < run.end) {
      const GlobalIndex rank = run.begin / block;
      const GlobalIndex cut = std::min(run.end, (rank + 1) * block);
      to_rank[static_cast<std::size_t>(rank)].push_back({run.begin, cut, run.piece});
      run.begin = cut;
    }
  }
  std::vector<comm::Message> messages;
  for (std::size_t r = 0; r < to_rank.size(); ++r) {
    if (to_rank[r].empty()) continue;
    messages.push_back({static_cast<Rank>(r), to_bytes(to_rank[r])});
  }
  std::vector<IdRun> received;
  for (const comm::Message& message : comm.exchange(std::move(messages))) {
    std::ranges::move(from_bytes<std::vector<IdRun>>(message.bytes), std::back_inserter(received));
  }
  return received;
}

// Lengthens the last run by the id, or begins a new one; runs before `num_before` are complete.
void append_id(const PointId& id, std::size_t num_before, const IdSpace& space,
               std::vector<IdRun>& runs, Findings& findings)
{
  if (id.id < 0 || id.id > kMaxId) {
    findings.add(space.hole, {id.piece, id.id}, [&] {
      return fmt::format("piece {}: {} id {} is out of range", id.piece, space.of, id.id);
    });
  } else if (runs.size() > num_before && runs.back().end == id.id
             && runs.back().piece == id.piece) {
    ++runs.back().end;
  } else {
    runs.push_back({id.id, id.id + 1, id.piece});
  }
}

}  // namespace

IdSpace point_id_space(bool is_dense)
{
  return {"point", Kind::point_id_twice, Kind::point_id_hole, is_dense};
}

IdSpace cell_id_space(bool is_dense)
{
  return {"cell", Kind::cell_id_twice, Kind::cell_id_hole, is_dense};
}

void append_runs(std::vector<GlobalIndex> ids, LocalIndex piece, const IdSpace& space,
                 std::vector<IdRun>& runs, Findings& findings)
{
  if (!std::is_sorted(ids.begin(), ids.end())) std::sort(ids.begin(), ids.end());
  const std::size_t num_before = runs.size();
  for (const GlobalIndex id : ids) append_id({id, piece}, num_before, space, runs, findings);
}

void append_runs(std::vector<PointId> ids, const IdSpace& space, std::vector<IdRun>& runs,
                 Findings& findings)
{
  std::sort(ids.begin(), ids.end());
  const std::size_t num_before = runs.size();
  for (const PointId& id : ids) append_id(id, num_before, space, runs, findings);
}

void check_ids(std::span<const IdRun> runs, const IdSpace& space, const comm::Communicator& comm,
               Findings& findings)
{
  GlobalIndex end = 0;
  for (const IdRun& run : runs) end = std::max(end, run.end);
  end = max_over_ranks(end, comm);
  const GlobalIndex block = std::max<GlobalIndex>(1, (end + comm.size() - 1) / comm.size());

  std::vector<IdRun> own = send_to_blocks(runs, block, comm);
  std::sort(own.begin(), own.end());
  const GlobalIndex first = std::min(end, comm.rank() * block);
  sweep(own, first, std::min(end, first + block), space, findings);
}

}  // namespace tessera::check

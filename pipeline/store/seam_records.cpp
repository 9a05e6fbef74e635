// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/seam_records.hpp"

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

namespace tessera::pipeline {
namespace {

io::LogName name_of(SeamRecord kind, LocalIndex number)
{
  return {static_cast<LocalIndex>(kind), number};
}

}  // namespace

SeamRecords::SeamRecords(const std::filesystem::path& store, const comm::Communicator& comm)
    : comm_(comm), reader_(store)
{
  const std::vector<LocalIndex> files = on_root(comm_, [&] { return reader_.files(); });
  // Behind all that are there: nothing is appended to what a dead writer has left.
  writer_.emplace(store, (files.empty() ? 0 : files.back() + 1) + comm_.rank());
  all_or_none(comm_, [&] {
    for (std::size_t i = at(comm_.rank()); i < files.size(); i += at(comm_.size())) {
      for (const io::LogPlace& place : reader_.find_places(files[i])) new_places_.push_back(place);
    }
  });
  share();
}

void SeamRecords::put(SeamRecord kind, LocalIndex number, std::span<const Bytes> segments)
{
  new_places_.push_back(writer_->append(name_of(kind, number), segments));
  places_.insert_or_assign(new_places_.back().name, new_places_.back());
}

void SeamRecords::share()
{
  for (const io::LogPlace& place : comm_.all_gather_rows(new_places_)) {
    places_.insert_or_assign(place.name, place);
  }
  new_places_.clear();
}

bool SeamRecords::contains(SeamRecord kind, LocalIndex number) const
{
  return places_.contains(name_of(kind, number));
}

LocalIndex SeamRecords::num_segments(SeamRecord kind, LocalIndex number) const
{
  const auto place = places_.find(name_of(kind, number));
  return place == places_.end() ? 0 : place->second.num_segments;
}

Bytes SeamRecords::get(SeamRecord kind, LocalIndex number, LocalIndex segment) const
{
  const auto place = places_.find(name_of(kind, number));
  if (place == places_.end()) {
    throw InputError(fmt::format("the improvement has left no record {} of {}",
                                 static_cast<LocalIndex>(kind), number));
  }
  return reader_.segment(place->second, segment);
}

}  // namespace tessera::pipeline

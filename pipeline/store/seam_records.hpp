// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/io/record_log.hpp"

namespace tessera::pipeline {

/// @brief What a record of the improvement holds. The number in its name is that of a subdomain, or
/// of a region.
enum class SeamRecord : LocalIndex {
  bands_of_phase_1,  ///< Of a piece: band_segments(). Those of phase 0 are in its own record.
  bands_of_phase_2,
  region,  ///< How a region has ended; if it is improved, then the update of each piece.
  list,    ///< What a piece shares in the end; then what of it each of its neighbours may have.
  owned,   ///< What it owns of that.
};

/// @pre phase is 1 or 2.
[[nodiscard]] inline SeamRecord bands_of_phase(int phase)
{
  return static_cast<SeamRecord>(static_cast<LocalIndex>(SeamRecord::bands_of_phase_1) + phase - 1);
}

/// @brief The records of the improvement. Every rank puts its own into one file of the store, and
/// learns from the others where theirs are. Beside the files there is a list of places, the same on
/// every rank after share().
///
/// Records are values of pure functions of the filled pieces. So whatever of them a stopped run has
/// left is as good as made anew.
class SeamRecords {
 public:
  /// @brief Takes up what a stopped run has left. @note Collective.
  SeamRecords(const std::filesystem::path& store, const comm::Communicator& comm);

  /// @brief Keeps a record. This rank knows it at once, the others after share(). Local.
  /// @throws OutputError
  void put(SeamRecord kind, LocalIndex number, std::span<const Bytes> segments);

  /// @brief Tells all ranks of all records. @note Collective.
  void share();

  [[nodiscard]] bool contains(SeamRecord kind, LocalIndex number) const;

  /// @brief Number of segments, 0 if there is no such record. Local.
  [[nodiscard]] LocalIndex num_segments(SeamRecord kind, LocalIndex number) const;

  /// @brief Reads one segment. Local. @throws InputError if it is missing or damaged.
  [[nodiscard]] Bytes get(SeamRecord kind, LocalIndex number, LocalIndex segment) const;

 private:
  const comm::Communicator& comm_;
  io::LogReader reader_;
  std::optional<io::LogWriter> writer_{};
  std::map<io::LogName, io::LogPlace> places_{};
  std::vector<io::LogPlace> new_places_{};  ///< Of this rank, not shared yet.
};

}  // namespace tessera::pipeline

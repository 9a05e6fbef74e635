// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/base/types.hpp"
#include "tessera/io/open_files.hpp"

/// Many small records of several writers: each writer puts its own into one file, one behind the
/// other, and readers take out what they need. Nothing is ever changed or removed but the whole
/// file.
namespace tessera::io {

/// @brief Which record it is; what the numbers mean is the user's.
struct LogName {
  LocalIndex kind = 0;
  LocalIndex number = 0;

  static auto fields(auto& self) { return std::tie(self.kind, self.number); }

  friend auto operator<=>(const LogName&, const LogName&) = default;
};

/// @brief Where a record is.
struct LogPlace {
  LogName name{};
  LocalIndex file = kNoIndex;  ///< Number of its file.
  LocalIndex num_segments = 0;
  std::uint64_t offset = 0;  ///< In the file, of the record's head.
  Hash128 head_hash{};       ///< Of the head; it has the hashes of the segments.

  static auto fields(auto& self)
  {
    return std::tie(self.name, self.file, self.num_segments, self.offset, self.head_hash);
  }
};

/// @brief Appends records to a file of its own, `log_NNNNNN.record`. The file is made with the
/// first record. All functions are local.
class LogWriter {
 public:
  /// @param[in] file A number that no file of the folder has.
  LogWriter(std::filesystem::path folder, LocalIndex file);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// @brief Appends a record. Readers see it once they know its place.
  /// @throws OutputError (disk full, permission); nothing may be appended then.
  [[nodiscard]] LogPlace append(const LogName& name, std::span<const Bytes> segments);

 private:
  void open();
  void write(std::span<const std::byte> bytes);

  std::filesystem::path path_;
  LocalIndex file_;
  int descriptor_ = -1;
  std::uint64_t end_ = 0;
};

/// @brief Reads records of the files of a folder. Files stay open. All functions are local.
class LogReader {
 public:
  explicit LogReader(std::filesystem::path folder);

  /// @brief One segment of a record, proven to be what was appended by its size and 128-bit hash.
  /// Nothing else of the record is read but its head.
  /// @throws InputError naming the file if it is missing, cut off or altered; OutputError if the
  /// file system fails.
  [[nodiscard]] Bytes segment(const LogPlace& place, LocalIndex number) const;

  /// @brief Numbers of the folder's files, ascending.
  [[nodiscard]] std::vector<LocalIndex> files() const;

  /// @brief The records of a file that are whole, up to the first that is not: what a writer left
  /// that died. Reads all of them.
  [[nodiscard]] std::vector<LogPlace> find_places(LocalIndex file) const;

 private:
  [[nodiscard]] OpenFile open(LocalIndex file) const;

  std::filesystem::path folder_;
  mutable OpenFiles files_{};
};

/// @brief Removes all such files of a folder. Local. @throws OutputError
void remove_logs(const std::filesystem::path& folder);

}  // namespace tessera::io

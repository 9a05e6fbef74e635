// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "formats/files/shared_file.hpp"

namespace tessera::formats {

/// @brief One array of a file: text or bytes that stand before it, then records of one size.
struct RecordSection {
  std::string head{};
  GlobalIndex num_records = 0;
  GlobalIndex record_size = 0;  ///< Bytes; of text with its line end.
};

/// @brief A file of sections whose records all have their places before any is written, so that
/// ranks write theirs in any order. Text needs fields of fixed width for this.
class RecordFile {
 public:
  /// @param[in] tail What stands behind the last section.
  RecordFile(std::filesystem::path path, std::vector<RecordSection> sections, std::string tail);

  /// @brief Makes the file with all but the records. One rank. @throws OutputError
  void begin();

  /// @brief Writes whole records. Local. @throws OutputError
  void write(std::size_t section, GlobalIndex first_record, std::string_view records);

  void close() { file_.close(); }    ///< As SharedFile::close().
  void commit() { file_.commit(); }  ///< As SharedFile::commit().

 private:
  SharedFile file_;
  std::vector<RecordSection> sections_;
  std::string tail_;
  std::vector<GlobalIndex> first_byte_{};  ///< Shape (num_sections + 1): of records; of the tail.
};

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <csg.hpp>

namespace tessera::netgen {

/// @brief The text of a file. Local. @throws InputError
[[nodiscard]] std::string text_of_file(const std::filesystem::path& file);

/// @brief NETGEN's geometry of the text of a .geo file, with cones, tori and planes described such
/// that NETGEN can mesh them. Local. @throws InputError
[[nodiscard]] std::unique_ptr<::netgen::CSGeometry> parse_csg(const std::string& text,
                                                              const std::string& file_name);

/// @brief Throws GeometryError if no solid is to be meshed. Local.
void require_solid(const ::netgen::CSGeometry& geometry, const std::string& file_name);

/// @brief While it lives it keeps what NETGEN says of statements that it does not know: it skips
/// them, and says so on standard output only.
class SkippedStatements {
 public:
  SkippedStatements() : saved_(std::cout.rdbuf(said_.rdbuf())) {}
  ~SkippedStatements() { std::cout.rdbuf(saved_); }
  SkippedStatements(const SkippedStatements&) = delete;
  SkippedStatements& operator=(const SkippedStatements&) = delete;

  /// @brief One a statement.
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  std::ostringstream said_{};
  std::streambuf* saved_;
};

}  // namespace tessera::netgen

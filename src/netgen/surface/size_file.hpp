// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/mesh/size_points.hpp"

namespace tessera::netgen {

/// @brief Size points as a file in memory that NETGEN's `meshsizefilename` names: its STL mesher
/// takes no others. It lasts as long as the object.
class SizeFile {
 public:
  /// @throws NetgenError if there is no memory for it. Local.
  explicit SizeFile(const mesh::SizePoints& points);
  ~SizeFile();
  SizeFile(const SizeFile&) = delete;
  SizeFile& operator=(const SizeFile&) = delete;

  /// @brief Its name; empty if there are no points.
  [[nodiscard]] std::string path() const;

 private:
  int file_ = -1;
};

}  // namespace tessera::netgen

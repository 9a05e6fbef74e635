// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::formats {

enum class Hdf5Type { float64, int64, int32 };

/// @brief An array of an HDF5 file, of two dimensions but where it says so.
struct Hdf5Array {
  std::string name{};  ///< Path, such as "/geometry/vertices".
  Hdf5Type type = Hdf5Type::float64;
  GlobalIndex num_rows = 0;
  int num_columns = 1;  ///< 0: the array has one dimension.
  std::map<std::string, int> attributes{};
};

/// @brief What an HDF5 file holds.
struct Hdf5Layout {
  std::vector<Hdf5Array> arrays{};
  std::map<std::string, std::vector<std::string>> texts{};  ///< By path: one-dimensional arrays.
};

/// @brief Makes an HDF5 file whose arrays stand in one piece each and have no values yet. Others
/// write these with plain writes: so any number of processes can, with HDF5 in none but the first,
/// and without file locks of MPI-IO. One process.
/// @throws OutputError naming the file.
void make_hdf5_file(const std::filesystem::path& file, const Hdf5Layout& layout);

/// @brief Where the arrays' values begin in the file, by name; of empty ones 0. Local.
/// @throws OutputError naming the file.
[[nodiscard]] std::map<std::string, GlobalIndex> hdf5_offsets(const std::filesystem::path& file,
                                                              const Hdf5Layout& layout);

}  // namespace tessera::formats

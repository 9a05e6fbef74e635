// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief mesh.exo, Exodus II with 64-bit numbers. A material is an element block, a patch a side
/// set and a node set; their ids are the tags. Elements are ordered by block, so their numbers are
/// not those of other formats.
///
/// In netCDF's classic form with 64-bit sizes, which the Exodus library reads as it does HDF5:
/// there every array has its place before any is written, and no serial library is in the way.
[[nodiscard]] std::unique_ptr<Writer> make_exodus_writer(const WriterTarget& target);

}  // namespace tessera::formats

// SPDX-License-Identifier: BSD-3-Clause
// Stands in for the files vtk_*.cpp in a build with TESSERA_WITH_VTK=OFF.
#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "io/vtu/decompress.hpp"
#include "io/vtu/vtu_writers.hpp"

namespace tessera::io {

bool can_compress() { return false; }

void write_compressed_vtu(const mesh::MeshArrays& /*piece*/, const std::filesystem::path& /*path*/,
                          Compression compression)
{
  require_compression(compression);
}

Bytes decompress(const std::string& compressor, const std::vector<CompressedBlock>& /*blocks*/)
{
  throw InputError("its arrays are compressed (" + compressor
                   + "), and this build of tessera has no VTK (it was configured with "
                     "-DTESSERA_WITH_VTK=OFF), which decompresses; write it without compression");
}

std::string vtk_version() { return "none"; }

}  // namespace tessera::io

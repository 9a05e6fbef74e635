// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <fmt/format.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include "tessera/base/error.hpp"

#include "io/vtu/decompress.hpp"
#include "io/vtu/vtk_messages.hpp"

namespace tessera::io {
namespace {

[[nodiscard]] vtkSmartPointer<vtkDataCompressor> make_compressor(const std::string& name)
{
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  if (name == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
  throw InputError(fmt::format("compressor {} is not known", name));
}

/// @brief The sizes that the blocks claim, but at most what the usual compression of meshes would
/// give. More is believed only when the data is there.
[[nodiscard]] std::size_t likely_size(const std::vector<CompressedBlock>& blocks)
{
  constexpr std::size_t kUsualRatio = 16;
  std::size_t likely = 0;
  for (const CompressedBlock& block : blocks) {
    likely += std::min(block.size, kUsualRatio * block.from.size());
  }
  return likely;
}

}  // namespace

Bytes decompress(const std::string& compressor, const std::vector<CompressedBlock>& blocks)
{
  const auto implementation = make_compressor(compressor);
  const VtkMessages messages(*implementation);
  Bytes bytes;
  bytes.reserve(likely_size(blocks));
  for (const CompressedBlock& block : blocks) {
    const std::size_t at = bytes.size();
    bytes.resize(at + block.size);
    const std::size_t size = implementation->Uncompress(
        reinterpret_cast<const unsigned char*>(block.from.data()), block.from.size(),
        reinterpret_cast<unsigned char*>(bytes.data() + at), block.size);
    if (size != block.size) {
      throw InputError("a compressed block is corrupt " + messages.text());
    }
  }
  return bytes;
}

}  // namespace tessera::io

// SPDX-License-Identifier: BSD-3-Clause
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include "tessera/base/error.hpp"

#include "decompress.hpp"
#include "vtk_messages.hpp"

namespace tessera::io {
namespace {

[[nodiscard]] vtkSmartPointer<vtkDataCompressor> make_compressor(const std::string& name)
{
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  if (name == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
  throw InputError("compressor " + name + " is not known");
}

}  // namespace

void decompress(const std::string& compressor, const std::vector<CompressedBlock>& blocks)
{
  const auto implementation = make_compressor(compressor);
  const VtkMessages messages(*implementation);
  for (const CompressedBlock& block : blocks) {
    const std::size_t size = implementation->Uncompress(
        reinterpret_cast<const unsigned char*>(block.from.data()), block.from.size(),
        reinterpret_cast<unsigned char*>(block.to.data()), block.to.size());
    if (size != block.to.size()) {
      throw InputError("a compressed block is corrupt " + messages.text());
    }
  }
}

}  // namespace tessera::io

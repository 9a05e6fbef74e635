// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/surface/size_file.hpp"

#include <fstream>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

namespace tessera::netgen {
namespace {

// NETGEN reads the number of points, the points, and the number of lines.
std::string text_of(const mesh::SizePoints& points)
{
  std::string text = fmt::format("{}\n", points.size.size());
  for (std::size_t i = 0; i < points.size.size(); ++i) {
    text += fmt::format("{} {} {} {}\n", points.xyz[3 * i], points.xyz[3 * i + 1],
                        points.xyz[3 * i + 2], points.size[i]);
  }
  return text + "0\n";
}

}  // namespace

SizeFile::SizeFile(const mesh::SizePoints& points)
{
  if (points.size.empty()) return;
  file_ = memfd_create("tessera_sizes", MFD_CLOEXEC);
  std::ofstream stream(path());
  stream << text_of(points) << std::flush;
  if (stream) return;
  if (file_ >= 0) close(file_);
  throw NetgenError("no memory for the sizes of the coarse mesh");
}

SizeFile::~SizeFile()
{
  if (file_ >= 0) close(file_);
}

std::string SizeFile::path() const
{
  return file_ < 0 ? std::string() : fmt::format("/proc/self/fd/{}", file_);
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/parse.hpp"

#include <fstream>
#include <iterator>
#include <sstream>

#include "tessera/base/error.hpp"

#include "netgen/csg/access.hpp"
#include "netgen/csg/planes.hpp"
#include "netgen/csg/solids.hpp"
#include "netgen/session.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {

using Geometry = ::netgen::CSGeometry;

std::string text_of_file(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in && !in.eof()) throw InputError(file.string() + ": cannot be read");
  return text;
}

std::unique_ptr<Geometry> parse_csg(const std::string& text, const std::string& file_name)
{
  NetgenSession session;
  // At the end of the text NETGEN's scanner repeats the last letter of a name for ever.
  const std::string ended = text + '\n';
  std::unique_ptr<Geometry> geometry;
  try {
    geometry = session.run(file_name, [&] { return read_csg(ended); });
  } catch (const NetgenError& error) {
    throw InputError(error.what());
  }
  if (geometry == nullptr) {
    throw InputError(file_name + ": is not a NETGEN geometry: its first word is not 'algebraic3d'");
  }
  describe_cones_by_circles(*geometry);
  const double tolerance = kIdenticSurfaces * geometry->MaxSize();
  separate_planes(*geometry, tolerance);
  geometry->FindIdenticSurfaces(tolerance);
  return geometry;
}

void require_solid(const Geometry& geometry, const std::string& file_name)
{
  for (int i = 0; i < geometry.GetNTopLevelObjects(); ++i) {
    if (geometry.GetTopLevelObject(i)->GetSurface() == nullptr) return;
  }
  throw GeometryError(file_name + ": no solid is to be meshed; name one with 'tlo NAME;'");
}

std::vector<std::string> SkippedStatements::lines() const
{
  std::vector<std::string> found;
  std::istringstream in(said_.str());
  for (std::string line; std::getline(in, line);) {
    if (line.find("unidentified token") != std::string::npos) {
      found.push_back("NETGEN skipped a word: " + line);
    }
  }
  return found;
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "cad/brep.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>

#include "tessera/base/error.hpp"

namespace tessera::cad {
namespace {

// The table of a text file ends with '*' and an empty line; then comes the root: orientation and
// number of a shape, number of a location. The reader loops for ever on some files that end early.
bool ends_with_root(const std::string& text)
{
  static const std::regex root(R"(\*\s*\n\s*\n[-+ie]\d+ \d+)");
  constexpr std::size_t kTail = 256;
  return std::regex_search(text.substr(text.size() - std::min(text.size(), kTail)), root);
}

// Whether the table of shapes is complete and a solid comes last. Parts come before what is made of
// them, so that one is the whole.
bool ends_with_solid(const std::string& text)
{
  constexpr std::array<std::string_view, 8> kKinds{"Ve", "Ed", "Wi", "Fa", "Sh", "So", "CS", "Co"};
  std::istringstream lines(text);
  int num_missing = 0;
  std::string last_kind;
  std::string last_line;
  for (std::string line; std::getline(lines, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    if (line.starts_with("TShapes ")) num_missing = std::atoi(line.c_str() + 8);
    if (std::ranges::find(kKinds, line) != kKinds.end()) {
      --num_missing;
      last_kind = line;
    }
    last_line = line;
  }
  return num_missing == 0 && last_kind == "So" && last_line.ends_with('*');
}

void read_text(const std::filesystem::path& file, const std::string& text, CadFile& cad)
{
  if (ends_with_root(text)) {
    BRepTools::Read(cad.shape, file.c_str(), BRep_Builder());
    return;
  }
  if (!ends_with_solid(text)) {
    throw InputError(file.string() + ": ends before its root shape, so it is truncated");
  }
  std::istringstream with_root(text + "\n\n+1 0\n");  // The last shape has the number 1.
  BRepTools::Read(cad.shape, with_root, BRep_Builder());
  cad.repairs.emplace_back("the file names no root shape; its last shape, a solid, was taken");
}

}  // namespace

CadFile read_brep(const std::filesystem::path& file)
{
  CadFile cad;
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string_view head = std::string_view(text).substr(0, 200);
  if (head.find("Open CASCADE Topology") != std::string_view::npos) {
    BinTools::Read(cad.shape, file.c_str());
  } else if (head.find("CASCADE Topology") != std::string_view::npos) {
    read_text(file, text, cad);
  }
  if (cad.shape.IsNull()) {
    throw InputError(file.string() + ": OpenCASCADE cannot read it as BREP; export it again");
  }
  return cad;
}

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/common_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <NCollection_IndexedDataMap.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "cad/heal/glue.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

using RowPair = std::array<std::size_t, 2>;

// Each part once, with the rows of the solids that it is of, ascending.
using Owners =
    NCollection_IndexedDataMap<TopoDS_Shape, std::vector<std::size_t>, TopTools_ShapeMapHasher>;

Owners owners_of_parts(const Shapes& solids, const FusedSolids& fused)
{
  Owners owners;
  for (std::size_t row = 0; row < solids.size(); ++row) {
    for (const TopoDS_Shape& part : fused.solids_of(solids[row])) {
      const int at = owners.Add(part, {});
      std::vector<std::size_t>& rows = owners.ChangeFromIndex(at);
      if (rows.empty() || rows.back() != row) rows.push_back(row);
    }
  }
  return owners;
}

struct Common {
  double volume = 0.0;
  Bnd_Box box{};
};

void add(const TopoDS_Shape& part, const std::vector<std::size_t>& rows,
         std::map<RowPair, Common>& pairs)
{
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      Common& common = pairs[{rows[i], rows[j]}];
      common.volume += std::abs(volume_of(part));
      BRepBndLib::AddOptimal(part, common.box, Standard_False, Standard_False);
    }
  }
}

// Whether the solid at `row` loses to the one at `other` what they have in common.
bool loses(std::size_t row, std::size_t other, model::Overlap rule)
{
  return rule == model::Overlap::first ? other < row : other > row;
}

Shapes cut_off(const TopoDS_Shape& solid, const Shapes& others, CadFile& cad)
{
  TopTools_ListOfShape arguments;
  TopTools_ListOfShape tools;
  arguments.Append(solid);
  for (const TopoDS_Shape& other : others) tools.Append(other);
  BRepAlgoAPI_Cut cut;
  cut.SetArguments(arguments);
  cut.SetTools(tools);
  cut.SetNonDestructive(Standard_True);
  cut.SetRunParallel(Standard_False);
  cut.Build();
  if (cut.HasErrors()) {
    throw GeometryError(
        "OpenCASCADE cannot take from a solid what it has in common with another one; do so in the "
        "CAD program");
  }
  const Shapes rest = parts_of(cut.Shape(), TopAbs_SOLID);
  follow_names(solid, cad.names, [&](const TopoDS_Shape& part) {
    if (!part.IsSame(solid)) return cut.Modified(part);
    TopTools_ListOfShape images;
    for (const TopoDS_Shape& image : rest) images.Append(image);
    return images;
  });
  return rest;
}

}  // namespace

model::SolidPair pair_of(const Shapes& solids, std::size_t one, std::size_t other,
                         const ShapeNames& names)
{
  model::SolidPair pair;
  const auto [low, high] = std::minmax(one, other);
  pair.numbers = {static_cast<LocalIndex>(low) + 1, static_cast<LocalIndex>(high) + 1};
  pair.names = {label_in(names, solids[low]).name, label_in(names, solids[high]).name};
  return pair;
}

std::vector<model::CommonPart> common_parts(const Shapes& solids, const FusedSolids& fused,
                                            double thinnest, const ShapeNames& names)
{
  std::map<RowPair, Common> pairs;
  const Owners owners = owners_of_parts(solids, fused);
  for (int i = 1; i <= owners.Extent(); ++i) {
    const std::vector<std::size_t>& rows = owners(i);
    if (rows.size() > 1 && !is_film(owners.FindKey(i), thinnest)) {
      add(owners.FindKey(i), rows, pairs);
    }
  }
  std::vector<model::CommonPart> parts;
  for (const auto& [rows, common] : pairs) {
    parts.push_back({.solids = pair_of(solids, rows[0], rows[1], names),
                     .volume = common.volume,
                     .low = from_occ(common.box.CornerMin()),
                     .high = from_occ(common.box.CornerMax())});
  }
  return parts;
}

Shapes without_common_parts(const Shapes& solids, const std::vector<model::CommonPart>& parts,
                            model::Overlap rule, CadFile& cad)
{
  Shapes kept;
  for (std::size_t row = 0; row < solids.size(); ++row) {
    Shapes winners;
    for (const model::CommonPart& part : parts) {
      const auto [low, high] = part.solids.numbers;
      const auto a = static_cast<std::size_t>(low) - 1;
      const auto b = static_cast<std::size_t>(high) - 1;
      if (row != a && row != b) continue;
      const std::size_t other = row == a ? b : a;
      if (loses(row, other, rule)) winners.push_back(solids[other]);
    }
    const Shapes rest = winners.empty() ? Shapes{solids[row]} : cut_off(solids[row], winners, cad);
    if (rest.empty()) {
      cad.repairs.push_back(fmt::format(
          "solid {} was given to others as a whole, as they have all of it in common", row + 1));
    }
    kept.insert(kept.end(), rest.begin(), rest.end());
  }
  return kept;
}

}  // namespace tessera::cad

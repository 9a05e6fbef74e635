// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/flaps.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <fmt/format.h>

#include "tessera/base/repair.hpp"

#include "cad/heal/fuse.hpp"
#include "cad/heal/glue.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

// Faces that a solid has forwards and reversed.
TopTools_MapOfShape flaps_of(const TopoDS_Shape& solid)
{
  TopTools_MapOfShape seen;
  TopTools_MapOfShape flaps;
  for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next()) {
    if (!seen.Add(faces.Current())) flaps.Add(faces.Current());
  }
  return flaps;
}

TopoDS_Shape shell_without(const TopTools_MapOfShape& flaps, const TopoDS_Shape& shell)
{
  TopoDS_Shell kept;
  BRep_Builder().MakeShell(kept);
  const TopoDS_Shape upright = shell.Oriented(TopAbs_FORWARD);
  for (TopExp_Explorer faces(upright, TopAbs_FACE); faces.More(); faces.Next()) {
    if (!flaps.Contains(faces.Current())) BRep_Builder().Add(kept, faces.Current());
  }
  kept.Closed(BRep_Tool::IsClosed(kept));
  return kept.Oriented(shell.Orientation());
}

// Null if it is no valid solid then.
TopoDS_Shape solid_without(const TopTools_MapOfShape& flaps, const TopoDS_Shape& solid)
{
  TopoDS_Solid kept;
  BRep_Builder().MakeSolid(kept);
  const TopoDS_Shape upright = solid.Oriented(TopAbs_FORWARD);
  for (TopExp_Explorer shells(upright, TopAbs_SHELL); shells.More(); shells.Next()) {
    const TopoDS_Shape shell = shell_without(flaps, shells.Current());
    if (count_of(shell, TopAbs_FACE) > 0) BRep_Builder().Add(kept, shell);
  }
  const TopoDS_Shape result = kept.Oriented(solid.Orientation());
  return is_closed(result) && BRepCheck_Analyzer(result).IsValid() ? result : TopoDS_Shape();
}

}  // namespace

TopoDS_Shape without_flaps(const TopoDS_Shape& fused, CadFile& cad)
{
  if (is_left_out(Repair::flaps)) return fused;
  int num_flaps = 0;
  Shapes solids;
  for (const TopoDS_Shape& solid : parts_of(fused, TopAbs_SOLID)) {
    const TopTools_MapOfShape flaps = flaps_of(solid);
    const TopoDS_Shape kept = flaps.IsEmpty() ? solid : solid_without(flaps, solid);
    solids.push_back(kept.IsNull() ? solid : kept);
    if (kept.IsNull() || flaps.IsEmpty()) continue;
    num_flaps += flaps.Extent();
    follow_names(solid, cad.names, [&](const TopoDS_Shape& part) {
      TopTools_ListOfShape images;
      if (part.IsSame(solid)) images.Append(kept);
      return images;
    });
  }
  if (num_flaps == 0) return fused;
  note_repair(Repair::flaps, num_flaps);
  cad.repairs.push_back(fmt::format(
      "{} faces bounded a solid from both sides, and so nothing: they were taken away", num_flaps));
  return compound_of(solids);
}

}  // namespace tessera::cad

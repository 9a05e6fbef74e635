// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/glue.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"

#include "cad/heal/common_parts.hpp"
#include "cad/heal/flaps.hpp"
#include "cad/heal/gaps.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

bool any_boxes_touch(const Shapes& solids, double gap)
{
  std::vector<Bnd_Box> boxes;
  for (const TopoDS_Shape& solid : solids) {
    Bnd_Box box;
    BRepBndLib::Add(solid, box, Standard_False);
    box.Enlarge(gap);
    for (const Bnd_Box& other : boxes) {
      if (!box.IsOut(other)) return true;
    }
    boxes.push_back(box);
  }
  return false;
}

struct CommonFaces {
  std::size_t number = 0;
  double area = 0.0;
  double tolerance = 0.0;  // The largest of a face, an edge or a vertex.
};

CommonFaces common_faces_of(const TopoDS_Shape& shape)
{
  TopTools_IndexedDataMapOfShapeListOfShape solids_of_face;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_FACE, TopAbs_SOLID, solids_of_face);
  CommonFaces common;
  for (int f = 1; f <= solids_of_face.Extent(); ++f) {
    if (solids_of_face(f).Extent() < 2) continue;
    const TopoDS_Shape& face = solids_of_face.FindKey(f);
    constexpr int kLargest = 1;
    ++common.number;
    common.area += area_of(face);
    common.tolerance =
        std::max(common.tolerance, ShapeAnalysis_ShapeTolerance().Tolerance(face, kLargest));
  }
  return common;
}

// Many lines help nobody.
template <class Found>
std::string list_of(const std::vector<Found>& found)
{
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(found.size(), kMost); ++i) {
    text += (i == 0 ? "" : "; ") + words_of(found[i]);
  }
  if (found.size() > kMost) text += fmt::format("; and {} more pairs", found.size() - kMost);
  return text;
}

[[noreturn]] void fail_on_overlaps(const std::vector<model::CommonPart>& overlaps)
{
  throw GeometryError(
      fmt::format("solids overlap: {}; set geometry.overlap to \"first\" or \"last\" to give it to "
                  "the solid with the lower or the higher number, or to \"cut\" to make it a solid "
                  "of its own, or move them apart in the CAD program",
                  list_of(overlaps)));
}

class Gluing {
 public:
  Gluing(const Shapes& solids, const model::AssemblyOptions& options, CadFile& cad)
      : solids_(solids), options_(options), cad_(cad), apart_(compound_of(solids))
  {
    const double diagonal = box_diagonal_of(apart_);
    thinnest_ = options.gap < 0.0 ? model::kThinnest * diagonal : options.gap;
  }

  TopoDS_Shape run()
  {
    if (!any_boxes_touch(solids_, thinnest_)) return apart_;
    std::optional<FusedSolids> fused;
    if (!is_left_out(Repair::glued_solids)) {
      fused = fuse_at_faces(solids_, {.thinnest = thinnest_});
    }
    if (!fused) {
      cad_.repairs.emplace_back("solids that may touch could not be glued");
      cad_.may_overlap = true;
      return apart_;
    }
    cad_.assembly.overlaps = common_parts(solids_, *fused, thinnest_, cad_.names);
    if (!cad_.assembly.overlaps.empty() && options_.overlap != model::Overlap::cut) {
      return without_overlaps();
    }
    cad_.assembly.gaps = close_gaps(solids_, thinnest_, cad_.names, *fused);
    tell(*fused);
    return result_of(*fused);
  }

 private:
  // Gives common parts to one of the solids, and glues what is left.
  TopoDS_Shape without_overlaps()
  {
    std::vector<model::CommonPart> overlaps = std::move(cad_.assembly.overlaps);
    if (options_.overlap == model::Overlap::error) fail_on_overlaps(overlaps);
    const Shapes kept = without_common_parts(solids_, overlaps, options_.overlap, cad_);
    cad_.repairs.push_back(fmt::format("solids overlapped, and the {} one has what was common: {}",
                                       word_of(options_.overlap), list_of(overlaps)));
    model::AssemblyOptions strict = options_;
    strict.overlap = model::Overlap::error;
    TopoDS_Shape shape = kept.size() == 1 ? kept.front() : glued(kept, strict, cad_);
    cad_.assembly.overlaps = std::move(overlaps);
    return shape;
  }

  void tell(const FusedSolids& fused)
  {
    if (const int num_failed = fused.num_failed_pairs(); num_failed > 0) {
      cad_.repairs.push_back(fmt::format(
          "OpenCASCADE could not intersect {} pairs of faces of different solids, which "
          "may overlap there",
          num_failed));
    }
    if (fused.num_bare_contacts > 0) {
      cad_.repairs.emplace_back(fmt::format(
          "solids touch without a common face, and were left as they are there: {} pairs",
          fused.num_bare_contacts));
    }
    if (!cad_.assembly.gaps.empty()) {
      cad_.repairs.push_back(
          fmt::format("gaps between solids were closed: {}", list_of(cad_.assembly.gaps)));
    }
  }

  TopoDS_Shape result_of(const FusedSolids& fused)
  {
    const int num_given = count_of(apart_, TopAbs_SOLID);
    const int num_solids = count_of(fused.shape, TopAbs_SOLID);
    const CommonFaces common = common_faces_of(fused.shape);
    cad_.assembly.tolerance = common.tolerance;
    if (num_solids == num_given && common.number == common_faces_of(apart_).number) return apart_;
    follow_names(apart_, cad_.names,
                 [&](const TopoDS_Shape& part) { return fused.images_of(part); });
    note_repair(Repair::glued_solids);
    cad_.repairs.emplace_back(fmt::format(
        "touching solids were glued: {} shared faces of area {:.6g}, with a tolerance of "
        "{:.2g}",
        common.number, common.area, common.tolerance));
    if (num_solids != num_given) {
      cad_.repairs.emplace_back(
          fmt::format("overlapping solids were cut: {} became {}", num_given, num_solids));
    }
    return without_flaps(fused.shape, cad_);
  }

  const Shapes& solids_;
  const model::AssemblyOptions& options_;
  CadFile& cad_;
  TopoDS_Compound apart_;
  double thinnest_ = 0.0;
};

}  // namespace

void follow_names(const TopoDS_Shape& shape, ShapeNames& names,
                  const std::function<TopTools_ListOfShape(const TopoDS_Shape&)>& images_of)
{
  for (const TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_FACE, TopAbs_EDGE}) {
    for (const TopoDS_Shape& part : parts_of(shape, kind)) {
      if (!names.IsBound(part)) continue;
      const ShapeLabel label = names.Find(part);
      for (const TopoDS_Shape& image : images_of(part)) {
        if (image.IsNull() || names.IsBound(image)) continue;
        names.Bind(image, label);
      }
    }
  }
}

TopoDS_Shape glued(const Shapes& solids, const model::AssemblyOptions& options, CadFile& cad)
{
  return Gluing(solids, options, cad).run();
}

}  // namespace tessera::cad

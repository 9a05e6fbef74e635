// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_glue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <fmt/format.h>

#include "tessera/base/repair.hpp"
#include "tessera/base/union_find.hpp"

#include "netgen/occ_shape.hpp"

namespace tessera::netgen {
namespace {

// Gaps and overlaps that count as touching, in fractions of the box diagonal: what OpenCASCADE
// takes by itself; wider ones only where solids would be cut into films.
constexpr std::array<double, 4> kGlueGaps{0.0, 1e-7, 1e-6, 1e-5};

Bnd_Box box_of(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  return box;
}

bool any_boxes_touch(const std::vector<TopoDS_Shape>& solids)
{
  std::vector<Bnd_Box> boxes;
  for (const TopoDS_Shape& solid : solids) {
    const Bnd_Box box = box_of(solid);
    for (const Bnd_Box& other : boxes) {
      if (!box.IsOut(other)) return true;
    }
    boxes.push_back(box);
  }
  return false;
}

TopoDS_Compound compound_of(const std::vector<TopoDS_Shape>& solids)
{
  TopoDS_Compound compound;
  BRep_Builder().MakeCompound(compound);
  for (const TopoDS_Shape& solid : solids) BRep_Builder().Add(compound, solid);
  return compound;
}

int count_solids(const TopoDS_Shape& shape)
{
  return static_cast<int>(parts_of(shape, TopAbs_SOLID).size());
}

int count_shared_faces(const TopoDS_Shape& shape)
{
  TopTools_IndexedDataMapOfShapeListOfShape solids_of_face;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_FACE, TopAbs_SOLID, solids_of_face);
  int num_shared = 0;
  for (const TopTools_ListOfShape& solids : solids_of_face) num_shared += solids.Extent() > 1;
  return num_shared;
}

// Thinner is no more than the rounding between faces or edges that were meant to be one; of the
// diagonal.
constexpr double kThinnest = 1e-6;

bool is_film(const TopoDS_Shape& solid, double diagonal)
{
  return 2.0 * std::abs(volume_of(solid)) < kThinnest * diagonal * area_of(solid);
}

bool is_strip(const TopoDS_Shape& face, double diagonal)
{
  GProp_GProps edges;
  BRepGProp::LinearProperties(face, edges);
  return 2.0 * area_of(face) < kThinnest * diagonal * edges.Mass();
}

// Whether solids were cut where they overlap by next to nothing.
bool left_films(const TopoDS_Shape& fused, int num_given, double diagonal)
{
  const std::vector<TopoDS_Shape> solids = parts_of(fused, TopAbs_SOLID);
  return static_cast<int>(solids.size()) > num_given
         && std::ranges::any_of(
             solids, [&](const TopoDS_Shape& solid) { return is_film(solid, diagonal); });
}

using Fuse = BRepAlgoAPI_BuilderAlgo;

// What lies closer than `gap` counts as touching.
std::unique_ptr<Fuse> fuse_solids(const std::vector<TopoDS_Shape>& solids, double gap)
{
  TopTools_ListOfShape arguments;
  for (const TopoDS_Shape& solid : solids) arguments.Append(solid);
  auto fuse = std::make_unique<Fuse>();
  fuse->SetArguments(arguments);
  fuse->SetNonDestructive(Standard_True);
  fuse->SetRunParallel(Standard_False);
  fuse->SetFuzzyValue(gap);
  fuse->Build();
  return fuse;
}

// With the least gap that leaves no films; null if that fails.
std::unique_ptr<Fuse> fuse_without_films(const std::vector<TopoDS_Shape>& solids, double diagonal)
{
  const int num_given = count_solids(compound_of(solids));
  std::unique_ptr<Fuse> fuse;
  for (const double gap : kGlueGaps) {
    fuse = fuse_solids(solids, gap * diagonal);
    if (gap > 0.0) note_repair(Repair::wider_glue_gap);
    if (fuse->HasErrors() || !left_films(fuse->Shape(), num_given, diagonal)
        || is_left_out(Repair::wider_glue_gap)) {
      break;
    }
  }
  const bool is_whole = !fuse->HasErrors() && count_solids(fuse->Shape()) >= num_given;
  return is_whole ? std::move(fuse) : nullptr;
}

// What became of one of the solids.
std::vector<TopoDS_Shape> images_of(const TopoDS_Shape& solid, Fuse& fuse)
{
  const TopTools_ListOfShape& images = fuse.Modified(solid);
  if (images.IsEmpty()) return {solid};
  return {images.begin(), images.end()};
}

// Which solid was the first to come with a part.
class PartOwners {
 public:
  std::size_t first_with(const TopoDS_Shape& part, std::size_t solid)
  {
    if (const std::size_t* const first = owner_.Seek(part)) return *first;
    owner_.Bind(part, solid);
    return solid;
  }

 private:
  NCollection_DataMap<TopoDS_Shape, std::size_t, TopTools_ShapeMapHasher> owner_{};
};

// The lowest number of the solids with which each hangs together by common faces or parts.
std::vector<std::size_t> groups_of(const std::vector<TopoDS_Shape>& solids, Fuse& fuse,
                                   double diagonal)
{
  UnionFind groups(static_cast<LocalIndex>(solids.size()));
  PartOwners owners;
  const auto join = [&](const TopoDS_Shape& part, std::size_t solid) {
    const std::size_t first = owners.first_with(part, solid);
    groups.join(static_cast<LocalIndex>(first), static_cast<LocalIndex>(solid));
  };
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (const TopoDS_Shape& image : images_of(solids[i], fuse)) {
      join(image, i);
      for (const TopoDS_Shape& face : parts_of(image, TopAbs_FACE)) {
        if (!is_strip(face, diagonal)) join(face, i);
      }
    }
  }
  std::vector<std::size_t> group;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    group.push_back(static_cast<std::size_t>(groups.find(static_cast<LocalIndex>(i))));
  }
  return group;
}

// Solids of different groups that have edges or vertices in common.
std::size_t count_bare_contacts(const std::vector<TopoDS_Shape>& solids,
                                const std::vector<std::size_t>& group, Fuse& fuse)
{
  std::set<std::array<std::size_t, 2>> pairs;
  PartOwners owners;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (const TopoDS_Shape& image : images_of(solids[i], fuse)) {
      for (const TopAbs_ShapeEnum kind : {TopAbs_EDGE, TopAbs_VERTEX}) {
        for (const TopoDS_Shape& part : parts_of(image, kind)) {
          const std::size_t first = owners.first_with(part, i);
          if (group[first] != group[i]) pairs.insert({first, i});
        }
      }
    }
  }
  return pairs.size();
}

// The solids after gluing, in the order of those given, and what became of them.
struct Glued {
  std::vector<std::unique_ptr<Fuse>> fuses{};
  TopoDS_Shape shape{};
  std::size_t num_bare_contacts = 0;  // Pairs that touch, but not along faces: not glued there.

  [[nodiscard]] TopTools_ListOfShape images_of(const TopoDS_Shape& part) const
  {
    TopTools_ListOfShape all;
    for (const auto& fuse : fuses) {
      for (const TopoDS_Shape& image : fuse->Modified(part)) all.Append(image);
    }
    return all;
  }
};

// Each group by itself. Where solids of two groups touch, along a curve or in a point, each keeps
// its faces whole: where they are tangent, rounding leaves but pieces of the common curve.
std::optional<Glued> glued_by_groups(const std::vector<TopoDS_Shape>& solids,
                                     const std::vector<std::size_t>& group, double diagonal)
{
  Glued result;
  for (std::size_t first = 0; first < solids.size(); ++first) {
    std::vector<TopoDS_Shape> members;
    for (std::size_t i = first; i < solids.size(); ++i) {
      if (group[i] == first) members.push_back(solids[i]);
    }
    if (members.size() < 2) continue;
    auto fuse = fuse_without_films(members, diagonal);
    if (fuse == nullptr) return std::nullopt;
    result.fuses.push_back(std::move(fuse));
  }
  TopTools_MapOfShape added;
  std::vector<TopoDS_Shape> parts;
  for (const TopoDS_Shape& solid : solids) {
    TopTools_ListOfShape images = result.images_of(solid);
    if (images.IsEmpty()) images.Append(solid);
    for (const TopoDS_Shape& image : images) {
      if (added.Add(image)) parts.push_back(image);
    }
  }
  result.shape = compound_of(parts);
  return result;
}

// Nothing if that fails.
std::optional<Glued> glue_at_faces(const std::vector<TopoDS_Shape>& solids, double diagonal)
{
  auto all = fuse_without_films(solids, diagonal);
  if (all == nullptr) return std::nullopt;
  const std::vector<std::size_t> group = groups_of(solids, *all, diagonal);
  const std::size_t num_bare_contacts = count_bare_contacts(solids, group, *all);
  if (num_bare_contacts > 0) {
    if (auto result = glued_by_groups(solids, group, diagonal)) {
      result->num_bare_contacts = num_bare_contacts;
      return result;
    }
  }
  Glued whole;
  whole.shape = all->Shape();
  whole.fuses.push_back(std::move(all));
  return whole;
}

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

TopoDS_Shape glued(const std::vector<TopoDS_Shape>& solids, CadFile& cad)
{
  const TopoDS_Compound apart = compound_of(solids);
  if (!any_boxes_touch(solids)) return apart;
  const int num_given = count_solids(apart);
  std::optional<Glued> result;
  if (!is_left_out(Repair::glued_solids)) result = glue_at_faces(solids, box_diagonal_of(apart));
  if (!result) {
    cad.repairs.emplace_back("solids that may touch could not be glued");
    cad.may_overlap = true;
    return apart;
  }
  const int num_solids = count_solids(result->shape);
  const int num_shared = count_shared_faces(result->shape);
  if (result->num_bare_contacts > 0) {
    cad.repairs.emplace_back(
        fmt::format("solids touch without a common face, and were left as they are there: {} pairs",
                    result->num_bare_contacts));
  }
  if (num_solids == num_given && num_shared == count_shared_faces(apart)) return apart;
  follow_names(apart, cad.names, [&](const TopoDS_Shape& part) { return result->images_of(part); });
  note_repair(Repair::glued_solids);
  cad.repairs.emplace_back(fmt::format("touching solids were glued: {} shared faces", num_shared));
  if (num_solids != num_given) {
    cad.repairs.emplace_back(
        fmt::format("overlapping solids were cut: {} became {}", num_given, num_solids));
  }
  return result->shape;
}

}  // namespace tessera::netgen

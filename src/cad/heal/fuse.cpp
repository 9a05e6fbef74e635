// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/fuse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <BOPAlgo_Alerts.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <Message_Report.hxx>
#include <TopTools_MapOfShape.hxx>

#include "tessera/base/repair.hpp"
#include "tessera/base/union_find.hpp"

#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

using Fuse = BRepAlgoAPI_BuilderAlgo;

// Gaps and overlaps that count as touching, in thinnest ones: what OpenCASCADE takes by itself;
// wider ones only where solids would be cut into films, or gaps are to be closed.
constexpr std::array<double, 4> kFuseGaps{0.0, 0.1, 1.0, 10.0};

// Whether solids were cut where they overlap by next to nothing.
bool left_films(const TopoDS_Shape& fused, int num_given, double thinnest)
{
  const Shapes solids = parts_of(fused, TopAbs_SOLID);
  return static_cast<int>(solids.size()) > num_given
         && std::ranges::any_of(
             solids, [&](const TopoDS_Shape& solid) { return is_film(solid, thinnest); });
}

// What lies closer than `gap` counts as touching.
std::unique_ptr<Fuse> fuse_solids(const Shapes& solids, double gap)
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

// Whether nothing was lost. Fewer solids than were given are right if some are the same.
bool keeps_all(const Shapes& solids, Fuse& fuse)
{
  if (count_of(fuse.Shape(), TopAbs_SOLID) >= count_of(compound_of(solids), TopAbs_SOLID)) {
    return true;
  }
  constexpr double kLoss = 1e-3;
  return std::ranges::all_of(solids, [&](const TopoDS_Shape& solid) {
    double volume = 0.0;
    for (const TopoDS_Shape& image : images_of(solid, fuse)) volume += std::abs(volume_of(image));
    return !fuse.IsDeleted(solid) && volume > (1.0 - kLoss) * std::abs(volume_of(solid));
  });
}

// With the least gap that leaves no films; null if that fails.
std::unique_ptr<Fuse> fuse_without_films(const Shapes& solids, const Nearness& nearness)
{
  const int num_given = count_of(compound_of(solids), TopAbs_SOLID);
  std::unique_ptr<Fuse> fuse;
  for (const double gap : kFuseGaps) {
    if (nearness.closes_gaps && gap < 1.0) continue;
    fuse = fuse_solids(solids, gap * nearness.thinnest);
    const bool is_wider = gap > (nearness.closes_gaps ? 1.0 : 0.0);
    if (is_wider) note_repair(Repair::wider_glue_gap);
    if (fuse->HasErrors() || !left_films(fuse->Shape(), num_given, nearness.thinnest)
        || is_left_out(Repair::wider_glue_gap)) {
      break;
    }
  }
  const bool is_whole = !fuse->HasErrors() && keeps_all(solids, *fuse);
  return is_whole ? std::move(fuse) : nullptr;
}

// The lowest number of the solids with which each hangs together by common faces or parts.
std::vector<std::size_t> groups_of(const Shapes& solids, Fuse& fuse, double thinnest)
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
        if (!is_strip(face, thinnest)) join(face, i);
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
std::size_t count_bare_contacts(const Shapes& solids, const std::vector<std::size_t>& group,
                                Fuse& fuse)
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

// Each group by itself. Where solids of two groups touch, along a curve or in a point, each keeps
// its faces whole: where they are tangent, rounding leaves but pieces of the common curve.
std::optional<FusedSolids> fused_by_groups(const Shapes& solids,
                                           const std::vector<std::size_t>& group,
                                           const Nearness& nearness)
{
  FusedSolids result;
  for (std::size_t first = 0; first < solids.size(); ++first) {
    Shapes members;
    for (std::size_t i = first; i < solids.size(); ++i) {
      if (group[i] == first) members.push_back(solids[i]);
    }
    if (members.size() < 2) continue;
    auto fuse = fuse_without_films(members, nearness);
    if (fuse == nullptr) return std::nullopt;
    result.fuses.push_back(std::move(fuse));
  }
  TopTools_MapOfShape added;
  Shapes parts;
  for (const TopoDS_Shape& solid : solids) {
    for (const TopoDS_Shape& image : result.solids_of(solid)) {
      if (added.Add(image)) parts.push_back(image);
    }
  }
  result.shape = compound_of(parts);
  return result;
}

}  // namespace

Shapes images_of(const TopoDS_Shape& part, BRepAlgoAPI_BuilderAlgo& fuse)
{
  const TopTools_ListOfShape& images = fuse.Modified(part);
  if (images.IsEmpty()) return {part};
  return {images.begin(), images.end()};
}

std::size_t PartOwners::first_with(const TopoDS_Shape& part, std::size_t solid)
{
  if (const std::size_t* const first = owner_.Seek(part)) return *first;
  owner_.Bind(part, solid);
  return solid;
}

TopTools_ListOfShape FusedSolids::images_of(const TopoDS_Shape& part) const
{
  TopTools_ListOfShape all;
  for (const auto& fuse : fuses) {
    for (const TopoDS_Shape& image : fuse->Modified(part)) all.Append(image);
  }
  return all;
}

Shapes FusedSolids::solids_of(const TopoDS_Shape& given) const
{
  const TopTools_ListOfShape images = images_of(given);
  if (images.IsEmpty()) return {given};
  return {images.begin(), images.end()};
}

int FusedSolids::num_failed_pairs() const
{
  int number = 0;
  for (const auto& fuse : fuses) {
    for (const Handle(Message_Alert) & alert : fuse->GetReport()->GetAlerts(Message_Warning)) {
      number += alert->IsKind(STANDARD_TYPE(BOPAlgo_AlertIntersectionOfPairOfShapesFailed));
    }
  }
  return number;
}

std::optional<FusedSolids> fuse_at_faces(const Shapes& solids, const Nearness& nearness)
{
  auto all = fuse_without_films(solids, nearness);
  if (all == nullptr) return std::nullopt;
  const std::vector<std::size_t> group = groups_of(solids, *all, nearness.thinnest);
  const std::size_t num_bare_contacts = count_bare_contacts(solids, group, *all);
  if (num_bare_contacts > 0) {
    if (auto result = fused_by_groups(solids, group, nearness)) {
      result->num_bare_contacts = num_bare_contacts;
      return result;
    }
  }
  FusedSolids whole;
  whole.shape = all->Shape();
  whole.fuses.push_back(std::move(all));
  return whole;
}

TopoDS_Compound compound_of(const Shapes& solids)
{
  TopoDS_Compound compound;
  BRep_Builder().MakeCompound(compound);
  for (const TopoDS_Shape& solid : solids) BRep_Builder().Add(compound, solid);
  return compound;
}

bool is_film(const TopoDS_Shape& solid, double thinnest)
{
  return 2.0 * std::abs(volume_of(solid)) < thinnest * area_of(solid);
}

bool is_strip(const TopoDS_Shape& face, double thinnest)
{
  GProp_GProps edges;
  BRepGProp::LinearProperties(face, edges);
  return 2.0 * area_of(face) < thinnest * edges.Mass();
}

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg_cut.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "netgen/csg_access.hpp"
#include "netgen/netgen_session.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;
using ::netgen::Solid;
using ::netgen::TopLevelObject;

class Cutter {
 public:
  Cutter(Geometry& geometry, const cut::CutTree& tree) : geometry_(geometry), tree_(tree)
  {
    cut_.num_surfaces = geometry.GetNSurf();
  }

  CutObjects run()
  {
    const std::vector<TopLevelObject> uncut = take_objects();
    for (std::size_t i = 0; i < uncut.size(); ++i) {
      object_ = &uncut[i];
      number_ = static_cast<LocalIndex>(i);
      Solid* const solid = const_cast<Solid*>(object_->GetSolid());
      if (object_->GetSurface() == nullptr) {
        add_parts(tree_.solid_root.at(i), solid);
      } else {
        add_object(solid, kNoIndex);
      }
    }
    repeat_modifications();
    geometry_.FindIdenticSurfaces(kIdenticSurfaces * geometry_.MaxSize());
    return std::move(cut_);
  }

 private:
  // From the end: NETGEN moves the last one to the place of the one that goes.
  std::vector<TopLevelObject> take_objects()
  {
    std::vector<TopLevelObject> objects;
    for (int i = 0; i < geometry_.GetNTopLevelObjects(); ++i) {
      objects.push_back(*geometry_.GetTopLevelObject(i));
    }
    for (auto last = objects.rbegin(); last != objects.rend(); ++last) {
      geometry_.RemoveTopLevelObject(last->GetSolid(), last->GetSurface());
    }
    return objects;
  }

  // `solid` has a name: only such may be operands of several solids.
  void add_parts(LocalIndex row, Solid* solid)
  {
    const cut::CutNode& node = tree_.nodes.at(at(row));
    if (node.part != kNoIndex) return add_object(solid, node.part);
    Solid* const below = half_space(row);
    add_parts(node.below, named(new Solid(Solid::SECTION, solid, below)));
    add_parts(node.above, named(new Solid(Solid::SECTION, solid, new Solid(Solid::SUB, below))));
  }

  Solid* half_space(LocalIndex row)
  {
    const cut::Plane& plane = tree_.nodes.at(at(row)).plane;
    const Vec3 point = plane.offset * plane.normal;
    auto* const primitive = new ::netgen::Plane(
        to_netgen(point), ::netgen::Vec<3>(plane.normal[0], plane.normal[1], plane.normal[2]));
    geometry_.AddSurfaces(primitive);
    return named(new Solid(primitive));
  }

  // The geometry owns it.
  Solid* named(Solid* solid)
  {
    auto* const root = new Solid(Solid::ROOT, solid);
    geometry_.SetSolid(fmt::format("tessera cut {}", num_named_++).c_str(), root);
    root->SetMaxH(object_->GetSolid()->GetMaxH());
    return root;
  }

  void add_object(Solid* solid, LocalIndex part)
  {
    auto* const surface = const_cast<::netgen::Surface*>(object_->GetSurface());
    const int row = geometry_.SetTopLevelObject(solid, surface);
    TopLevelObject& added = *geometry_.GetTopLevelObject(row);
    added.SetMaxH(object_->GetMaxH());
    added.SetMaterial(object_->GetMaterial());
    added.SetLayer(object_->GetLayer());
    added.SetBCProp(object_->GetBCProp());
    added.SetBCName(object_->GetBCName());
    cut_.solid.push_back(number_);
    cut_.part.push_back(part);
  }

  // Boundary conditions of a surface where it bounds one solid. NETGEN deletes each name once.
  void repeat_modifications()
  {
    std::vector<Geometry::BCModification> uncut;
    for (const Geometry::BCModification& old : geometry_.bcmodifications) uncut.push_back(old);
    geometry_.bcmodifications.SetSize(0);
    for (const Geometry::BCModification& old : uncut) {
      for (std::size_t i = 0; i < cut_.solid.size(); ++i) {
        if (cut_.solid[i] != old.tlonr) continue;
        Geometry::BCModification modified = old;
        modified.tlonr = static_cast<int>(i);
        modified.bcname = old.bcname == nullptr ? nullptr : new std::string(*old.bcname);
        geometry_.bcmodifications.Append(modified);
      }
      delete old.bcname;
    }
  }

  Geometry& geometry_;
  const cut::CutTree& tree_;
  const TopLevelObject* object_ = nullptr;
  LocalIndex number_ = 0;
  int num_named_ = 0;
  CutObjects cut_{};
};

void require_cuttable(const Geometry& geometry)
{
  if (is_numbered(geometry)) {
    throw NetgenError(
        "a geometry with identified faces, or with singular faces, edges or points, "
        "cannot be cut");
  }
}

}  // namespace

CutObjects cut_geometry(Geometry& geometry, const cut::CutTree& tree)
{
  require_cuttable(geometry);
  return Cutter(geometry, tree).run();
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg_cut.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/union_find.hpp"

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

FaceOrder::FaceOrder(Geometry& uncut, ::netgen::MeshingParameters parameters)
{
  parameters.perfstepsend = ::netgen::MESHCONST_MESHEDGES;
  parameters.uselocalh = 0;  // Sizes do not matter, and without them edges are meshed only once.
  std::shared_ptr<::netgen::Mesh> mesh;
  if (uncut.GenerateMesh(mesh, parameters) != 0) throw NetgenError("no edges of the uncut model");
  for (int d = 1; d <= mesh->GetNFD(); ++d) {
    const ::netgen::FaceDescriptor& face = mesh->GetFaceDescriptor(d);
    rows_.emplace(Key{face.SurfNr(), face.DomainIn(), face.DomainOut(), face.TLOSurface()},
                  static_cast<LocalIndex>(rows_.size()));
  }
}

LocalIndex FaceOrder::row_of(const ::netgen::FaceDescriptor& face, const CutObjects& objects)
{
  const auto uncut = [&](int number) {
    return number <= 0 ? number : objects.solid.at(at(number - 1)) + 1;
  };
  const Key key{face.SurfNr(), uncut(face.DomainIn()), uncut(face.DomainOut()),
                uncut(face.TLOSurface())};
  return rows_.emplace(key, static_cast<LocalIndex>(rows_.size())).first->second;
}

void separate_patches(mesh::CoarseMesh& mesh)
{
  std::map<std::array<LocalIndex, 2>, LocalIndex> corners;  // Patch and vertex to a number.
  UnionFind pieces;
  const auto number = [&](LocalIndex f, std::size_t corner) {
    const std::array<LocalIndex, 2> key{mesh.face_patch[at(f)],
                                        mesh.face_vertices[3 * at(f) + corner]};
    const auto [found, is_new] = corners.emplace(key, static_cast<LocalIndex>(corners.size()));
    if (is_new) pieces.add();
    return found->second;
  };
  const auto is_cut = [&](LocalIndex f) { return mesh.face_patch[at(f)] == kNoIndex; };
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    if (is_cut(f)) continue;
    for (std::size_t corner = 1; corner < 3; ++corner) pieces.join(number(f, 0), number(f, corner));
  }
  std::map<LocalIndex, LocalIndex> patch_of_piece;
  std::vector<bool> is_taken(at(mesh.num_patches()), false);
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    if (is_cut(f)) continue;
    LocalIndex& patch = mesh.face_patch[at(f)];
    const auto [found, is_new] = patch_of_piece.emplace(pieces.find(number(f, 0)), patch);
    if (is_new && is_taken[at(patch)]) {
      found->second = mesh.num_patches();
      const std::string name = mesh.patch_names[at(patch)];
      mesh.patch_names.push_back(
          name == mesh::default_patch_name(patch) ? mesh::default_patch_name(found->second) : name);
      mesh.patch_surface.push_back(mesh.patch_surface[at(patch)]);
    }
    is_taken[at(patch)] = true;
    patch = found->second;
  }
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/cut.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "netgen/csg/access.hpp"
#include "netgen/csg/parse.hpp"
#include "netgen/session.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;
using ::netgen::TopLevelObject;

// A solid of the file as it is to be meshed.
struct Part {
  std::string name{};
  LocalIndex number = 0;  // In the tree.
};

// Statements that make parts of solids: the one way to make solids of NETGEN's CSG that no version
// hides.
class Statements {
 public:
  Statements(const std::string& file_text, const cut::CutTree& tree) : tree_(tree)
  {
    while (file_text.find(prefix_) != std::string::npos) prefix_ += '_';
  }

  std::vector<Part> add(const std::string& solid, LocalIndex root)
  {
    std::vector<Part> parts;
    add_parts(solid, root, parts);
    return parts;
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void add_parts(const std::string& solid, LocalIndex row, std::vector<Part>& parts)
  {
    const cut::CutNode& node = tree_.nodes.at(at(row));
    if (node.is_leaf()) {
      parts.push_back({solid, node.part});
      return;
    }
    const std::string below = add_solid(half_space(node.plane));
    add_parts(add_solid(fmt::format("{} and {}", solid, below)), node.below, parts);
    add_parts(add_solid(fmt::format("{} and not {}", solid, below)), node.above, parts);
  }

  static std::string half_space(const cut::Plane& plane)
  {
    constexpr const char* kAllDigits = "plane ({:.17g}; {:.17g})";
    return fmt::format(kAllDigits, fmt::join(plane.offset * plane.normal, ", "),
                       fmt::join(plane.normal, ", "));
  }

  std::string add_solid(const std::string& what)
  {
    std::string name = fmt::format("{}{}", prefix_, num_solids_++);
    text_ += fmt::format("solid {} = {};\n", name, what);
    return name;
  }

  const cut::CutTree& tree_;
  std::string prefix_ = "tessera_cut_";
  int num_solids_ = 0;
  std::string text_ = "\n";  // The last line of a file may be a comment.
};

class Replacement {
 public:
  Replacement(Geometry& geometry, LocalIndex num_surfaces) : geometry_(geometry)
  {
    cut_.num_surfaces = num_surfaces;
  }

  // `parts`: of each top-level object; none if it is a surface.
  CutObjects run(const std::vector<std::vector<Part>>& parts)
  {
    const std::vector<TopLevelObject> uncut = take_objects();
    for (std::size_t i = 0; i < uncut.size(); ++i) {
      const TopLevelObject& object = uncut[i];
      const auto number = static_cast<LocalIndex>(i);
      if (object.GetSurface() != nullptr) add(object, *object.GetSolid(), number, kNoIndex);
      for (const Part& part : parts[i]) {
        add(object, *geometry_.GetSolid(part.name), number, part.number);
      }
    }
    repeat_modifications();
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

  void add(const TopLevelObject& like, const ::netgen::Solid& solid, LocalIndex number,
           LocalIndex part)
  {
    const int row = geometry_.SetTopLevelObject(const_cast<::netgen::Solid*>(&solid),
                                                const_cast<::netgen::Surface*>(like.GetSurface()));
    TopLevelObject& added = *geometry_.GetTopLevelObject(row);
    added.GetSolid()->SetMaxH(like.GetSolid()->GetMaxH());
    added.SetMaxH(like.GetMaxH());
    added.SetMaterial(like.GetMaterial());
    added.SetLayer(like.GetLayer());
    added.SetBCProp(like.GetBCProp());
    added.SetBCName(like.GetBCName());
    cut_.solid.push_back(number);
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

CutGeometry cut_geometry(const Geometry& uncut, const std::string& text,
                         const std::string& file_name, const cut::CutTree& tree)
{
  require_cuttable(uncut);
  Statements statements(text, tree);
  std::vector<std::vector<Part>> parts;
  for (int i = 0; i < uncut.GetNTopLevelObjects(); ++i) {
    const TopLevelObject& object = *uncut.GetTopLevelObject(i);
    parts.emplace_back();
    if (object.GetSurface() == nullptr) {
      parts.back() = statements.add(object.GetSolid()->Name(), tree.solid_root.at(at(i)));
    }
  }
  CutGeometry cut{.geometry = parse_csg(text + statements.text(), file_name)};
  cut.objects = Replacement(*cut.geometry, uncut.GetNSurf()).run(parts);
  return cut;
}

}  // namespace tessera::netgen

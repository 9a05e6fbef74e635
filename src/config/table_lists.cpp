// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "config/key_table.hpp"
#include "config/topology_keys.hpp"

namespace tessera::config {
namespace {

constexpr Key kRegionKeys[] = {
    {.name = "fill.region.material",
     .rule = TextRule{[](Case& c) -> std::string& { return c.fill.regions.back().material; }},
     .meaning = "Name of the material, as the model has it.",
     .reason = "a region is told by its material",
     .example = "\"steel\""},
    {.name = "fill.region.kernel",
     .rule = word_rule([](Case& c) -> fill::KernelKind& { return c.fill.regions.back().kernel; }),
     .meaning = "As fill.kernel.",
     .reason = "a region is there to name it",
     .example = "\"subdivide\""},
};

// The last region's shape, which becomes one of that kind if it is none.
template <class Kind>
Kind& shape_as(Case& c)
{
  sizing::Shape& shape = c.size.regions.back().shape;
  if (!std::holds_alternative<Kind>(shape)) shape = Kind{};
  return std::get<Kind>(shape);
}

constexpr std::string_view kOneShape = "a region has one shape";

constexpr Key kSizeRegionKeys[] = {
    {.name = "size.region.size",
     .rule = RealRule{[](Case& c) -> double& { return c.size.regions.back().size; }, 0.0,
                      Bound::exclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning = "Wanted edge length inside.",
     .reason = "a region is there to name it",
     .example = "0.1"},
    {.name = "size.region.growth",
     .rule = RealRule{[](Case& c) -> double& { return c.size.regions.back().growth; }, 0.0,
                      Bound::exclusive, 1.0, Bound::inclusive},
     .meaning = "Growth of the size per length of distance outside.",
     .reason = "sizes grow alike unless told otherwise",
     .derived_default = "size.grading",
     .example = "0.3",
     .is_optional = true},
    {.name = "size.region.box.min",
     .rule = TripleRule{[](Case& c) -> Vec3& { return shape_as<sizing::Box>(c).min; }, kHuge},
     .unit = "output length unit",
     .meaning = "A box along the axes: its lowest corner.",
     .reason = kOneShape,
     .example = "[0.0, 0.0, 0.0]"},
    {.name = "size.region.box.max",
     .rule = TripleRule{[](Case& c) -> Vec3& { return shape_as<sizing::Box>(c).max; }, kHuge},
     .unit = "output length unit",
     .meaning = "A box along the axes: its highest corner.",
     .reason = kOneShape,
     .example = "[1.0, 1.0, 1.0]"},
    {.name = "size.region.ball.centre",
     .rule = TripleRule{[](Case& c) -> Vec3& { return shape_as<sizing::Ball>(c).centre; }, kHuge},
     .unit = "output length unit",
     .meaning = "A ball: its centre.",
     .reason = kOneShape,
     .example = "[0.0, 0.0, 0.0]"},
    {.name = "size.region.ball.radius",
     .rule = RealRule{[](Case& c) -> double& { return shape_as<sizing::Ball>(c).radius; }, 0.0,
                      Bound::exclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning = "A ball: its radius.",
     .reason = kOneShape,
     .example = "1.0"},
    {.name = "size.region.cylinder.start",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return shape_as<sizing::Cylinder>(c).start; }, kHuge},
     .unit = "output length unit",
     .meaning = "A cylinder: the middle of one end.",
     .reason = kOneShape,
     .example = "[0.0, 0.0, 0.0]"},
    {.name = "size.region.cylinder.end",
     .rule = TripleRule{[](Case& c) -> Vec3& { return shape_as<sizing::Cylinder>(c).end; }, kHuge},
     .unit = "output length unit",
     .meaning = "A cylinder: the middle of the other end.",
     .reason = kOneShape,
     .example = "[0.0, 0.0, 1.0]"},
    {.name = "size.region.cylinder.radius",
     .rule = RealRule{[](Case& c) -> double& { return shape_as<sizing::Cylinder>(c).radius; }, 0.0,
                      Bound::exclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning = "A cylinder: its radius.",
     .reason = kOneShape,
     .example = "1.0"},
    {.name = "size.region.halfspace.point",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return shape_as<sizing::HalfSpace>(c).point; }, kHuge},
     .unit = "output length unit",
     .meaning = "All on one side of a plane: a point of the plane.",
     .reason = kOneShape,
     .example = "[0.0, 0.0, 0.0]"},
    {.name = "size.region.halfspace.normal",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return shape_as<sizing::HalfSpace>(c).normal; }, kHuge},
     .meaning = "All on one side of a plane: the normal out of the half-space, as that of a plane "
                "in a .geo file. Of any length.",
     .reason = kOneShape,
     .example = "[0.0, 0.0, 1.0]"},
    {.name = "size.region.patch",
     .rule = TextRule{[](Case& c) -> std::string& {
       return shape_as<sizing::PatchPattern>(c).pattern;
     }},
     .meaning = "The patches of that name, or whose names match it: * stands for any characters, ? "
                "for one, [ab] for one of these.",
     .reason = kOneShape,
     .example = "\"inlet*\""},
    {.name = "size.region.material",
     .rule = TextRule{[](Case& c) -> std::string& {
       return shape_as<sizing::MaterialPattern>(c).pattern;
     }},
     .meaning = "The materials of that name, or whose names match it, as of patches.",
     .reason = kOneShape,
     .example = "\"steel\""},
    {.name = "size.region.curve",
     .rule = TextRule{[](Case& c) -> std::string& {
       return shape_as<sizing::CurvePattern>(c).pattern;
     }},
     .meaning = "The curves of that number in the list of edges of tessera info MODEL, or of that "
                "name in the file, or whose numbers or names match it, as of patches.",
     .reason = kOneShape,
     .example = "\"7\""},
};

// The last name's criteria, which become those of that kind if they are of the other.
template <class Kind>
Kind& criteria_as(Case& c)
{
  auto& of = c.geometry.names.back().of;
  if (!std::holds_alternative<Kind>(of)) of = Kind{};
  return std::get<Kind>(of);
}

using model::FaceCriteria;
using model::SolidCriteria;

constexpr std::string_view kAllThatIsGiven = "all that is given must hold";
constexpr std::string_view kLowestCorner =
    "They lie inside of this box along the axes: its lowest corner.";
constexpr std::string_view kHighestCorner =
    "They lie inside of this box along the axes: its highest corner.";

constexpr Key kNameKeys[] = {
    {.name = "geometry.name.name",
     .rule = TextRule{[](Case& c) -> std::string& { return c.geometry.names.back().name; }},
     .meaning = "The name, in place of that in the file.",
     .reason = "an entry is there to give it",
     .example = "\"inlet\""},
    {.name = "geometry.name.patch.faces",
     .rule = NumberListRule{[](Case& c) -> std::vector<LocalIndex>& {
       return criteria_as<FaceCriteria>(c).faces;
     }},
     .meaning = "Faces with these numbers, as tessera info lists them.",
     .reason = kAllThatIsGiven,
     .example = "[1, 2]",
     .is_optional = true},
    {.name = "geometry.name.patch.pattern",
     .rule = TextRule{[](Case& c) -> std::string& { return criteria_as<FaceCriteria>(c).pattern; }},
     .meaning = "Faces whose names in the file match it: * stands for any characters, ? for one, "
                "[ab] for one of these.",
     .reason = kAllThatIsGiven,
     .example = "\"in*\"",
     .is_optional = true},
    {.name = "geometry.name.patch.colour",
     .rule = TextRule{[](Case& c) -> std::string& { return criteria_as<FaceCriteria>(c).colour; }},
     .meaning = "Faces of this colour, as tessera info prints it.",
     .reason = kAllThatIsGiven,
     .example = "\"#FF0000\"",
     .is_optional = true},
    {.name = "geometry.name.patch.normal",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return criteria_as<FaceCriteria>(c).normal; }, kHuge},
     .meaning =
         "Faces that point that way everywhere, out of the solid; of two solids, out of that "
         "with the lower number. Of any length.",
     .reason = kAllThatIsGiven,
     .example = "[0.0, 0.0, 1.0]",
     .is_optional = true},
    {.name = "geometry.name.patch.tolerance_deg",
     .rule = RealRule{[](Case& c) -> double& { return criteria_as<FaceCriteria>(c).tolerance_deg; },
                      0.0, Bound::exclusive, 90.0, Bound::inclusive},
     .unit = "degrees",
     .meaning = "How far a triangle of the face may be off the normal.",
     .reason = "flat faces are off by rounding only",
     .derived_default = "5.0",
     .example = "5.0",
     .is_optional = true},
    {.name = "geometry.name.patch.box.min",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return criteria_as<FaceCriteria>(c).box_min; }, kHuge},
     .unit = "output length unit",
     .meaning = kLowestCorner,
     .reason = kAllThatIsGiven,
     .example = "[0.0, 0.0, 0.0]",
     .is_optional = true},
    {.name = "geometry.name.patch.box.max",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return criteria_as<FaceCriteria>(c).box_max; }, kHuge},
     .unit = "output length unit",
     .meaning = kHighestCorner,
     .reason = kAllThatIsGiven,
     .example = "[1.0, 1.0, 0.0]",
     .is_optional = true},
    {.name = "geometry.name.material.solids",
     .rule = NumberListRule{[](Case& c) -> std::vector<LocalIndex>& {
       return criteria_as<SolidCriteria>(c).solids;
     }},
     .meaning = "Solids with these numbers, as tessera info lists them.",
     .reason = kAllThatIsGiven,
     .example = "[1]",
     .is_optional = true},
    {.name = "geometry.name.material.pattern",
     .rule =
         TextRule{[](Case& c) -> std::string& { return criteria_as<SolidCriteria>(c).pattern; }},
     .meaning = "Solids whose names in the file match it, as of faces.",
     .reason = kAllThatIsGiven,
     .example = "\"st*\"",
     .is_optional = true},
    {.name = "geometry.name.material.box.min",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return criteria_as<SolidCriteria>(c).box_min; }, kHuge},
     .unit = "output length unit",
     .meaning = kLowestCorner,
     .reason = kAllThatIsGiven,
     .example = "[0.0, 0.0, 0.0]",
     .is_optional = true},
    {.name = "geometry.name.material.box.max",
     .rule =
         TripleRule{[](Case& c) -> Vec3& { return criteria_as<SolidCriteria>(c).box_max; }, kHuge},
     .unit = "output length unit",
     .meaning = kHighestCorner,
     .reason = kAllThatIsGiven,
     .example = "[1.0, 1.0, 1.0]",
     .is_optional = true},
};

constexpr Key kPlaneKeys[] = {
    {.name = "decompose.plane.point",
     .rule = TripleRule{[](Case& c) -> Vec3& { return c.planes.given.back().point; }, kHuge},
     .unit = "output length unit",
     .meaning = "A point of the plane.",
     .reason = "a plane is told by it",
     .example = "[0.5, 0.0, 0.0]"},
    {.name = "decompose.plane.normal",
     .rule = TripleRule{[](Case& c) -> Vec3& { return c.planes.given.back().normal; }, kHuge},
     .meaning = "The direction across the plane. Of any length.",
     .reason = "a plane is told by it",
     .example = "[1.0, 0.0, 0.0]"},
};

constexpr Key kLayerKeys[] = {
    {.name = "layer.patch",
     .rule = TextRule{[](Case& c) -> std::string& { return c.layers.back().patch; }},
     .meaning =
         "The patches of that name, or whose names match it: * stands for any characters, ? "
         "for one, [ab] for one of these. A patch that is split has layers on both sides, or "
         "on one by the name of that side. A patch between two solids has them on the side that "
         "side names. Other patches inside of the model and sides of [[periodic]] are left out. "
         "No patch, and no side of one, may fit two entries.",
     .reason = "layers are on walls, and only the user knows which patches these are",
     .example = "\"wall*\""},
    {.name = "layer.side",
     .rule = TextRule{[](Case& c) -> std::string& { return c.layers.back().side; }},
     .meaning = "The solid that has the layers: its number in the list of tessera info MODEL, or "
                "its name in the file. Or several, whose numbers or names match. Then patches "
                "between it and other solids have layers, too.",
     .reason = "outside there is one side only",
     .derived_default = "any, and none at patches between two solids",
     .example = "\"fluid\"",
     .is_optional = true},
    {.name = "layer.first",
     .rule = RealRule{[](Case& c) -> double& { return c.layers.back().first; }, 0.0,
                      Bound::exclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning = "Height of the layer at the wall. Where patches of several entries meet, the one "
                "holds whose layers are thinnest together.",
     .reason = "it follows from the flow",
     .example = "0.01"},
    {.name = "layer.growth",
     .rule = RealRule{[](Case& c) -> double& { return c.layers.back().growth; }, 1.0,
                      Bound::inclusive, 3.0, Bound::inclusive},
     .meaning = "Height of a layer by that of the one nearer to the wall.",
     .reason = "what flow solvers recommend",
     .derived_default = "1.2",
     .example = "1.2",
     .is_optional = true},
    {.name = "layer.count",
     .rule =
         IntegerRule{[](Case& c) -> int& { return c.layers.back().count; }, 1, layers::kMostLayers},
     .meaning =
         "Number of layers in the final mesh, whatever the levels. Either this or thickness.",
     .reason = "so the last layer is about as high as the tets inside",
     .derived_default = "as many as lead up to size.target",
     .example = "5",
     .is_optional = true},
    {.name = "layer.thickness",
     .rule = RealRule{[](Case& c) -> double& { return c.layers.back().thickness; }, 0.0,
                      Bound::exclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning = "Of all layers together; their number is the one that comes nearest.",
     .reason = "count says it",
     .example = "0.1",
     .is_optional = true},
};

constexpr std::string_view kNamed[] = {"patch", "material"};

constexpr std::string_view kShapes[] = {"box",   "ball",     "cylinder", "halfspace",
                                        "patch", "material", "curve"};

constexpr TableList kTableLists[] = {
    {.name = "geometry.name",
     .keys = kNameKeys,
     .alternatives = kNamed,
     .meaning = "A name for faces of the model, which become one patch of the mesh, or for solids. "
                "No face or solid may be chosen by two entries.",
     .reason = "the names are those in the file",
     .size = [](const Case& c) { return c.geometry.names.size(); },
     .resize = [](Case& c, std::size_t size) { c.geometry.names.resize(size); },
     .defect = [](const Case& c) { return model::defect_of(c.geometry.names.back()); }},
    {.name = "geometry.contact",
     .keys = kContactKeys,
     .meaning = "Solids that are kept apart where they touch: each has points of its own there, at "
                "the same places, and a patch of its own. At the rim they stay together where a "
                "third solid holds both.",
     .reason = "solids that touch share the faces between them",
     .size = [](const Case& c) { return c.splits.contacts.size(); },
     .resize = [](Case& c, std::size_t size) { c.splits.contacts.resize(size); }},
    {.name = "embed",
     .keys = kEmbedKeys,
     .unique_key = "embed.name",
     .alternatives = kEmbedShapes,
     .meaning =
         "A plane face or a line that is put into the solids of a .step, .iges, .brep or .geo, as "
         "a fault or a well: the mesh conforms to it. A face is a patch, and a line has edges. It "
         "may end inside of a solid, and stick out of it; what sticks out is left out.",
     .reason = "the model has the faces that it has",
     .size = [](const Case& c) { return c.geometry.assembly.embedded.size(); },
     .resize = [](Case& c, std::size_t size) { c.geometry.assembly.embedded.resize(size); },
     .defect = [](const Case& c) { return model::defect_of(c.geometry.assembly.embedded.back()); }},
    {.name = "decompose.plane",
     .keys = kPlaneKeys,
     .meaning =
         "A plane that cuts the model, with decompose.method = \"geometry\": every part that "
         "it crosses, in the order of the entries. Others follow by decompose.planes if "
         "decompose.subdomains asks for more parts.",
     .reason = "decompose.planes chooses them",
     .size = [](const Case& c) { return c.planes.given.size(); },
     .resize = [](Case& c, std::size_t size) { c.planes.given.resize(size); },
     .defect = [](const Case& c) { return cut::defect_of(c.planes.given.back()); }},
    {.name = "layer",
     .keys = kLayerKeys,
     .meaning = "Layers of flat cells on walls: a stack over every boundary triangle of a patch, "
                "each layer higher than the one before it.",
     .reason = "only flows along walls need them",
     .size = [](const Case& c) { return c.layers.size(); },
     .resize = [](Case& c, std::size_t size) { c.layers.resize(size); },
     .defect = [](const Case& c) { return layers::defect_of(c.layers.back()); }},
    {.name = "split",
     .keys = kSplitKeys,
     .meaning = "Patches along which the mesh is open, as a crack or a baffle: both sides have "
                "points of their own at the same places, but at the rim. A patch X becomes X_plus "
                "and X_minus.",
     .reason = "the mesh hangs together where two materials meet",
     .size = [](const Case& c) { return c.splits.patches.size(); },
     .resize = [](Case& c, std::size_t size) { c.splits.patches.resize(size); }},
    {.name = "periodic",
     .keys = kPeriodicKeys,
     .meaning = "Sides of the mesh that are images of each other, with the same points and "
                "triangles, as of one cell of a lattice or one blade of a wheel.",
     .reason = "most models are no part of a larger one",
     .size = [](const Case& c) { return c.periodic.size(); },
     .resize = [](Case& c, std::size_t size) { c.periodic.resize(size); },
     .defect = [](const Case& c) { return topology::defect_of(c.periodic.back()); }},
    {.name = "fill.region",
     .keys = kRegionKeys,
     .unique_key = "fill.region.material",
     .meaning = "The kernel for all subdomains of one material, in place of fill.kernel.",
     .reason = "one kernel for all materials is the rule",
     .size = [](const Case& c) { return c.fill.regions.size(); },
     .resize = [](Case& c, std::size_t size) { c.fill.regions.resize(size); }},
    {.name = "size.region",
     .keys = kSizeRegionKeys,
     .alternatives = kShapes,
     .meaning = "A wanted edge length in a part of the model. Where several are wanted, the "
                "smallest wins, also against size.target and size.field.",
     .reason = "one size everywhere is the rule",
     .size = [](const Case& c) { return c.size.regions.size(); },
     .resize = [](Case& c, std::size_t size) { c.size.regions.resize(size); },
     .defect = [](const Case& c) { return sizing::defect_of(c.size.regions.back()); }},
};

}  // namespace

std::span<const TableList> all_table_lists() { return kTableLists; }

const TableList* find_table_list(std::string_view name)
{
  const auto* found = std::ranges::find(kTableLists, name, &TableList::name);
  return found == std::end(kTableLists) ? nullptr : found;
}

const TableList* list_around(std::string_view name)
{
  for (const TableList& list : kTableLists) {
    if (name.starts_with(list.name) && name.substr(list.name.size()).starts_with('.')) return &list;
  }
  return nullptr;
}

std::string_view name_in_list(const TableList& list, const Key& key)
{
  return key.name.substr(list.name.size() + 1);
}

std::string_view alternative_of(const TableList& list, const Key& key)
{
  const std::string_view name = name_in_list(list, key);
  const std::string_view first = name.substr(0, name.find('.'));
  return std::ranges::count(list.alternatives, first) > 0 ? first : std::string_view{};
}

}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "config/key_table.hpp"

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
};

constexpr std::string_view kShapes[] = {"box",       "ball",  "cylinder",
                                        "halfspace", "patch", "material"};

constexpr TableList kTableLists[] = {
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

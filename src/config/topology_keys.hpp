// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/key_table.hpp"

/// Keys of the tables of topology: what lies inside of solids, where a mesh is opened, and which
/// sides are images.
namespace tessera::config {

// The last embedded shape, which becomes one of that kind if it is none.
template <class Kind>
Kind& embedded_as(Case& c)
{
  auto& shape = c.geometry.assembly.embedded.back().shape;
  if (!std::holds_alternative<Kind>(shape)) shape = Kind{};
  return std::get<Kind>(shape);
}

inline constexpr Key kEmbedKeys[] = {
    {.name = "embed.name",
     .rule =
         TextRule{[](Case& c) -> std::string& { return c.geometry.assembly.embedded.back().name; }},
     .meaning = "Name of its patch, or of the line.",
     .reason = "other tables and solvers know it by that",
     .example = "\"fault\""},
    {.name = "embed.polygon",
     .rule = PointListRule{[](Case& c) -> std::vector<Vec3>& {
                             return embedded_as<model::Polygon>(c).corners;
                           },
                           kHuge},
     .unit = "output length unit",
     .meaning = "A plane piece: its corners in turn, three or more.",
     .reason = "a face has one shape",
     .example = "[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]]"},
    {.name = "embed.disk.centre",
     .rule = TripleRule{[](Case& c) -> Vec3& { return embedded_as<model::Disk>(c).centre; }, kHuge},
     .unit = "output length unit",
     .meaning = "A plane piece with a round rim: its centre.",
     .reason = "a face has one shape",
     .example = "[0.0, 0.0, 0.0]"},
    {.name = "embed.disk.normal",
     .rule = TripleRule{[](Case& c) -> Vec3& { return embedded_as<model::Disk>(c).normal; }, kHuge},
     .meaning = "A plane piece with a round rim: the direction across it. Of any length.",
     .reason = "a face has one shape",
     .example = "[0.0, 0.0, 1.0]"},
    {.name = "embed.disk.radius",
     .rule = RealRule{[](Case& c) -> double& { return embedded_as<model::Disk>(c).radius; }, 0.0,
                      Bound::exclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning = "A plane piece with a round rim: its radius.",
     .reason = "a face has one shape",
     .example = "0.5"},
    {.name = "embed.polyline",
     .rule = PointListRule{[](Case& c) -> std::vector<Vec3>& {
                             return embedded_as<model::Polyline>(c).points;
                           },
                           kHuge},
     .unit = "output length unit",
     .meaning = "A line, as a well: its points in turn, two or more.",
     .reason = "an entry has one shape",
     .example = "[[0.2, 0.5, 1.0], [0.2, 0.5, 0.4], [0.6, 0.5, 0.2]]"},
};

inline constexpr std::string_view kEmbedShapes[] = {"polygon", "disk", "polyline"};

inline constexpr Key kContactKeys[] = {
    {.name = "geometry.contact.body",
     .rule = TextRule{[](Case& c) -> std::string& { return c.splits.contacts.back().body; }},
     .meaning =
         "The one solid: its number in the list of tessera info MODEL, or its name in the "
         "file. Or several, whose numbers or names match: * stands for any characters, ? for "
         "one, [ab] for one of these.",
     .reason = "a contact has two sides",
     .example = "\"shaft\""},
    {.name = "geometry.contact.other",
     .rule = TextRule{[](Case& c) -> std::string& { return c.splits.contacts.back().other; }},
     .meaning = "The other solid, or several, as of body.",
     .reason = "a contact has two sides",
     .example = "\"2\""},
};

inline constexpr Key kSplitKeys[] = {
    {.name = "split.patch",
     .rule = TextRule{[](Case& c) -> std::string& { return c.splits.patches.back().patch; }},
     .meaning = "The patches of that name, or whose names match it: * stands for any characters, ? "
                "for one, [ab] for one of these. They lie between two materials or inside of one.",
     .reason = "only the user knows where the mesh is to be open",
     .example = "\"crack\""},
};

inline constexpr Key kPeriodicKeys[] = {
    {.name = "periodic.from",
     .rule = TextRule{[](Case& c) -> std::string& { return c.periodic.back().from; }},
     .meaning = "The patches of that name, or whose names match it: * stands for any characters, ? "
                "for one, [ab] for one of these. They lie outside.",
     .reason = "only the user knows which sides are alike",
     .example = "\"left\""},
    {.name = "periodic.to",
     .rule = TextRule{[](Case& c) -> std::string& { return c.periodic.back().to; }},
     .meaning = "The patches that are the image of these, likewise.",
     .reason = "only the user knows which sides are alike",
     .example = "\"right\""},
    {.name = "periodic.translation",
     .rule = TripleRule{[](Case& c) -> Vec3& { return c.periodic.back().translation; }, kHuge},
     .unit = "output length unit",
     .meaning = "What leads from the one side to the other. Either this or a rotation.",
     .reason = "it leads from centroid to centroid",
     .example = "[1.0, 0.0, 0.0]",
     .is_optional = true},
    {.name = "periodic.rotation.axis",
     .rule = TripleRule{[](Case& c) -> Vec3& { return c.periodic.back().axis; }, kHuge},
     .meaning = "Direction of the axis of a rotation that leads from the one side to the other. Of "
                "any length.",
     .reason = "the sides are moved, not turned",
     .example = "[0.0, 0.0, 1.0]",
     .is_optional = true},
    {.name = "periodic.rotation.point",
     .rule = TripleRule{[](Case& c) -> Vec3& { return c.periodic.back().axis_point; }, kHuge},
     .unit = "output length unit",
     .meaning = "A point of that axis.",
     .reason = "most axes go through the origin",
     .derived_default = "[0.0, 0.0, 0.0]",
     .example = "[0.0, 0.0, 0.0]",
     .is_optional = true},
    {.name = "periodic.rotation.angle",
     .rule = RealRule{[](Case& c) -> double& { return c.periodic.back().angle_deg; }, -360.0,
                      Bound::exclusive, 360.0, Bound::exclusive},
     .unit = "degrees",
     .meaning = "How far it turns, by the right-hand rule.",
     .reason = "a rotation has one",
     .example = "30.0",
     .is_optional = true},
};

}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "config/key_table.hpp"

/// Keys of the table of the model.
namespace tessera::config {

inline constexpr Key kGeometryKeys[] = {
    {.name = "geometry.file",
     .rule = PathRule{[](Case& c) -> std::filesystem::path& { return c.geometry.file; }},
     .meaning = "The CAD model: .geo (NETGEN's CSG), .stl, .step/.stp, .iges/.igs or .brep. Or a "
                "mesh of linear tets that is the coarse mesh: .msh (Gmsh's, 2.2 or 4.1), .vol "
                "(NETGEN's) or .vtu. Relative to the folder of the case file.",
     .reason = "every case names its model",
     .example = "\"model.step\""},
    {.name = "geometry.cad",
     .rule = PathRule{[](Case& c) -> std::filesystem::path& { return c.geometry.cad; }},
     .meaning =
         "Of a mesh in geometry.file: the CAD model that it is a mesh of, in the same length "
         "unit. New points on the boundary go onto it. Relative to the folder of the case "
         "file.",
     .reason = "a mesh is refined as it is",
     .example = "\"model.step\"",
     .is_optional = true},
    {.name = "geometry.smooth",
     .rule = FlagRule{[](Case& c) -> bool& { return c.geometry.smooth; }},
     .meaning = "Of a mesh in geometry.file without geometry.cad: whether new points on the "
                "boundary go onto a smooth surface through its vertices. Edges sharper than "
                "coarse.feature_angle_deg stay.",
     .reason = "only who made the mesh knows whether its surface is meant to be round"},
    {.name = "geometry.scale",
     .rule = RealRule{[](Case& c) -> double& { return c.geometry.scale; }, 0.0, Bound::exclusive,
                      kHuge, Bound::inclusive},
     .unit = "output length units per file length unit",
     .meaning = "Factor applied to the model. Every length below is in output units.",
     .reason = "the mesh keeps the model's unit"},
    {.name = "geometry.overlap",
     .rule = word_rule([](Case& c) -> model::Overlap& { return c.geometry.assembly.overlap; }),
     .meaning =
         "What becomes of space that two solids of a .step, .iges or .brep have in common. "
         "\"error\": the model is refused, with both solids, the volume and the place. \"first\": "
         "the solid that comes first in the file has it; \"last\": the one that comes last. "
         "\"cut\": "
         "it becomes a solid of its own, with the name of the first.",
     .reason =
         "solids that overlap are most often a mistake, and only who made them knows which of "
         "them is there"},
    {.name = "geometry.gap",
     .rule = RealRule{[](Case& c) -> double& { return c.geometry.assembly.gap; }, 0.0,
                      Bound::inclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning =
         "Solids of a .step, .iges or .brep whose faces are nearer to each other share these "
         "faces, and overlaps that are thinner are none; the report lists the gaps. 0: only "
         "faces within OpenCASCADE's own tolerances of each other are shared.",
     .reason = "as much comes of rounding, when a program writes the file in another unit, and no "
               "fit of two parts is so tight",
     .derived_default = "a millionth of the diagonal of the model's box",
     .example = "0.001",
     .is_optional = true},
    {.name = "geometry.loose_faces",
     .rule =
         word_rule([](Case& c) -> model::LooseParts& { return c.geometry.assembly.loose_faces; }),
     .meaning =
         "What becomes of faces that a .step, .iges or .brep has beside its solids. \"embed\": "
         "where they lie inside of a solid, the mesh has them as a patch inside; the rest is left "
         "out. \"drop\": all are left out.",
     .reason = "who draws a face into a solid wants it in the mesh, as a fault or a sheet"},
    {.name = "geometry.loose_curves",
     .rule =
         word_rule([](Case& c) -> model::LooseParts& { return c.geometry.assembly.loose_curves; }),
     .meaning =
         "What becomes of curves that a .step, .iges or .brep has beside its solids and faces. "
         "\"embed\": where they lie inside of a solid, the mesh has them as edges; the rest is "
         "left out. \"drop\": all are left out.",
     .reason = "files have many curves that were only drawn to make solids from"},
    {.name = "geometry.repair",
     .rule = word_rule([](Case& c) -> model::StlRepair& { return c.geometry.stl.repair; }),
     .meaning =
         "What is done about a .stl whose triangles bound no body: edges with one triangle, or "
         "with more than two, or a surface that cuts itself. \"mend\": what invents nothing, as "
         "joining points; where that is not enough the file is refused. \"wrap\": a closed "
         "surface is made around the triangles. It closes holes and makes one body of those that "
         "cross; the run is degraded, and says how far it is off the file.",
     .reason = "a wrap is not what was drawn, so nobody should get one who has not asked for it"},
    {.name = "geometry.wrap_tolerance",
     .rule = RealRule{[](Case& c) -> double& { return c.geometry.stl.wrap_tolerance; }, 0.0,
                      Bound::exclusive, kHuge, Bound::inclusive},
     .unit = "output length unit",
     .meaning =
         "How exact a wrap is: what is thinner may be lost, and gaps that are narrower may be "
         "filled. Half of it makes four times as many triangles. size.min is as large unless "
         "given.",
     .reason = "with it most files are wrapped within seconds, by 20,000 to 150,000 triangles",
     .derived_default = "1/200 of the diagonal of the box of the file",
     .example = "0.1",
     .is_optional = true},
};

}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
// Random parts as a CAD program makes them, for the bench random_models: profiles that are
// extruded, turned or lofted, rounded and cut edges, hollow bodies, assemblies.
#pragma once

#include <TopoDS_Shape.hxx>

#include "random_csg.hpp"

/// @brief Local. A closed random profile, extruded, turned round an axis, or lofted to a second
/// one.
/// @throws Rejected if OpenCASCADE cannot make it.
TopoDS_Shape random_sweep(Dice& dice);

/// @brief Local. The part with some edges rounded or cut, or hollow with one face open.
/// @throws Rejected if OpenCASCADE cannot do it.
TopoDS_Shape dressed(const TopoDS_Shape& part, Dice& dice);

/// @brief Local. Two to five bodies that touch or overlap, as solids with common faces, or apart.
/// @throws Rejected if OpenCASCADE cannot make it.
TopoDS_Shape random_assembly(Dice& dice);

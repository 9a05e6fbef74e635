// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <IMeshTools_Parameters.hxx>
#include <TopoDS_Shape.hxx>

#include "cad/triangles/face_loops.hpp"

namespace tessera::cad {

/// @brief Puts triangles on the faces of a shape, in place of what is there. Local.
///
/// OpenCASCADE's mesher comes first. A face that it cannot do, or not up to its boundary, gets
/// triangles of our own, made from its boundary curves in its parameters, with the points that
/// neighbours have on common edges. Where that fails as well, all is tried again with finer
/// settings.
/// @param[in] face_part Of each face, in the order of parts_of(): its triangles are off it by this
/// part of what the others may be, at most 1. Empty: all are alike.
/// @return Numbers of faces that have no such triangles, in the order of parts_of().
std::vector<int> triangulate_faces(const TopoDS_Shape& shape,
                                   const IMeshTools_Parameters& parameters,
                                   const std::vector<double>& face_part = {});

/// @brief Triangulates one face from its boundary curves in its parameters. Its triangles have the
/// points that neighbours have on common edges. Edges inside the face are left out. Local.
/// @return Whether that was done: not if its boundary does not close, or crosses itself by more
/// than a tolerance.
bool triangulate_from_boundary(const TopoDS_Shape& face, const Closeness& closeness);

/// @brief Gives a face some triangles in its parameters that need not cover it, for who wants to
/// know its curvature here and there. Local.
void sample_face(const TopoDS_Shape& face);

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#include "cad/cell_numbers.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <BRepAdaptor_Curve.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/error.hpp"

#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

std::vector<LocalIndex> numbers_in_model(const CutShape& cells, TopAbs_ShapeEnum kind,
                                         const TopTools_DataMapOfShapeInteger& numbers)
{
  std::vector<LocalIndex> in_model;
  for (const TopoDS_Shape& part : parts_of(cells.shape, kind)) {
    in_model.push_back(CutShape::number_in(numbers, part));
  }
  return in_model;
}

// Of what has one of these numbers in the model; ascending, as these are.
std::vector<LocalIndex> pieces_of(const std::vector<LocalIndex>& numbers,
                                  const std::vector<LocalIndex>& in_model)
{
  std::vector<LocalIndex> pieces;
  for (std::size_t p = 0; p < in_model.size(); ++p) {
    const bool is_piece =
        in_model[p] != kNoIndex && std::ranges::find(numbers, in_model[p]) != numbers.end();
    if (is_piece) pieces.push_back(static_cast<LocalIndex>(p));
  }
  return pieces;
}

std::vector<std::string> names_of_pieces(const std::vector<std::string>& names,
                                         const std::vector<LocalIndex>& in_model)
{
  std::vector<std::string> of_pieces;
  for (const LocalIndex number : in_model) {
    of_pieces.push_back(number == kNoIndex ? std::string() : names.at(at(number)));
  }
  return of_pieces;
}

}  // namespace

CellNumbers::CellNumbers(CutShape cells)
    : cells_(std::move(cells)),
      face_(numbers_in_model(cells_, TopAbs_FACE, cells_.faces)),
      edge_(numbers_in_model(cells_, TopAbs_EDGE, cells_.edges))
{
}

OccContent CellNumbers::content_from(const OccContent& model) const
{
  OccContent content{.shape = cells_.shape,
                     .face_names = names_of_pieces(model.face_names, face_),
                     .face_colours = names_of_pieces(model.face_colours, face_),
                     .edge_names = names_of_pieces(model.edge_names, edge_),
                     .may_overlap = model.may_overlap};
  for (const LocalIndex solid : cells_.solid) {
    content.solid_names.push_back(model.solid_names.at(at(solid)));
    content.solid_body.push_back(model.solid_body.at(at(solid)));
  }
  return content;
}

surface::CoarseOptions CellNumbers::options_from(surface::CoarseOptions options) const
{
  options.kept.patches = pieces_of(options.kept.patches, face_);
  options.kept.curves = pieces_of(options.kept.curves, edge_);
  for (surface::PeriodicPatches& sides : options.periodic) {
    sides.from = pieces_of(sides.from, face_);
    sides.to = pieces_of(sides.to, face_);
  }
  return options;
}

void CellNumbers::require_images(const surface::CoarseOptions& options) const
{
  // The shift between two sides is known from triangles.
  const double tolerance = 1e-4 * box_diagonal_of(cells_.shape);
  const auto require_all_among = [&](const std::vector<Vec3>& places,
                                     const std::vector<Vec3>& others) {
    for (const Vec3& place : places) {
      const auto is_near = [&](const Vec3& other) { return norm(other - place) <= tolerance; };
      if (std::ranges::any_of(others, is_near)) continue;
      throw NetgenError(
          fmt::format("a face or a line that ends inside of a solid is continued to the solid's "
                      "sides, and reaches one of two periodic sides near ({:g}) but not the other "
                      "one; turn it, or divide the solid in the CAD program so that both sides "
                      "are cut alike",
                      fmt::join(place, ", ")));
    }
  };
  for (const surface::PeriodicPatches& sides : options.periodic) {
    std::vector<Vec3> images = middles_of_cuts(sides.from);
    for (Vec3& image : images) image = sides.there(image);
    const std::vector<Vec3> there = middles_of_cuts(sides.to);
    require_all_among(images, there);
    require_all_among(there, images);
  }
}

// Of edges of these faces that the model does not have.
std::vector<Vec3> CellNumbers::middles_of_cuts(const std::vector<LocalIndex>& faces) const
{
  const std::vector<TopoDS_Shape> all = parts_of(cells_.shape, TopAbs_FACE);
  std::vector<Vec3> middles;
  for (const LocalIndex face : faces) {
    for (const TopoDS_Shape& edge : parts_of(all[at(face)], TopAbs_EDGE)) {
      if (CutShape::number_in(cells_.edges, edge) != kNoIndex) continue;
      const BRepAdaptor_Curve curve(TopoDS::Edge(edge));
      const gp_Pnt p = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
      middles.push_back({p.X(), p.Y(), p.Z()});
    }
  }
  return middles;
}

void CellNumbers::number_as_model(const std::vector<std::string>& face_names,
                                  surface::CoarseSurface& surface) const
{
  renumber_merged(surface);
  mesh::CoarseMesh& mesh = surface.mesh;
  const std::vector<LocalIndex> faces(mesh.patch_surface.begin(), mesh.patch_surface.end());
  std::map<LocalIndex, LocalIndex> row_of{{kNoIndex, kNoIndex}};  // By number in the model.
  for (const LocalIndex face : faces) row_of[face_[at(face)]] = kNoIndex;
  mesh.patch_names.clear();
  mesh.patch_surface.clear();
  for (auto& [face, row] : row_of) {
    if (face == kNoIndex) continue;
    row = mesh.num_patches();
    const std::string& name = face_names.at(at(face));
    mesh.patch_names.push_back(name.empty() ? mesh::default_patch_name(face) : name);
    mesh.patch_surface.push_back(LocalIndex{face});
  }
  for (LocalIndex& patch : mesh.face_patch) patch = row_of.at(face_[at(faces[at(patch)])]);
  for (LocalIndex& curve : mesh.segment_curve) curve = edge_[at(curve)];
}

// A part of the model counts as merged if all its pieces are.
void CellNumbers::renumber_merged(surface::CoarseSurface& surface) const
{
  const mesh::CoarseMesh& mesh = surface.mesh;
  std::vector<LocalIndex> left;
  for (const LocalIndex patch : mesh.face_patch) left.push_back(mesh.patch_surface[at(patch)]);
  surface::Defeatured& merged = surface.defeatured;
  merged.patches = surface::renumbered(merged.patches, face_, left);
  merged.curves = surface::renumbered(merged.curves, edge_,
                                      {mesh.segment_curve.begin(), mesh.segment_curve.end()});
}

}  // namespace tessera::cad

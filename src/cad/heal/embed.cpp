// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/embed.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Face.hxx>
#include <fmt/format.h>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include "tessera/base/error.hpp"

#include "cad/heal/fuse.hpp"
#include "cad/heal/glue.hpp"
#include "cad/inner_faces.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

TopoDS_Face face_of(const model::Polygon& polygon)
{
  BRepBuilderAPI_MakePolygon rim;
  for (const Vec3& corner : polygon.corners) rim.Add(to_occ(corner));
  rim.Close();
  const Vec3 normal = polygon.normal();
  const gp_Pln plane(to_occ(polygon.corners.front()), gp_Dir(normal[0], normal[1], normal[2]));
  return BRepBuilderAPI_MakeFace(plane, rim.Wire()).Face();
}

TopoDS_Face face_of(const model::Disk& disk)
{
  const gp_Ax2 axis(to_occ(disk.centre), gp_Dir(disk.normal[0], disk.normal[1], disk.normal[2]));
  const TopoDS_Edge rim = BRepBuilderAPI_MakeEdge(gp_Circ(axis, disk.radius));
  return BRepBuilderAPI_MakeFace(gp_Pln(gp_Ax3(axis)), BRepBuilderAPI_MakeWire(rim).Wire()).Face();
}

Bnd_Box box_of(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  return box;
}

// A face to be put in.
struct Candidate {
  TopoDS_Shape face{};
  ShapeLabel label{};
  bool is_asked = false;  // By the case.
};

class Embedding {
 public:
  Embedding(std::vector<Candidate> candidates, CadFile& cad)
      : candidates_(std::move(candidates)), cad_(cad), given_(parts_of(cad.shape, TopAbs_SOLID))
  {
  }

  void run()
  {
    drop_far_ones();
    if (candidates_.empty()) return tell_of_those_outside();
    fuse();
    const TopoDS_Shape before = cad_.shape;
    collect_solids();
    require_same_volumes(before);
    note_faces();
    note_pieces(before);
    follow_names(before, cad_.names,
                 [&](const TopoDS_Shape& part) { return fuse_.Modified(part); });
  }

 private:
  void fuse()
  {
    TopTools_ListOfShape arguments;
    for (std::size_t s = 0; s < given_.size(); ++s) {
      if (is_near_[s]) arguments.Append(given_[s]);
    }
    for (const Candidate& candidate : candidates_) arguments.Append(candidate.face);
    fuse_.SetArguments(arguments);
    fuse_.SetNonDestructive(Standard_True);
    fuse_.SetRunParallel(Standard_False);
    fuse_.Build();
    if (fuse_.HasErrors()) fail("OpenCASCADE cannot put {} into the solids");
  }

  // Solids that no face is near stay as they are: where they only touch others, a fuse would leave
  // but pieces of curves.
  void drop_far_ones()
  {
    std::vector<Bnd_Box> boxes;
    for (const TopoDS_Shape& solid : given_) boxes.push_back(box_of(solid));
    is_near_.assign(given_.size(), false);
    std::erase_if(candidates_, [&](const Candidate& candidate) {
      const Bnd_Box of_face = box_of(candidate.face);
      bool is_far = true;
      for (std::size_t s = 0; s < boxes.size(); ++s) {
        if (boxes[s].IsOut(of_face)) continue;
        is_near_[s] = true;
        is_far = false;
      }
      if (is_far) note_outside(candidate);
      return is_far;
    });
  }

  void note_outside(const Candidate& candidate)
  {
    if (candidate.is_asked) {
      throw GeometryError(
          fmt::format("[[embed]] \"{}\" lies outside of all solids", candidate.label.name));
    }
    ++num_outside_;
  }

  void tell_of_those_outside()
  {
    if (num_outside_ == 0) return;
    cad_.repairs.push_back(
        fmt::format("faces that lie outside of all solids were left out: {}", num_outside_));
  }

  [[noreturn]] void fail(fmt::format_string<std::string> what) const
  {
    throw GeometryError(
        fmt::format(what, words_of_faces())
        + "; leave out what is near but not on a side of a solid, or set geometry.loose_faces to "
          "\"drop\" if they are the file's");
  }

  [[nodiscard]] std::string words_of_faces() const
  {
    std::string names;
    for (const Candidate& candidate : candidates_) {
      if (candidate.label.name.empty()) continue;
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", candidate.label.name);
    }
    return fmt::format("{} faces{}{}", candidates_.size(), names.empty() ? "" : " ", names);
  }

  void collect_solids()
  {
    Shapes solids;
    TopTools_MapOfShape added;
    const std::vector<LocalIndex> before = std::exchange(cad_.solid_body, {});
    for (std::size_t s = 0; s < given_.size(); ++s) {
      for (const TopoDS_Shape& image : images_of(given_[s], fuse_)) {
        if (!added.Add(image)) continue;
        solids.push_back(image);
        cad_.solid_body.push_back(before.empty() ? static_cast<LocalIndex>(s) + 1 : before[s]);
      }
    }
    cad_.shape = compound_of(solids);
  }

  void note_pieces(const TopoDS_Shape& before)
  {
    int number = 0;
    for (const TopoDS_Shape& face : parts_of(before, TopAbs_FACE)) {
      ++number;
      for (const TopoDS_Shape& image : images_of(face, fuse_)) cad_.given_face.Bind(image, number);
    }
    for (const Candidate& candidate : candidates_) {
      for (const TopoDS_Shape& image : images_of(candidate.face, fuse_))
        cad_.given_face.Bind(image, 0);
    }
  }

  void require_same_volumes(const TopoDS_Shape& before) const
  {
    const bool is_sound =
        have_volume_of(parts_of(cad_.shape, TopAbs_SOLID), before)
        && (BRepCheck_Analyzer(cad_.shape).IsValid() || !BRepCheck_Analyzer(before).IsValid());
    if (!is_sound) fail("OpenCASCADE put {} into the solids, which were not sound then");
  }

  // Those that solids have, with their names.
  void note_faces()
  {
    TopTools_IndexedMapOfShape of_solids;
    TopExp::MapShapes(cad_.shape, TopAbs_FACE, of_solids);
    const TopTools_MapOfShape inside = faces_inside_of_bodies(cad_.shape, cad_.solid_body);
    for (const Candidate& candidate : candidates_) {
      model::EmbeddedPart part{.name = candidate.label.name};
      for (const TopoDS_Shape& image : images_of(candidate.face, fuse_)) {
        if (!of_solids.Contains(image)) continue;
        ++part.num_faces;
        part.area += area_of(image);
        part.is_inside = part.is_inside || inside.Contains(image);
        if (!candidate.label.name.empty()) cad_.names.Bind(image, candidate.label);
      }
      if (part.num_faces > 0) {
        cad_.assembly.embedded.push_back(part);
      } else {
        note_outside(candidate);
      }
    }
    tell_of_those_outside();
  }

  std::vector<Candidate> candidates_;
  CadFile& cad_;
  Shapes given_;
  std::vector<bool> is_near_{};  // Of these, whether a face may touch it.
  BRepAlgoAPI_BuilderAlgo fuse_{};
  int num_outside_ = 0;
};

std::vector<Candidate> asked_faces(const std::vector<model::EmbeddedShape>& asked)
{
  std::vector<Candidate> candidates;
  for (const auto& [name, shape] : asked) {
    TopoDS_Face face;
    if (const auto* const polygon = std::get_if<model::Polygon>(&shape)) face = face_of(*polygon);
    if (const auto* const disk = std::get_if<model::Disk>(&shape)) face = face_of(*disk);
    if (!face.IsNull()) candidates.push_back({face, {.name = name}, true});
  }
  return candidates;
}

// What a file has inside of its solids already.
void note_inner_faces(CadFile& cad)
{
  for (const TopoDS_Shape& solid : parts_of(cad.shape, TopAbs_SOLID)) {
    for (const TopoDS_Shape& face : inner_faces_of(solid)) {
      cad.assembly.embedded.push_back({.name = label_in(cad.names, face).name,
                                       .num_faces = 1,
                                       .area = area_of(face),
                                       .is_inside = true});
    }
  }
}

std::vector<Candidate> faces_of_file(const std::vector<TopoDS_Shape>& loose, const CadFile& cad)
{
  std::vector<Candidate> candidates;
  for (const TopoDS_Shape& face : loose) candidates.push_back({face, label_in(cad.names, face)});
  return candidates;
}

}  // namespace

void embed_faces(const std::vector<TopoDS_Shape>& loose, const model::AssemblyOptions& options,
                 CadFile& cad)
{
  note_inner_faces(cad);
  if (!loose.empty() && options.loose_faces == model::LooseParts::embed) {
    Embedding(faces_of_file(loose, cad), cad).run();
    cad.given_face.Clear();  // Numbers of the file are those with its own faces.
  } else if (!loose.empty()) {
    cad.repairs.push_back(
        fmt::format("faces that belong to no solid were left out: {}", loose.size()));
  }
  std::vector<Candidate> asked = asked_faces(options.embedded);
  if (!asked.empty()) Embedding(std::move(asked), cad).run();
}

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
// Which closed and valid solids a CAD file holds, judged by OpenCASCADE alone, before Tessera has
// seen it: what the bench `corpus` counts by.
//
//   valid_solids FILE
//
// STEP, IGES, BREP: as read, unhealed; a solid counts if BRepCheck_Analyzer has nothing against it
// and all its shells are closed, and if no two of its faces cross each other by BOPAlgo_CheckerSI
// (asked of solids with up to 300 faces). STL: read by OpenCASCADE with equal corners joined; it
// counts as one solid if every directed edge has exactly one triangle, and its reverse one too.
// Prints one JSON object: with the counts also those of the faces (STL: triangles) and of the pairs
// of faces that cross, the largest tolerance of an edge or vertex, the diagonal of the box in
// OpenCASCADE's unit, and the smallest angles of the valid solids between faces and between edges,
// in degrees, null where there is none. Several solids are also looked at as a general fuse makes
// them, with the faces that they share (up to 300 faces). What cannot be read holds nothing.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <BOPAlgo_CheckerSI.hxx>
#include <BOPDS_DS.hxx>
#include <BOPDS_MapOfPair.hxx>
#include <BOPDS_Pair.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Bnd_Box.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <RWStl.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include "sharp_angles.hpp"

namespace {

constexpr int kMostFaces = 300;  // Of a shape that is compared with itself.

struct Findings {
  int num_solids = 0;
  int num_valid = 0;
  int num_faces = 0;
  int num_crossings = 0;
  double tolerance = 0.0;
  double diagonal = 0.0;
  SharpAngles sharp;
};

template <class Reader>
TopoDS_Shape read_with(Reader reader, const std::string& file)
{
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot be read");
  reader.TransferRoots();
  return reader.OneShape();
}

TopoDS_Shape read_brep(const std::string& file)
{
  TopoDS_Shape shape;
  if (!BRepTools::Read(shape, file.c_str(), BRep_Builder())) BinTools::Read(shape, file.c_str());
  return shape;
}

bool is_closed(const TopoDS_Shape& solid)
{
  TopExp_Explorer shells(solid, TopAbs_SHELL);
  bool closed = shells.More();
  for (; shells.More(); shells.Next()) closed = closed && BRep_Tool::IsClosed(shells.Current());
  return closed;
}

// Pairs of its faces that go through each other. BRepCheck looks at each face for itself.
int crossings_in(const TopoDS_Shape& solid)
{
  constexpr int kUpToFaceAndFace = 5;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  if (faces.Extent() > kMostFaces) return 0;
  TopTools_ListOfShape arguments;
  arguments.Append(solid);
  BOPAlgo_CheckerSI checker;
  checker.SetArguments(arguments);
  checker.SetLevelOfCheck(kUpToFaceAndFace);
  checker.SetNonDestructive(Standard_True);
  checker.Perform();
  int count = 0;
  const BOPDS_DS& found = checker.DS();
  for (BOPDS_MapOfPair::Iterator pair(found.Interferences()); pair.More(); pair.Next()) {
    int first = 0;
    int second = 0;
    pair.Value().Indices(first, second);
    const bool are_faces = found.Shape(first).ShapeType() == TopAbs_FACE
                           && found.Shape(second).ShapeType() == TopAbs_FACE;
    // A face with poles is said to cross itself there.
    count += are_faces && first != second ? 1 : 0;
  }
  return count;
}

void add(const SharpAngles& found, SharpAngles& to)
{
  to.of_faces = std::min(to.of_faces, found.of_faces);
  to.of_edges = std::min(to.of_edges, found.of_edges);
}

double diagonal_of(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

double diagonal_of(const Poly_Triangulation& surface)
{
  Bnd_Box box;
  for (int n = 1; n <= surface.NbNodes(); ++n) box.Add(surface.Node(n));
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

Findings look_at(const TopoDS_Shape& shape)
{
  if (shape.IsNull()) throw std::runtime_error("holds no shape");
  Findings findings;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  findings.num_faces = faces.Extent();
  findings.tolerance = ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1);
  findings.diagonal = diagonal_of(shape);
  TopTools_ListOfShape valid_solids;
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    ++findings.num_solids;
    const bool valid = BRepCheck_Analyzer(solids.Current()).IsValid();
    if (!valid || !is_closed(solids.Current())) continue;
    const int num_crossings = crossings_in(solids.Current());
    findings.num_crossings += num_crossings;
    if (num_crossings > 0) continue;
    ++findings.num_valid;
    valid_solids.Append(solids.Current());
    add(sharp_angles(solids.Current()), findings.sharp);
  }
  if (findings.num_valid > 1 && findings.num_faces <= kMostFaces) {
    add(sharp_angles_of_glued(valid_solids), findings.sharp);
  }
  return findings;
}

Findings look_at_stl(const std::string& file)
{
  const Handle(Poly_Triangulation) mesh = RWStl::ReadFile(file.c_str());
  if (mesh.IsNull()) throw std::runtime_error("cannot be read");
  std::map<std::pair<int, int>, int> directed_edges;
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    std::array<int, 3> corner{};
    mesh->Triangle(t).Get(corner[0], corner[1], corner[2]);
    for (std::size_t c = 0; c < 3; ++c) ++directed_edges[{corner[c], corner[(c + 1) % 3]}];
  }
  const bool closed = std::ranges::all_of(directed_edges, [&](const auto& entry) {
    const auto& [edge, count] = entry;
    return count == 1 && directed_edges.contains({edge.second, edge.first});
  });
  return {1,
          closed && mesh->NbTriangles() > 0 ? 1 : 0,
          mesh->NbTriangles(),
          0,
          0.0,
          diagonal_of(*mesh),
          sharp_angles(*mesh)};
}

std::string extension_of(const std::string& file)
{
  std::string extension = file.substr(std::min(file.rfind('.'), file.size()));
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Findings look_at_file(const std::string& file)
{
  const std::string extension = extension_of(file);
  if (extension == ".stl") return look_at_stl(file);
  if (extension == ".step" || extension == ".stp") {
    return look_at(read_with(STEPControl_Reader(), file));
  }
  if (extension == ".iges" || extension == ".igs") {
    return look_at(read_with(IGESControl_Reader(), file));
  }
  return look_at(read_brep(file));
}

std::string angle_or_null(double degrees)
{
  return degrees < 360.0 ? std::to_string(degrees) : "null";
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::fputs("usage: valid_solids FILE\n", stderr);
    return 64;
  }
  Message::DefaultMessenger()->ChangePrinters().Clear();  // Readers print statistics.
  try {
    const Findings found = look_at_file(argv[1]);
    std::printf("{\"solids\": %d, \"valid\": %d, \"faces\": %d, \"crossings\": %d, ",
                found.num_solids, found.num_valid, found.num_faces, found.num_crossings);
    std::printf("\"tolerance\": %g, ", found.tolerance);
    std::printf("\"diagonal_occ\": %.12g, ", found.diagonal);
    std::printf("\"face_angle_deg\": %s, \"edge_angle_deg\": %s}\n",
                angle_or_null(found.sharp.of_faces).c_str(),
                angle_or_null(found.sharp.of_edges).c_str());
    return EXIT_SUCCESS;
  } catch (const Standard_Failure& failure) {
    std::fprintf(stderr, "valid_solids: %s\n", failure.GetMessageString());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "valid_solids: %s\n", error.what());
  }
  return EXIT_FAILURE;
}

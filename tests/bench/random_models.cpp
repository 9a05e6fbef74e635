// SPDX-License-Identifier: BSD-3-Clause
// Random models with a known volume, for the bench random_booleans and for corpora.
//
//   random_models FOLDER COUNT [SEED [FIRST]]
//
// Model FIRST (default 1) to FIRST + COUNT - 1 of a seed: trees of boolean operations on boxes,
// cylinders, balls, cones (also with an apex) and tori, many of them with edges that coincide;
// extruded, turned and lofted profiles; rounded, cut and hollow parts; assemblies. Each is written
// as .step or .brep (assemblies: .brep, for common faces), a tree of booleans also as NETGEN's
// .geo. models.json lists them with their volume by OpenCASCADE.
//
// The same seed and number give the same model. Kept is only what BRepCheck calls valid: closed
// solids, two faces at each edge of a solid; whose volume is the same by two quadratures, and by
// its triangulation within 3 %; and of booleans that of their parts. Each try is a process of its
// own with a limit of CPU time, as OpenCASCADE may crash or not end; after that the next one is
// drawn.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Pnt.hxx>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "random_csg.hpp"
#include "random_parts.hpp"

namespace {

namespace fs = std::filesystem;

constexpr rlim_t most_cpu_s = 30;  // Of one try.
constexpr int most_tries = 50;
constexpr int most_faces = 200;

struct Model {
  std::string kind;
  TopoDS_Shape shape;
  std::string geo;  // Empty: no tree of booleans.
};

// `kind` in [0, 1) says what sort of model.
Model random_model(double kind, Dice& dice)
{
  if (kind < 0.4) {
    const std::unique_ptr<CsgTree> tree = random_tree(dice, 1 + dice.below(3));
    return {"booleans", shape_of(*tree), geo_of(*tree)};
  }
  if (kind < 0.6) {
    return {"dressed booleans", dressed(shape_of(*random_tree(dice, 1 + dice.below(2))), dice), ""};
  }
  if (kind < 0.75) return {"sweep", random_sweep(dice), ""};
  if (kind < 0.85) return {"dressed sweep", dressed(random_sweep(dice), dice), ""};
  return {"assembly", random_assembly(dice), ""};
}

void require_two_faces_at_each_edge(const TopoDS_Shape& solid)
{
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  for (int e = 1; e <= faces_of_edges.Extent(); ++e) {
    const bool is_point = BRep_Tool::Degenerated(TopoDS::Edge(faces_of_edges.FindKey(e)));
    if (!is_point && faces_of_edges(e).Extent() != 2) throw Rejected("an edge without two faces");
  }
}

// Of vertices and edges that more than one solid has, an assembly alone may have any.
void require_apart(const TopoDS_Shape& solids)
{
  TopTools_IndexedDataMapOfShapeListOfShape solids_of_vertices;
  TopExp::MapShapesAndAncestors(solids, TopAbs_VERTEX, TopAbs_SOLID, solids_of_vertices);
  for (int v = 1; v <= solids_of_vertices.Extent(); ++v) {
    TopTools_IndexedMapOfShape owners;
    for (const TopoDS_Shape& owner : solids_of_vertices(v)) owners.Add(owner);
    if (owners.Extent() > 1) throw Rejected("solids touch each other");
  }
}

// The valid closed solids alone, as one shape.
TopoDS_Shape solids_of(const TopoDS_Shape& shape)
{
  TopoDS_Compound solids;
  BRep_Builder builder;
  builder.MakeCompound(solids);
  TopoDS_Shape only;
  int count = 0;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next(), ++count) {
    for (TopExp_Explorer shell(solid.Current(), TopAbs_SHELL); shell.More(); shell.Next()) {
      if (!BRep_Tool::IsClosed(shell.Current())) throw Rejected("an open shell");
    }
    require_two_faces_at_each_edge(solid.Current());
    builder.Add(solids, solid.Current());
    only = solid.Current();
  }
  if (count == 0) throw Rejected("no solid");
  if (!BRepCheck_Analyzer(shape).IsValid()) throw Rejected("not valid");
  return count == 1 ? only : TopoDS_Shape(solids);
}

double volume_of(const Handle(Poly_Triangulation) & mesh, bool is_reversed)
{
  double volume = 0.0;
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    int a = 0, b = 0, c = 0;
    mesh->Triangle(t).Get(a, b, c);
    volume += mesh->Node(a).XYZ().DotCross(mesh->Node(b).XYZ(), mesh->Node(c).XYZ()) / 6.0;
  }
  return is_reversed ? -volume : volume;
}

void require_volume_of_triangles(const TopoDS_Shape& solids, double volume, double diagonal)
{
  const BRepMesh_IncrementalMesh mesh(solids, 1e-3 * diagonal, false, 0.2);
  double found = 0.0;
  for (TopExp_Explorer face(solids, TopAbs_FACE); face.More(); face.Next()) {
    TopLoc_Location place;
    const auto triangles = BRep_Tool::Triangulation(TopoDS::Face(face.Current()), place);
    if (triangles.IsNull()) return;  // Around an apex it fails on valid faces as well.
    if (!place.IsIdentity()) return;
    found += volume_of(triangles, face.Current().Orientation() == TopAbs_REVERSED);
  }
  if (std::abs(found - volume) > 0.03 * volume) throw Rejected("its triangles have another volume");
}

double diagonal_of(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  return std::sqrt(box.SquareExtent());
}

// Some shapes are no longer valid once OpenCASCADE has written and read them, or are others: a face
// may come back as the rest of its surface.
void require_same_step(const fs::path& file, double volume)
{
  STEPControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) throw Rejected("its STEP cannot be read");
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull() || !BRepCheck_Analyzer(shape).IsValid())
    throw Rejected("its STEP is not valid");
  if (std::abs(clean_volume(shape) - volume) > 1e-4 * volume)
    throw Rejected("its STEP has another volume");
}

void write_model(const TopoDS_Shape& shape, double volume, const fs::path& file)
{
  BRepTools::Clean(shape);  // Of the triangles.
  if (file.extension() == ".brep") {
    if (!BRepTools::Write(shape, file.c_str())) throw std::runtime_error("cannot write");
    return;
  }
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) throw Rejected("no STEP of it");
  if (writer.Write(file.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot write");
  require_same_step(file, volume);
}

// What a process makes: a file, and its line of the list in a file of its own.
struct Order {
  double kind = 0.0;  // The same for all tries, else those that fail often would be rare.
  std::uint64_t seed = 0;
  fs::path folder;
  std::string name;
  fs::path entry;
};

void make_model(const Order& order)
{
  Dice dice(order.seed);
  const Model model = random_model(order.kind, dice);
  const TopoDS_Shape solids = solids_of(model.shape);
  const bool is_assembly = model.kind == "assembly";
  if (!is_assembly) require_apart(solids);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solids, TopAbs_FACE, faces);
  if (faces.Extent() > most_faces) throw Rejected("too many faces");
  const double volume = clean_volume(solids), diagonal = diagonal_of(solids);
  require_volume_of_triangles(solids, volume, diagonal);
  const std::string file = order.name + (is_assembly || dice.chance(0.3) ? ".brep" : ".step");
  write_model(solids, volume, order.folder / file);
  const std::string geo = model.geo.empty() ? "" : order.name + ".geo";
  if (!geo.empty()) std::ofstream(order.folder / geo) << model.geo;
  std::ofstream out(order.entry);
  out.precision(15);
  out << "{\"name\": \"" << order.name << "\", \"kind\": \"" << model.kind << "\", \"file\": \""
      << file << "\", \"geo\": \"" << geo << "\", \"faces\": " << faces.Extent()
      << ", \"volume\": " << volume << ", \"diagonal\": " << diagonal << "}";
}

// What a process of its own does.
int try_model(const Order& order)
{
  const rlimit limit = {most_cpu_s, most_cpu_s};
  setrlimit(RLIMIT_CPU, &limit);
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  Message::DefaultMessenger()->ChangePrinters().Clear();  // Writers print statistics.
  try {
    make_model(order);
    return EXIT_SUCCESS;
  } catch (const Standard_Failure&) {  // OpenCASCADE's own, a model that it cannot make.
    return EXIT_FAILURE;
  } catch (const Rejected&) {
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "random_models: %s: %s\n", order.name.c_str(), error.what());
    return EXIT_FAILURE;
  }
}

std::string numbered(int number)
{
  std::string digits = std::to_string(number);
  return "random_" + std::string(4 - std::min<std::size_t>(digits.size(), 4), '0') + digits;
}

// The line of the list; empty if no try gave a model.
std::string entry_of(std::uint64_t seed, int number, const fs::path& folder)
{
  const std::uint64_t own = (seed * 1'000'003 + static_cast<std::uint64_t>(number)) * 1'009;
  Order order = {Dice(own).between(0.0, 1.0), 0, folder, numbered(number), folder / ".entry"};
  for (int attempt = 1; attempt <= most_tries; ++attempt) {
    order.seed = own + static_cast<std::uint64_t>(attempt);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) _exit(try_model(order));
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS) continue;
    std::string line;
    std::getline(std::ifstream(order.entry), line);
    fs::remove(order.entry);
    return line;
  }
  return "";
}

int make_models(const fs::path& folder, int count, std::uint64_t seed, int first)
{
  fs::create_directories(folder);
  std::ofstream list(folder / "models.json");
  list << "[";
  const char* separator = "\n";
  for (int number = first; number < first + count; ++number) {
    const std::string entry = entry_of(seed, number, folder);
    if (entry.empty()) throw std::runtime_error(numbered(number) + ": no try gave a model");
    list << separator << entry << std::flush;
    separator = ",\n";
  }
  list << "\n]\n";
  return list.good() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 3 || argc > 5) {
    std::fputs("usage: random_models FOLDER COUNT [SEED [FIRST]]\n", stderr);
    return 64;
  }
  try {
    const std::uint64_t seed = argc > 3 ? std::stoull(argv[3]) : 1;
    return make_models(argv[1], std::stoi(argv[2]), seed, argc > 4 ? std::stoi(argv[4]) : 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "random_models: %s\n", error.what());
    return EXIT_FAILURE;
  }
}

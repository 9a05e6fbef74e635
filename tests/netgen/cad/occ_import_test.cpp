// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "netgen/cad/hard_shapes.hpp"
#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;
using testing::own_model;

// A folder of this test's own, gone at its end.
class OccImport : public ::testing::Test {
 protected:
  OccImport()
      : folder_(fs::temp_directory_path()
                / ("tessera_"
                   + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name())))
  {
    fs::create_directories(folder_);
  }
  ~OccImport() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  [[nodiscard]] fs::path write_brep(const TopoDS_Shape& shape) const
  {
    BRepTools::Write(shape, (folder_ / "shape.brep").c_str());
    return folder_ / "shape.brep";
  }

  fs::path folder_;
};

std::string content_of(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TopoDS_Compound faces_of_box(int num_faces)
{
  TopoDS_Compound compound;
  BRep_Builder().MakeCompound(compound);
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  TopExp_Explorer faces(box, TopAbs_FACE);
  for (int i = 0; i < num_faces; ++i, faces.Next()) BRep_Builder().Add(compound, faces.Current());
  return compound;
}

// What import_model() says of the file.
template <class Expected>
std::string message_of(const fs::path& file)
{
  try {
    (void)netgen::import_model(file, {});
  } catch (const Expected& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error of the expected kind for " << file;
  return {};
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST_F(OccImport, MissingFileIsAnInputErrorThatNamesIt)
{
  EXPECT_TRUE(contains(message_of<InputError>(folder_ / "absent.step"), "absent.step"));
}

TEST_F(OccImport, EmptyFilesAreInputErrors)
{
  for (const char* name : {"a.step", "a.stp", "a.iges", "a.igs", "a.brep"}) {
    EXPECT_THROW((void)netgen::import_model(write(name, ""), {}), InputError) << name;
  }
}

TEST_F(OccImport, GarbageIsAnInputError)
{
  const std::string garbage(5000, '?');
  for (const char* name : {"a.step", "a.iges", "a.brep"}) {
    EXPECT_THROW((void)netgen::import_model(write(name, garbage), {}), InputError) << name;
  }
}

TEST_F(OccImport, TruncatedFilesAreInputErrorsWhereverTheyEnd)
{
  for (const char* name : {"cylinder.step", "frustum.iges", "cone.brep"}) {
    const std::string whole = content_of(own_model(name));
    for (const double part : {0.1, 0.5, 0.9}) {
      const auto size = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
      EXPECT_THROW((void)netgen::import_model(write(name, whole.substr(0, size)), {}), InputError)
          << name << " cut to " << size << " of " << whole.size() << " bytes";
    }
  }
}

// The root is the last line; the table before it ends with a solid, or not.
TEST_F(OccImport, BrepWithoutRootIsReadIfASolidComesLast)
{
  const std::string whole = content_of(own_model("cone.brep"));
  const std::size_t root = whole.rfind("+1 0");
  for (const std::string& text : {whole.substr(0, root), whole.substr(0, whole.rfind('*') + 1)}) {
    const model::ModelSource source = netgen::import_model(write("rootless.brep", text), {});
    ASSERT_EQ(source.repairs.size(), 1U);
    EXPECT_TRUE(contains(source.repairs[0], "no root shape")) << source.repairs[0];
    EXPECT_EQ(source.content, netgen::import_model(own_model("cone.brep"), {}).content);
  }
  std::string one_missing = whole.substr(0, root);
  one_missing.replace(one_missing.find("TShapes 11"), 10, "TShapes 12");
  EXPECT_TRUE(contains(message_of<InputError>(write("short.brep", one_missing)), "truncated"));
  const std::string shell_last = content_of(write_brep(faces_of_box(6)));
  const fs::path file = write("shell.brep", shell_last.substr(0, shell_last.rfind("+1 0")));
  EXPECT_TRUE(contains(message_of<InputError>(file), "truncated"));
}

TEST_F(OccImport, FileWithoutFacesSaysWhatItHolds)
{
  const fs::path file =
      write_brep(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Shape());
  const std::string message = message_of<GeometryError>(file);
  EXPECT_TRUE(contains(message, "no solid")) << message;
  EXPECT_TRUE(contains(message, "1 edge")) << message;
}

TEST_F(OccImport, OpenShellIsAGeometryErrorThatCountsOpenEdges)
{
  const std::string message = message_of<GeometryError>(write_brep(faces_of_box(5)));
  EXPECT_TRUE(contains(message, "5 faces")) << message;
  EXPECT_TRUE(contains(message, "4 edges")) << message;
}

TEST_F(OccImport, LooseFacesThatCloseAreSewnAndReported)
{
  const model::ModelSource source = netgen::import_model(write_brep(faces_of_box(6)), {});
  ASSERT_EQ(source.repairs.size(), 1U);
  EXPECT_TRUE(contains(source.repairs[0], "sewed 6 faces")) << source.repairs[0];
}

TEST_F(OccImport, CleanSolidNeedsNoRepair)
{
  for (const char* name : {"sphere.step", "cylinder.step", "torus.step", "bracket.step"}) {
    EXPECT_TRUE(netgen::import_model(own_model(name), {}).repairs.empty()) << name;
  }
}

// A cube of side 2 in a unit that STEP describes so. The unit is put into the text: the writer of
// OpenCASCADE 7.8 writes another unit, but leaves all numbers in millimetres.
std::string step_cube(const fs::path& folder, const std::string& unit)
{
  STEPControl_Controller::Init();
  STEPControl_Writer writer;
  writer.Transfer(BRepPrimAPI_MakeBox(2.0, 2.0, 2.0).Shape(), STEPControl_AsIs);
  writer.Write((folder / "cube.step").c_str());
  std::string text = content_of(folder / "cube.step");
  const std::string millimetre = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )";
  const std::size_t place = text.find(millimetre);
  if (place == std::string::npos) throw std::runtime_error("no unit in the file");
  text.replace(place, millimetre.size(), unit);
  const std::string inch =
      "#9001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9002);\n#9002 = " + millimetre
      + ";\n#9003 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n";
  return text.insert(text.rfind("ENDSEC;"), inch);
}

TEST_F(OccImport, UnitAndNumbersAreTheFiles)
{
  EXPECT_EQ(netgen::import_model(own_model("sphere.step"), {}).length_unit, "mm");

  const std::array<std::array<const char*, 2>, 3> units{
      {{"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) )", "m"},
       {"( CONVERSION_BASED_UNIT('INCH',#9001) LENGTH_UNIT() NAMED_UNIT(#9003) )", "in"},
       {"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.CENTI.,.METRE.) )", "cm"}}};
  for (const auto& [step, name] : units) {
    const fs::path file = write("box.step", step_cube(folder_, step));
    const model::ModelSource source = netgen::import_model(file, {});
    EXPECT_EQ(source.length_unit, name);
    EXPECT_NEAR(netgen::load_model(source)->box_diagonal(), 2.0 * std::sqrt(3.0), 1e-5);
    const model::ModelSource plain = netgen::import_model(file, {}, model::StepReader::plain);
    EXPECT_EQ(plain.length_unit, name);
    EXPECT_NEAR(netgen::load_model(plain)->box_diagonal(), 2.0 * std::sqrt(3.0), 1e-5);
  }
}

// The way in for a file that kills the reader with names: all but some names is the same.
TEST_F(OccImport, PlainStepReaderReadsTheSameShapesAndSaysWhatItLost)
{
  for (const char* name : {"sphere.step", "bracket.step", "two_blocks.step"}) {
    const model::ModelSource source = netgen::import_model(own_model(name), {});
    const model::ModelSource plain =
        netgen::import_model(own_model(name), {}, model::StepReader::plain);
    EXPECT_EQ(plain.length_unit, source.length_unit);
    ASSERT_FALSE(plain.repairs.empty());
    EXPECT_TRUE(contains(plain.repairs.front(), "plain reader")) << plain.repairs.front();
    const auto expected = netgen::describe_model(*netgen::load_model(source));
    const auto described = netgen::describe_model(*netgen::load_model(plain));
    EXPECT_EQ(described.faces.size(), expected.faces.size());
    ASSERT_EQ(described.solids.size(), expected.solids.size());
    double volume = 0.0;
    double expected_volume = 0.0;
    for (std::size_t s = 0; s < expected.solids.size(); ++s) {
      volume += described.solids[s].volume;
      expected_volume += expected.solids[s].volume;
    }
    EXPECT_NEAR(volume, expected_volume, 1e-9 * expected_volume) << name;
  }
}

TEST_F(OccImport, IgesKeepsInches)
{
  const model::ModelSource source = netgen::import_model(own_model("frustum.iges"), {});
  EXPECT_EQ(source.length_unit, "in");
  EXPECT_NEAR(netgen::load_model(source)->box_diagonal(), std::sqrt(12.0), 1e-5);
}

TEST_F(OccImport, SameFileGivesTheSameBytes)
{
  for (const char* name : {"bracket.step", "two_blocks.step", "frustum.iges"}) {
    const fs::path file = own_model(name);
    EXPECT_EQ(to_bytes(netgen::import_model(file, {})), to_bytes(netgen::import_model(file, {})));
  }
}

TEST_F(OccImport, TouchingSolidsAreGluedAndReported)
{
  const model::ModelSource source = netgen::import_model(own_model("two_blocks.step"), {});
  ASSERT_EQ(source.repairs.size(), 1U);
  EXPECT_TRUE(contains(source.repairs[0], "glued")) << source.repairs[0];
}

TEST_F(OccImport, OverlapOfNextToNothingBecomesAFaceAndNoSolid)
{
  const model::ModelSource source =
      netgen::import_model(write_brep(testing::overlapping_boxes(1e-6)), {});
  ASSERT_EQ(source.repairs.size(), 1U);
  EXPECT_TRUE(contains(source.repairs[0], "glued: 1 shared faces of area 0.36"))
      << source.repairs[0];
  const auto model = netgen::load_model(source);
  EXPECT_EQ(testing::coarse_mesh_of(*model, 0.5).num_materials(), 2);
}

TEST_F(OccImport, SolidsThatAreTangentAreNotJoinedThere)
{
  const model::ModelSource source =
      netgen::import_model(write_brep(testing::bearing({0.3, 3.7})), {});
  ASSERT_EQ(source.repairs.size(), 2U);
  EXPECT_EQ(source.repairs[0],
            "solids touch without a common face, and were left as they are there: 4 pairs");
  EXPECT_TRUE(contains(source.repairs[1], "glued: 1 shared faces")) << source.repairs[1];
  const auto model = netgen::load_model(source);
  const model::ModelDescription description = netgen::describe_model(*model);
  EXPECT_EQ(description.solids.size(), 5U);
  EXPECT_EQ(description.faces.size(), 20U);
  for (const model::EdgeDescription& edge : description.edges) EXPECT_GT(edge.length, 1.0);
}

TEST_F(OccImport, SolidsThatAreTangentAreMeshed)
{
  const auto model =
      netgen::load_model(netgen::import_model(write_brep(testing::bearing({0.3, 3.7})), {}));
  for (const auto mesher : {surface::SurfaceMesher::netgen, surface::SurfaceMesher::remesh}) {
    const mesh::CoarseMesh mesh = testing::coarse_mesh_of(*model, 8.0, mesher);
    EXPECT_EQ(mesh.num_materials(), 5);
    EXPECT_LT(mesh.num_tets(), 100000);
  }
}

}  // namespace
}  // namespace tessera

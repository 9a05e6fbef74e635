// SPDX-License-Identifier: BSD-3-Clause
// Writes our own STEP, IGES and BREP models. Run it by hand when a model changes:
//   build/bin/make_models configs/geometry
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace {

namespace fs = std::filesystem;

constexpr const char* kTimeStamp = "2026-01-01T00:00:00";  // Fixed: the same files at every run.

struct Part {
  TopoDS_Shape solid{};
  std::string name{};
  std::vector<std::string> face_names{};  // In TopExp::MapShapes order; may be empty.
};

Handle(TCollection_HAsciiString) text(const std::string& value)
{
  return new TCollection_HAsciiString(value.c_str());
}

void set_header(const Handle(StepData_StepModel) & model, const std::string& name)
{
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text(name));
  header.SetTimeStamp(text(kTimeStamp));
  header.SetAuthorValue(1, text("The Tessera authors"));
  header.SetOrganizationValue(1, text(""));
  header.SetPreprocessorVersion(text("OpenCASCADE"));
  header.SetOriginatingSystem(text("Tessera"));
  header.SetAuthorisation(text(""));
}

void write_step(const fs::path& file, const std::vector<Part>& parts)
{
  STEPControl_Controller::Init();
  Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  XCAFDoc_DocumentTool::Set(document->Main(), Standard_False);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  for (const Part& part : parts) {
    const TDF_Label label = shapes->AddShape(part.solid, Standard_False);
    TDataStd_Name::Set(label, part.name.c_str());
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(part.solid, TopAbs_FACE, faces);
    for (std::size_t f = 0; f < part.face_names.size(); ++f) {
      const TDF_Label face = shapes->AddSubShape(label, faces(static_cast<int>(f) + 1));
      TDataStd_Name::Set(face, part.face_names[f].c_str());
    }
  }
  STEPCAFControl_Writer writer;
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  writer.Transfer(document);
  set_header(writer.ChangeWriter().Model(), file.filename().string());
  writer.Write(file.c_str());
}

// An angle with a hole in each leg and a rounded inner corner.
TopoDS_Shape bracket()
{
  const TopoDS_Shape foot = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 40, 20, 5).Shape();
  const TopoDS_Shape wall = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 5, 20, 30).Shape();
  BRepAlgoAPI_Fuse legs(foot, wall);
  legs.SimplifyResult();
  BRepFilletAPI_MakeFillet fillet(legs.Shape());
  for (TopExp_Explorer edges(legs.Shape(), TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    const gp_Pnt first = BRep_Tool::Pnt(TopExp::FirstVertex(edge));
    const gp_Pnt last = BRep_Tool::Pnt(TopExp::LastVertex(edge));
    const auto inner = [](const gp_Pnt& p) { return p.X() == 5 && p.Z() == 5; };
    if (inner(first) && inner(last)) {
      fillet.Add(4, edge);
      break;
    }
  }
  const gp_Ax2 down(gp_Pnt(26, 10, -1), gp_Dir(0, 0, 1));
  const gp_Ax2 across(gp_Pnt(-1, 10, 20), gp_Dir(1, 0, 0));
  const TopoDS_Shape foot_hole = BRepPrimAPI_MakeCylinder(down, 5, 7).Shape();
  const TopoDS_Shape wall_hole = BRepPrimAPI_MakeCylinder(across, 4, 7).Shape();
  return BRepAlgoAPI_Cut(BRepAlgoAPI_Cut(fillet.Shape(), foot_hole).Shape(), wall_hole).Shape();
}

// A block whose upper half is narrower by a thousandth: a face and two edges that mean nothing.
TopoDS_Shape ledge()
{
  constexpr double kStep = 0.001;
  BRepAlgoAPI_Fuse both(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 4, 4, 1.5).Shape(),
                        BRepPrimAPI_MakeBox(gp_Pnt(kStep, 0, 1.5), 4 - kStep, 4, 1.5).Shape());
  both.SimplifyResult();
  return both.Shape();
}

void write_brep(const fs::path& file, const TopoDS_Shape& shape)
{
  BRepTools::Write(shape, file.c_str(), Standard_False, Standard_False,
                   TopTools_FormatVersion_VERSION_1);
}

// A cone without its tip, as loose faces and in inches: what most IGES files look like.
void write_iges(const fs::path& file)
{
  IGESControl_Controller::Init();
  IGESControl_Writer writer("INCH", 0);
  writer.AddShape(BRepPrimAPI_MakeCone(25.4, 12.7, 50.8).Shape());
  IGESData_GlobalSection header = writer.Model()->GlobalSection();
  header.SetFileName(text(file.filename().string()));
  header.SetAuthorName(text("The Tessera authors"));  // Else the name of who runs this.
  header.SetDate(text("20260101.000000"));
  header.SetLastChangeDate(text("20260101.000000"));
  writer.Model()->SetGlobalSection(header);
  writer.Write(file.c_str());
}

void write_all(const fs::path& folder)
{
  write_step(folder / "sphere.step", {{BRepPrimAPI_MakeSphere(10).Shape(), "sphere", {"skin"}}});
  write_step(folder / "cylinder.step",
             {{BRepPrimAPI_MakeCylinder(5, 20).Shape(), "cylinder", {"side", "top", "bottom"}}});
  write_step(folder / "torus.step", {{BRepPrimAPI_MakeTorus(10, 3).Shape(), "torus", {"skin"}}});
  write_step(folder / "bracket.step", {{bracket(), "bracket", {}}});
  write_step(folder / "two_blocks.step",
             {{BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 10, 10, 10).Shape(), "steel", {}},
              {BRepPrimAPI_MakeBox(gp_Pnt(10, 2, 2), 8, 6, 6).Shape(), "copper", {}}});
  write_iges(folder / "frustum.iges");
  write_brep(folder / "cone.brep", BRepPrimAPI_MakeCone(8, 0, 12).Shape());
  write_brep(folder / "ledge.brep", ledge());
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "usage: make_models FOLDER\n";
    return 64;
  }
  write_all(argv[1]);
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRep_Builder.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "cad/brep.hpp"
#include "cad/cad_file.hpp"
#include "cad/error.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

namespace fs = std::filesystem;

// Keeps OpenCASCADE's readers from printing statistics of every transfer.
class QuietMessages {
 public:
  QuietMessages() : saved_(Message::DefaultMessenger()->Printers())
  {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~QuietMessages() { Message::DefaultMessenger()->ChangePrinters() = saved_; }
  QuietMessages(const QuietMessages&) = delete;
  QuietMessages& operator=(const QuietMessages&) = delete;

 private:
  Message_SequenceOfPrinters saved_;
};

struct LengthUnit {
  std::string_view step_name;  // As OpenCASCADE spells it, lower case.
  std::string_view short_name;
  double metres;
};

constexpr std::array<LengthUnit, 12> kLengthUnits{{{"millimetre", "mm", 1e-3},
                                                   {"metre", "m", 1.0},
                                                   {"centimetre", "cm", 1e-2},
                                                   {"decimetre", "dm", 1e-1},
                                                   {"kilometre", "km", 1e3},
                                                   {"micrometre", "um", 1e-6},
                                                   {"nanometre", "nm", 1e-9},
                                                   {"inch", "in", 0.0254},
                                                   {"foot", "ft", 0.3048},
                                                   {"mile", "mi", 1609.344},
                                                   {"mil", "mil", 2.54e-5},
                                                   {"microinch", "uin", 2.54e-8}}};

std::string lower_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The last `size` characters of the file, for the marks that formats end with.
std::string tail_of(const fs::path& file, std::streamoff size)
{
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff length = in.tellg();
  in.seekg(std::max<std::streamoff>(0, length - size));
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// The unit whose numbers the shape shall have: the file's, or millimetres if it names none known.
LengthUnit step_unit(STEPControl_Reader& reader, CadFile& cad)
{
  TColStd_SequenceOfAsciiString lengths;
  TColStd_SequenceOfAsciiString angles;
  TColStd_SequenceOfAsciiString solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  if (lengths.IsEmpty()) return {"", "", 1e-3};
  const std::string name = lower_case(lengths.First().ToCString());
  for (const TCollection_AsciiString& other : lengths) {
    if (lower_case(other.ToCString()) == name) continue;
    cad.repairs.push_back(
        fmt::format("parts in {} converted to {}", lower_case(other.ToCString()), name));
  }
  const auto* known = std::find_if(kLengthUnits.begin(), kLengthUnits.end(),
                                   [&](const LengthUnit& unit) { return unit.step_name == name; });
  if (known != kLengthUnits.end()) return *known;
  cad.repairs.push_back(fmt::format("length unit '{}' converted to mm", name));
  return {"millimetre", "mm", 1e-3};
}

std::string name_of(const TDF_Label& label)
{
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  const TCollection_ExtendedString& wide = name->Get();
  std::string text(static_cast<std::size_t>(wide.LengthOfCString()) + 1, '\0');
  Standard_PCharacter to = text.data();
  wide.ToUTF8CString(to);
  text.resize(static_cast<std::size_t>(wide.LengthOfCString()));
  return text;
}

// OpenCASCADE names parts without a name after their kind.
bool is_default_name(const std::string& name)
{
  constexpr std::array<std::string_view, 9> kDefaults{
      "SOLID", "COMPOUND", "COMPSOLID", "SHELL", "FACE", "NAUO", "ASSEMBLY", "=>", "Open CASCADE"};
  return name.empty() || std::any_of(kDefaults.begin(), kDefaults.end(), [&](auto prefix) {
           return name.starts_with(prefix);
         });
}

// Collects the parts of an assembly, each at its place, and their names and colours.
class PartCollector {
 public:
  PartCollector(CadFile& cad, const TDF_Label& document)
      : cad_(cad), colours_(XCAFDoc_DocumentTool::ColorTool(document))
  {
    BRep_Builder().MakeCompound(parts_);
  }

  void collect(const TDF_Label& label, const TopLoc_Location& place)
  {
    if (XCAFDoc_ShapeTool::IsAssembly(label)) {
      TDF_LabelSequence components;
      XCAFDoc_ShapeTool::GetComponents(label, components);
      for (const TDF_Label& component : components) {
        TDF_Label part;
        if (!XCAFDoc_ShapeTool::GetReferredShape(component, part)) continue;
        collect(part, place * XCAFDoc_ShapeTool::GetLocation(component));
      }
      return;
    }
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label).Moved(place);
    BRep_Builder().Add(parts_, shape);
    label_parts(label, shape, place);
  }

  [[nodiscard]] const TopoDS_Compound& parts() const { return parts_; }

 private:
  void label_parts(const TDF_Label& label, const TopoDS_Shape& shape, const TopLoc_Location& place)
  {
    const ShapeLabel of_part = read_label(label);
    for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
      bind(solids.Current(), of_part);
    }
    TDF_LabelSequence children;
    XCAFDoc_ShapeTool::GetSubShapes(label, children);
    for (const TDF_Label& child : children) {
      bind(XCAFDoc_ShapeTool::GetShape(child).Moved(place), read_label(child));
    }
  }

  [[nodiscard]] ShapeLabel read_label(const TDF_Label& label) const
  {
    ShapeLabel read{.name = name_of(label)};
    if (is_default_name(read.name)) read.name.clear();
    Quantity_Color colour;
    if (colours_->GetColor(label, XCAFDoc_ColorSurf, colour)
        || colours_->GetColor(label, XCAFDoc_ColorGen, colour)) {
      read.colour = Quantity_Color::ColorToHex(colour).ToCString();
    }
    return read;
  }

  // A solid that is a part and a child of it: what the child says comes first.
  void bind(const TopoDS_Shape& shape, const ShapeLabel& label)
  {
    if (label.name.empty() && label.colour.empty()) return;
    ShapeLabel both = label;
    if (const ShapeLabel* const before = cad_.names.Seek(shape)) {
      if (both.name.empty()) both.name = before->name;
      if (both.colour.empty()) both.colour = before->colour;
    }
    cad_.names.Bind(shape, both);
  }

  CadFile& cad_;
  Handle(XCAFDoc_ColorTool) colours_;
  TopoDS_Compound parts_{};
};

void require_whole_step(const fs::path& file)
{
  if (tail_of(file, 4096).find("END-ISO-10303-21") != std::string::npos) return;
  throw InputError(file.string()
                   + ": does not end with END-ISO-10303-21, so it is truncated or no STEP file");
}

CadFile read_step(const fs::path& file)
{
  require_whole_step(file);
  STEPControl_Controller::Init();
  STEPCAFControl_Reader reader;
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  reader.SetNameMode(Standard_True);
  reader.SetColorMode(Standard_True);
  reader.SetLayerMode(Standard_False);
  reader.SetPropsMode(Standard_False);
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    throw InputError(file.string() + ": OpenCASCADE cannot read it as STEP; export it again");
  }
  CadFile cad;
  const LengthUnit unit = step_unit(reader.ChangeReader(), cad);
  cad.length_unit = unit.short_name;
  Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  XCAFDoc_DocumentTool::Set(document->Main(), Standard_False);
  XCAFDoc_DocumentTool::SetLengthUnit(document, unit.metres);
  if (!reader.Transfer(document)) {
    throw InputError(file.string() + ": holds no shape that OpenCASCADE can build");
  }
  TDF_LabelSequence roots;
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(roots);
  PartCollector collector(cad, document->Main());
  for (const TDF_Label& root : roots) collector.collect(root, TopLoc_Location());
  cad.shape = collector.parts();
  return cad;
}

std::string name_of(const IGESControl_Reader& reader, const TopoDS_Shape& shape)
{
  const auto entity = Handle(IGESData_IGESEntity)::DownCast(
      reader.WS()->TransferReader()->EntityFromShapeResult(shape, 1));
  if (entity.IsNull() || !entity->HasName()) return {};
  return entity->NameValue()->ToCString();
}

// The unit of an IGES file by the name in its global section; millimetres if it names none known.
LengthUnit iges_unit(const IGESControl_Reader& reader, CadFile& cad)
{
  constexpr std::array<std::array<std::string_view, 2>, 4> kAliases{
      {{"inch", "in"}, {"mi", "mi"}, {"uin", "uin"}, {"mils", "mil"}}};
  const auto text = reader.IGESModel()->GlobalSection().UnitName();
  std::string name = text.IsNull() ? std::string() : lower_case(text->ToCString());
  for (const auto& [alias, meaning] : kAliases) {
    if (name == alias) name = meaning;
  }
  const auto* known = std::find_if(kLengthUnits.begin(), kLengthUnits.end(),
                                   [&](const LengthUnit& unit) { return unit.short_name == name; });
  if (known != kLengthUnits.end()) return *known;
  if (!name.empty()) cad.repairs.push_back(fmt::format("length unit '{}' converted to mm", name));
  return {"millimetre", name.empty() ? "" : "mm", 1e-3};
}

// OpenCASCADE hands shapes out in millimetres; this takes it back to the file's own numbers.
void scale_to_unit(CadFile& cad, const LengthUnit& unit)
{
  cad.length_unit = unit.short_name;
  if (unit.metres == 1e-3) return;
  gp_Trsf scaling;
  scaling.SetScaleFactor(1e-3 / unit.metres);
  BRepBuilderAPI_Transform transform(cad.shape, scaling, Standard_True);
  ShapeNames names;
  for (ShapeNames::Iterator named(cad.names); named.More(); named.Next()) {
    names.Bind(transform.ModifiedShape(named.Key()), named.Value());
  }
  cad.names = names;
  cad.shape = transform.Shape();
}

std::string name_of(const STEPControl_Reader& reader, const TopoDS_Shape& shape)
{
  const auto item = Handle(StepRepr_RepresentationItem)::DownCast(
      reader.WS()->TransferReader()->EntityFromShapeResult(shape, 1));
  if (item.IsNull() || item->Name().IsNull()) return {};
  std::string name = item->Name()->ToCString();
  return is_default_name(name) || name == "NONE" ? std::string() : name;
}

// Another way in, for what kills the reader above: no document, no colours, one root after the
// other, and shapes are not fixed on the way. They are checked and healed afterwards all the same.
CadFile read_plain_step(const fs::path& file)
{
  require_whole_step(file);
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("read.step.sequence", "none");
  STEPControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    throw InputError(file.string() + ": OpenCASCADE cannot read it as STEP; export it again");
  }
  CadFile cad;
  const LengthUnit unit = step_unit(reader, cad);
  for (int root = 1; root <= reader.NbRootsForTransfer(); ++root) reader.TransferRoot(root);
  cad.shape = reader.OneShape();
  if (cad.shape.IsNull()) {
    throw InputError(file.string() + ": holds no shape that OpenCASCADE can build");
  }
  for (const TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_FACE, TopAbs_EDGE}) {
    for (TopExp_Explorer parts(cad.shape, kind); parts.More(); parts.Next()) {
      const std::string name = name_of(reader, parts.Current());
      if (!name.empty()) cad.names.Bind(parts.Current(), {.name = name});
    }
  }
  scale_to_unit(cad, unit);
  cad.repairs.emplace_back(
      "read by OpenCASCADE's plain reader: colours and names of parts are lost, names of shapes "
      "are "
      "kept");
  return cad;
}

CadFile read_iges(const fs::path& file)
{
  if (tail_of(file, 4096).find("T0000001") == std::string::npos) {
    throw InputError(file.string()
                     + ": has no terminate section, so it is truncated or no IGES file");
  }
  IGESControl_Controller::Init();
  IGESControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    throw InputError(file.string() + ": OpenCASCADE cannot read it as IGES; export it again");
  }
  reader.TransferRoots();
  CadFile cad;
  cad.shape = reader.OneShape();
  if (cad.shape.IsNull()) {
    throw InputError(file.string() + ": holds no shape that OpenCASCADE can build");
  }
  for (const TopAbs_ShapeEnum kind : {TopAbs_FACE, TopAbs_EDGE}) {
    for (const TopoDS_Shape& part : parts_of(cad.shape, kind)) {
      const std::string name = name_of(reader, part);
      if (!name.empty()) cad.names.Bind(part, {.name = name});
    }
  }
  scale_to_unit(cad, iges_unit(reader, cad));
  return cad;
}

}  // namespace

CadFile read_cad_file(const fs::path& file, model::StepReader reader)
{
  const QuietMessages quiet;
  const std::string extension = lower_case(file.extension().string());
  return with_occ_errors(file.string(), [&] {
    if (extension == ".step" || extension == ".stp") {
      return reader == model::StepReader::plain ? read_plain_step(file) : read_step(file);
    }
    if (extension == ".iges" || extension == ".igs") return read_iges(file);
    return read_brep(file);
  });
}

}  // namespace tessera::cad

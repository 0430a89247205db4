#include "fem/geometry/read_shapes.h"

#include "fem/geometry/step_materials.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TDF_ChildIterator.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

std::string name_of_label(const TDF_Label &label)
{
  Handle(TDataStd_Name) name;
  const std::string text =
      label.FindAttribute(TDataStd_Name::GetID(), name) ? TCollection_AsciiString(name->Get()).ToCString() : "";
  return text == "NONE" ? "" : text; // as some CAD programs write
}

/// Colours of whole solids are ignored.
std::vector<std::string> groups_of_face(const TDF_Label &face, const TDF_Label &document)
{
  std::vector<std::string> groups;
  Quantity_Color           colour;
  const auto               colours = XCAFDoc_DocumentTool::ColorTool(document);
  if (colours->GetColor(face, XCAFDoc_ColorSurf, colour) || colours->GetColor(face, XCAFDoc_ColorGen, colour))
  {
    std::string hex = Quantity_Color::ColorToHex(colour).ToCString();
    std::transform(hex.begin(), hex.end(), hex.begin(), [](unsigned char c) { return std::tolower(c); });
    groups.push_back(hex);
  }
  Handle(TColStd_HSequenceOfExtendedString) layers;
  if (XCAFDoc_DocumentTool::LayerTool(document)->GetLayers(face, layers))
    for (int i = 1; i <= layers->Length(); ++i)
      groups.push_back(TCollection_AsciiString(layers->Value(i)).ToCString());
  return groups;
}

/// The solid of a part that has but one, else the shape itself.
TopoDS_Shape named_shape(const TopoDS_Shape &shape)
{
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(shape, TopAbs_SOLID, solids);
  return solids.Extent() == 1 ? solids(1) : shape;
}

/// Parts come before their solids and faces, whose own names count.
void read_labels(CadShape &result, const TDF_Label &document)
{
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document);
  for (TDF_ChildIterator child(shapes->Label(), /* all levels */ true); child.More(); child.Next())
  {
    const TDF_Label label = child.Value();
    if (!XCAFDoc_ShapeTool::IsSimpleShape(label))
      continue;
    const TopoDS_Shape shape   = named_shape(XCAFDoc_ShapeTool::GetShape(label));
    const bool         is_face = shape.ShapeType() == TopAbs_FACE;
    const std::string  name    = name_of_label(label);
    const auto         groups  = is_face ? groups_of_face(label, document) : std::vector<std::string>();
    if (name.empty() && groups.empty())
      continue;
    ShapeLabel &own = result.labels[shape.TShape()];
    own.name        = name.empty() ? own.name : name;
    own.groups      = groups;
  }
}

int described_solids(const Handle(StepData_StepModel) & entities)
{
  int n = 0;
  for (int i = 1; i <= entities->NbEntities(); ++i)
    n += entities->Value(i)->IsKind(STANDARD_TYPE(StepShape_ManifoldSolidBrep));
  return n;
}

/// " at line 37", or nothing if reading went to the end.
std::string place_of(std::ifstream &in)
{
  in.exceptions(std::ios::goodbit);
  const bool at_end = in.eof();
  in.clear();
  const std::streamoff bytes = in.tellg();
  if (at_end || bytes < 0)
    return "";
  in.seekg(0);
  std::string text(static_cast<std::size_t>(bytes), '\0');
  in.read(text.data(), bytes);
  return " at line " + std::to_string(1 + std::count(text.begin(), text.end(), '\n'));
}

} // namespace

std::shared_ptr<CadShape> read_step(const CadSource &source)
{
  const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
  Handle(TDocStd_Document) document;
  application->NewDocument("MDTV-XCAF", document);
  STEPCAFControl_Reader reader; // declares the parameters
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  Interface_Static::SetCVal("xstep.cascade.unit", source.unit > 0. ? "MM" : "M");
  reader.SetColorMode(true);
  reader.SetLayerMode(true);
  reader.SetNameMode(true);
  for (const auto set :
       {&STEPCAFControl_Reader::SetPropsMode, &STEPCAFControl_Reader::SetSHUOMode, &STEPCAFControl_Reader::SetGDTMode,
        &STEPCAFControl_Reader::SetMatMode, &STEPCAFControl_Reader::SetViewMode})
    (reader.*set)(false);

  const auto result = std::make_shared<CadShape>();
  const bool done   = reader.ReadFile(source.path.c_str()) == IFSelect_RetDone && reader.Transfer(document);
  if (done)
  {
    result->whole       = reader.ChangeReader().OneShape();
    result->n_described = described_solids(reader.ChangeReader().StepModel());
    read_labels(*result, document->Main());
    read_step_materials(*result, reader.ChangeReader());
  }
  application->Close(document);
  if (!done)
    throw std::runtime_error("OpenCASCADE finds no shapes in it");
  return result;
}

std::shared_ptr<CadShape> read_brep(const CadSource &source)
{
  std::ifstream in(source.path, std::ios::binary);
  if (!in)
    throw std::invalid_argument(source.place + ": " + source.path + " cannot be read; check its permissions.");
  in.exceptions(std::ios::failbit | std::ios::badbit);
  const auto result = std::make_shared<CadShape>();
  try
  {
    BRepTools::Read(result->whole, in, BRep_Builder());
  }
  catch (const std::ios::failure &)
  {
    const std::string place = place_of(in);
    throw std::invalid_argument(
        source.place + ": " + source.path + " is damaged" +
        (place.empty() ? ": it ends before its shapes are complete: a count is too large or an entry is missing"
                       : place + ": a number is expected at this point") +
        "; copy or export it again.");
  }
  return result;
}

} // namespace gestell::fem

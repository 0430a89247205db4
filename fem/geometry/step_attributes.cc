#include "fem/geometry/step_attributes.h"

#include "fem/geometry/step_text.h"

#include <gmsh.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Bnd_Box.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDocStd_Document.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <type_traits>

namespace gestell::fem
{

namespace
{

struct StyledFace
{
  TopoDS_Shape             shape;
  Bnd_Box                  box;
  std::vector<std::string> groups;
};

/// Goes down the assembly and collects the faces that have a layer or a colour of their own.
class StyledFaces
{
public:
  explicit StyledFaces(const Handle(TDocStd_Document) & document)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colours_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
        layers_(XCAFDoc_DocumentTool::LayerTool(document->Main()))
  {
    TDF_LabelSequence roots;
    shapes_->GetFreeShapes(roots);
    for (int i = 1; i <= roots.Length(); ++i)
      visit(roots.Value(i), TopLoc_Location());
  }

  std::vector<StyledFace> result;

private:
  void visit(const TDF_Label &label, const TopLoc_Location &location)
  {
    TDF_LabelSequence below;
    if (XCAFDoc_ShapeTool::IsAssembly(label))
    {
      XCAFDoc_ShapeTool::GetComponents(label, below);
      for (int i = 1; i <= below.Length(); ++i)
        if (TDF_Label part; XCAFDoc_ShapeTool::GetReferredShape(below.Value(i), part))
          visit(part, location * XCAFDoc_ShapeTool::GetLocation(below.Value(i)));
      return;
    }
    XCAFDoc_ShapeTool::GetSubShapes(label, below);
    for (int i = 1; i <= below.Length(); ++i)
      add(below.Value(i), location);
  }

  void add(const TDF_Label &label, const TopLoc_Location &location)
  {
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
    if (shape.IsNull() || shape.ShapeType() != TopAbs_FACE)
      return;
    StyledFace     face{shape.Moved(location), {}, {}};
    Quantity_Color colour;
    if (colours_->GetColor(label, XCAFDoc_ColorSurf, colour) || colours_->GetColor(label, XCAFDoc_ColorGen, colour))
    {
      std::string hex = Quantity_Color::ColorToHex(colour).ToCString();
      std::transform(hex.begin(), hex.end(), hex.begin(), [](unsigned char c) { return std::tolower(c); });
      face.groups.push_back(hex);
    }
    Handle(TColStd_HSequenceOfExtendedString) names;
    if (layers_->GetLayers(label, names))
      for (int i = 1; i <= names->Length(); ++i)
        face.groups.push_back(TCollection_AsciiString(names->Value(i)).ToCString());
    if (face.groups.empty())
      return;
    BRepBndLib::Add(face.shape, face.box);
    result.push_back(std::move(face));
  }

  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colours_;
  Handle(XCAFDoc_LayerTool) layers_;
};

std::vector<StyledFace> read_styles(const std::string &path)
{
  const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
  Handle(TDocStd_Document) document;
  application->NewDocument("MDTV-XCAF", document);
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetLayerMode(true);
  reader.SetNameMode(true);
  std::vector<StyledFace> faces;
  if (reader.ReadFile(path.c_str()) == IFSelect_RetDone && reader.Transfer(document))
    faces = StyledFaces(document).result;
  application->Close(document);
  return faces;
}

/// Whether a point of a face, given by its parameters, is in none of its holes.
/// @param is_inside  gmsh's function; later versions than 4.8 take coordinates as well, hence a flag
template <typename Function>
bool is_within(Function *is_inside, int tag, const std::vector<double> &uv)
{
  if constexpr (std::is_invocable_v<Function, int, int, const std::vector<double> &, bool>)
    return is_inside(2, tag, uv, true) > 0;
  else
    return is_inside(2, tag, uv) > 0;
}

/// A point of gmsh's face that is not in one of its holes, in gmsh's unit.
std::optional<gp_Pnt> point_within(int tag)
{
  std::vector<double> low, high;
  gmsh::model::getParametrizationBounds(2, tag, low, high);
  for (const int n : {3, 7, 17, 41}) // thin faces need many
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
      {
        const std::vector<double> uv = {low[0] + (high[0] - low[0]) * (i + 0.5) / n,
                                        low[1] + (high[1] - low[1]) * (j + 0.5) / n};
        if (!is_within(gmsh::model::isInside, tag, uv))
          continue;
        std::vector<double> x;
        gmsh::model::getValue(2, tag, uv, x);
        return gp_Pnt(x[0], x[1], x[2]);
      }
  return {};
}

} // namespace

void name_faces_of_step()
{
  STEPCAFControl_Controller::Init();
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
}

void add_step_attributes(std::vector<Face> &faces, const CadSource &source)
{
  if (!read_step_text(source.path).has_styles)
    return;
  const std::vector<StyledFace> styled = read_styles(source.path); // in the unit that gmsh set in OpenCASCADE
  for (Face &face : faces)
  {
    const auto point = point_within(face.tag);
    if (!point)
      continue;
    const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(*point);
    for (const StyledFace &style : styled)
    {
      Bnd_Box box = style.box;
      box.Enlarge(1e-6);
      if (box.IsOut(*point))
        continue;
      const BRepExtrema_DistShapeShape distance(vertex, style.shape);
      if (distance.IsDone() && distance.Value() < 1e-6)
        for (const std::string &group : style.groups)
          if (std::find(face.groups.begin(), face.groups.end(), group) == face.groups.end())
            face.groups.push_back(group);
    }
  }
}

} // namespace gestell::fem

#include "apps/show/renderer.h"

#include "apps/output/values/colours.h"

#include <vtkActor.h>
#include <vtkActor2DCollection.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkStringArray.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWarpVector.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr const char *displacement = "displacement [m]", *stress = "von Mises stress [Pa]";

/// Colours from 0 to `most`; vectors are coloured by magnitude.
vtkSmartPointer<vtkLookupTable> field_colours(double most)
{
  vtkSmartPointer<vtkLookupTable> table = vtkSmartPointer<vtkLookupTable>::New();
  constexpr int                   n     = 64; // colours: steps that are not seen
  table->SetNumberOfTableValues(n);
  for (int i = 0; i < n; ++i)
  {
    const Colour c = scale_colour(i / (n - 1.));
    table->SetTableValue(i, c[0] / 255., c[1] / 255., c[2] / 255.);
  }
  table->SetVectorModeToMagnitude();
  table->SetTableRange(0., most > 0. ? most : 1.);
  return table;
}

vtkSmartPointer<vtkLookupTable> bodies_table(int n)
{
  vtkSmartPointer<vtkLookupTable> table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(n);
  for (int i = 0; i < n; ++i)
  {
    const auto &c = body_colour(static_cast<std::size_t>(i));
    table->SetTableValue(i, c[0] / 255., c[1] / 255., c[2] / 255.);
  }
  table->SetTableRange(1., std::max(n, 2));
  return table;
}

/// Upper end of the stress colours: the largest value away from rigid surfaces; 0 for parts without stress.
double largest_stress(vtkPolyData *part)
{
  vtkDataArray *most = part->GetFieldData()->GetArray("largest stress [Pa]");
  return most && part->GetPointData()->GetArray(stress) ? most->GetTuple1(0) : 0.;
}

vtkStringArray *names_of(vtkPolyData *part)
{
  return vtkStringArray::SafeDownCast(part->GetFieldData()->GetAbstractArray("body names"));
}

} // namespace

Parts read_parts(const PictureFrame &frame)
{
  Parts parts;
  for (const auto &file : frame.parts)
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    if (!reader->CanReadFile(file.c_str()))
      throw std::invalid_argument(file.string() + ": is not a surface of VTK; run the scene again");
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkSmartPointer<vtkPolyData> part = reader->GetOutput();
    if (reader->GetErrorCode() != 0 || part->GetNumberOfPoints() == 0 || !part->GetPointData()->GetArray(displacement))
      throw std::invalid_argument(file.string() + ": is damaged, or has no " + displacement + "; run the scene again");
    parts.push_back(part);
  }
  return parts;
}

double largest_displacement(const Parts &parts)
{
  double most = 0.;
  for (const auto &part : parts)
  {
    double range[2];
    part->GetPointData()->GetArray(displacement)->GetRange(range, -1);
    most = std::max(most, range[1]);
  }
  return most;
}

Renderer::Renderer(int width, int height)
{
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(4);
  window_->SetSize(width, height);
  window_->SetNumberOfLayers(2);
  scene_->SetBackground(1., 1., 1.);
  window_->AddRenderer(scene_);
  corner_->SetViewport(0., 0., .17, .2);
  corner_->SetLayer(1);
  window_->AddRenderer(corner_);
  vtkNew<vtkAxesActor> axes;
  for (auto *label : {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D()})
  {
    label->GetTextActor()->SetTextScaleModeToNone();
    label->GetCaptionTextProperty()->SetFontSize(16);
    label->GetCaptionTextProperty()->SetColor(.1, .1, .1);
    label->GetCaptionTextProperty()->ShadowOff();
    label->GetCaptionTextProperty()->ItalicOff();
  }
  axes->SetXAxisLabelText("x");
  axes->SetYAxisLabelText("y");
  axes->SetZAxisLabelText("z");
  corner_->AddActor(axes);
  caption_->GetTextProperty()->SetFontSize(20);
  caption_->GetTextProperty()->SetColor(.1, .1, .1);
  caption_->SetPosition(16., height - 34.);
  bar_->SetTitle("frame [mm]");
  bar_->SetNumberOfLabels(5);
  bar_->SetUnconstrainedFontSize(true);
  for (auto *words : {bar_->GetTitleTextProperty(), bar_->GetLabelTextProperty()})
  {
    words->SetColor(.1, .1, .1);
    words->ShadowOff();
    words->ItalicOff();
    words->BoldOff();
    words->SetFontSize(15);
  }
  bar_->SetPosition(.88, .08);
  bar_->SetWidth(.1);
  bar_->SetHeight(.4);
}

Renderer::~Renderer() = default;

void Renderer::look_at(const double *box)
{
  const double centre[3] = {.5 * (box[0] + box[1]), .5 * (box[2] + box[3]), .5 * (box[4] + box[5])};
  vtkCamera   *camera    = scene_->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(centre);
  camera->SetPosition(centre[0] + .55, centre[1] - .75, centre[2] + .36);
  camera->SetViewUp(0., 0., 1.);
  scene_->ResetCamera(box);
  vtkCamera *small = corner_->GetActiveCamera();
  small->ParallelProjectionOn();
  small->SetFocalPoint(0., 0., 0.);
  small->SetPosition(.55, -.75, .36);
  small->SetViewUp(0., 0., 1.);
  corner_->ResetCamera();
  small->Zoom(1.1);
}

/// Frames by their displacement, with sharp edges; mechanisms by body.
void Renderer::add_part(vtkPolyData *part, double enlargement, double most)
{
  vtkNew<vtkWarpVector> warp;
  warp->SetInputData(part);
  warp->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, displacement);
  warp->SetScaleFactor(enlargement);
  vtkStringArray *names = names_of(part);

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(warp->GetOutputPort());
  if (names)
  {
    mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectColorArray("body");
    mapper->SetLookupTable(bodies_table(static_cast<int>(names->GetNumberOfValues())));
  }
  else if (const double top = largest_stress(part); top > 0. || most > 0.)
  {
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray(top > 0. ? stress : displacement);
    mapper->SetLookupTable(field_colours(top > 0. ? top : most));
    bar_->SetTitle(top > 0. ? "stress [MPa]" : "frame [mm]");
    bar_->SetLookupTable(field_colours(top > 0. ? 1e-6 * top : 1e3 * most));
  }
  else
    mapper->ScalarVisibilityOff();
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetPointSize(10.);
  actor->GetProperty()->SetColor(frame_colour[0] / 255., frame_colour[1] / 255., frame_colour[2] / 255.);
  if (!names)
    actor->GetProperty()->SetOpacity(part->GetNumberOfPolys() > 0 && !(largest_stress(part) > 0.) ? .55 : 1.);
  scene_->AddActor(actor);

  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(warp->GetOutputPort());
  edges->SetFeatureAngle(35.);
  edges->ColoringOff();
  vtkNew<vtkPolyDataMapper> lines;
  lines->SetInputConnection(edges->GetOutputPort());
  lines->ScalarVisibilityOff();
  vtkNew<vtkActor> drawn;
  drawn->SetMapper(lines);
  drawn->GetProperty()->SetColor(.06, .08, .1);
  drawn->GetProperty()->SetLineWidth(1.);
  drawn->GetProperty()->SetOpacity(.6);
  scene_->AddActor(drawn);
}

void Renderer::add_names(vtkPolyData *part)
{
  vtkStringArray *names = names_of(part);
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    vtkNew<vtkTextActor> name;
    name->SetInput(names->GetValue(i).c_str());
    name->GetTextProperty()->SetFontSize(17);
    name->GetTextProperty()->BoldOn();
    const auto &c = body_colour(static_cast<std::size_t>(i));
    name->GetTextProperty()->SetColor(c[0] / 255., c[1] / 255., c[2] / 255.);
    name->SetPosition(.8 * window_->GetSize()[0], window_->GetSize()[1] - 64. - 22. * static_cast<double>(i));
    scene_->AddActor2D(name);
  }
}

vtkSmartPointer<vtkImageData> Renderer::draw(const Parts &parts, double enlargement, double most,
                                             const std::string &caption, Sizes sizes)
{
  scene_->RemoveAllViewProps();
  bool has_frame = false;
  for (const auto &part : parts)
  {
    add_part(part, enlargement, most);
    add_names(part);
    has_frame = has_frame || !names_of(part);
  }
  caption_->SetInput(caption.c_str());
  scene_->AddActor2D(caption_);
  if (has_frame && most > 0. && sizes == Sizes::known)
    scene_->AddActor2D(bar_);
  scene_->ResetCameraClippingRange();
  window_->Render();
  vtkNew<vtkWindowToImageFilter> shot;
  shot->SetInput(window_);
  shot->SetInputBufferTypeToRGB();
  shot->ReadFrontBufferOff();
  shot->Update();
  return shot->GetOutput();
}

} // namespace gestell::apps

#include "apps/output/paraview/face_surface.h"

#include "apps/output/faces/faces_page.h"
#include "apps/output/text/write_file.h"
#include "apps/output/values/colours.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <stdexcept>

namespace gestell::apps
{
namespace
{

void set_geometry(vtkPolyData &poly, const coupling::FacePicture &picture)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto &x : picture.points)
    points->InsertNextPoint(x.data());
  vtkNew<vtkCellArray> cells;
  for (const auto &t : picture.triangles)
  {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  poly.SetPoints(points);
  poly.SetPolys(cells);
}

void set_faces(vtkPolyData &poly, const coupling::MeshReport &report)
{
  vtkNew<vtkIntArray>          number;
  vtkNew<vtkDoubleArray>       area;
  vtkNew<vtkUnsignedCharArray> colour;
  number->SetName("face");
  area->SetName("area [m^2]");
  colour->SetName("colour");
  colour->SetNumberOfComponents(3);
  for (const int index : report.picture.face)
  {
    const coupling::SurfaceReport &face = report.surfaces[static_cast<std::size_t>(index)];
    const Colour                   c    = face_colour(index);
    number->InsertNextValue(face.tag);
    area->InsertNextValue(face.area);
    colour->InsertNextTuple3(c[0], c[1], c[2]);
  }
  poly.GetCellData()->SetScalars(number);
  poly.GetCellData()->AddArray(area);
  poly.GetCellData()->AddArray(colour);
}

void set_entries(vtkPolyData &poly, const coupling::MeshReport &report)
{
  vtkNew<vtkIntArray>    faces;
  vtkNew<vtkStringArray> selectors;
  faces->SetName("faces");
  selectors->SetName("selectors");
  for (const coupling::SurfaceReport &face : report.surfaces)
  {
    faces->InsertNextValue(face.tag);
    selectors->InsertNextValue(face_entry(face));
  }
  poly.GetFieldData()->AddArray(faces);
  poly.GetFieldData()->AddArray(selectors);
}

} // namespace

std::string write_face_surface(const std::filesystem::path &path, const coupling::MeshReport &report)
{
  vtkNew<vtkPolyData> poly;
  set_geometry(*poly, report.picture);
  set_faces(*poly, report);
  set_entries(*poly, report);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(poly);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (writer->Write() == 0)
    throw std::runtime_error(path.string() + ": VTK cannot make this file");
  write_file(path, writer->GetOutputString());
  return "";
}

} // namespace gestell::apps

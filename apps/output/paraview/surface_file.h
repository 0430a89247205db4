#pragma once

#include "apps/output/paraview/surface_document.h"
#include "apps/output/text/write_file.h"
#include "fem/values/number_text.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Core>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Constant points and cells, set once, and a displacement that changes with time.
struct Surface
{
  vtkNew<vtkPolyData>   poly;
  vtkNew<vtkFloatArray> displacement;
  StillArrays           still{};

  Surface()
  {
    displacement->SetName("displacement [m]");
    displacement->SetNumberOfComponents(3);
    poly->GetPointData()->SetVectors(displacement);
  }

  template <typename Points>
  void set_points(const Points &points)
  {
    vtkNew<vtkPoints> vtk_points;
    vtk_points->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
    vtkIdType i = 0;
    for (const auto &x : points)
      vtk_points->SetPoint(i++, x[0], x[1], x[2]);
    poly->SetPoints(vtk_points);
    displacement->SetNumberOfTuples(i);
  }

  void set_triangles(const std::vector<std::array<int, 3>> &triangles)
  {
    vtkNew<vtkCellArray> cells;
    cells->Use32BitStorage();
    for (const auto &triangle : triangles)
    {
      const vtkIdType corners[3] = {triangle[0], triangle[1], triangle[2]};
      cells->InsertNextCell(3, corners);
    }
    poly->SetPolys(cells);
  }

  /// Adds a field of several components per point.
  template <typename Columns>
  void add_field(const char *name, const Columns &values)
  {
    vtkNew<vtkFloatArray> field;
    field->SetName(name);
    field->SetNumberOfComponents(static_cast<int>(values.rows()));
    field->SetNumberOfTuples(values.cols());
    for (Eigen::Index i = 0; i < values.size(); ++i)
      field->SetValue(i, static_cast<float>(values(i % values.rows(), i / values.rows())));
    poly->GetPointData()->AddArray(field);
  }

  /// Adds a number as field data of the whole surface.
  void note(const char *name, double value)
  {
    vtkNew<vtkDoubleArray> field;
    field->SetName(name);
    field->InsertNextValue(value);
    poly->GetFieldData()->AddArray(field);
  }

  void set_vertices()
  {
    vtkNew<vtkCellArray> cells;
    cells->Use32BitStorage();
    for (vtkIdType i = 0; i < poly->GetNumberOfPoints(); ++i)
      cells->InsertNextCell(1, &i);
    poly->SetVerts(cells);
  }

  void write(const std::filesystem::path &path) { write_file(path, surface_document(*poly, still)); }
};

/// A .pvd file: a collection of data sets with their time and part.
class Collection
{
public:
  /// @param name  of the part, where there are several
  void add(double time, int part, const std::string &file, const std::string &name = "")
  {
    entries_ += "    <DataSet timestep=\"" + exact_text(time) + "\" part=\"" + std::to_string(part) + "\" file=\"" +
                file + (name.empty() ? "" : "\" name=\"" + name) + "\"/>\n";
    ++size_;
  }
  std::size_t size() const { return size_; } ///< data sets so far
  std::string document() const
  {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
           "  <Collection>\n" +
           entries_ + "  </Collection>\n</VTKFile>\n";
  }

private:
  std::string entries_;
  std::size_t size_ = 0;
};

inline std::string numbered(const std::string &stem, std::size_t n)
{
  char digits[32];
  std::snprintf(digits, sizeof digits, "%05zu", n);
  return stem + digits + ".vtp";
}

} // namespace gestell::apps

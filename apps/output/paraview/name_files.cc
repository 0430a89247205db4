#include "apps/output/paraview/name_files.h"

#include "apps/output/paraview/surface_file.h"
#include "apps/output/pictures/mechanism_shapes.h"

#include <vtkStringArray.h>

#include <algorithm>
#include <numeric>

namespace gestell::apps
{
namespace
{

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d> &points)
{
  return std::accumulate(points.begin(), points.end(), Eigen::Vector3d(0., 0., 0.)) / double(points.size());
}

void write_names(const std::filesystem::path &path, const std::vector<Shape> &shapes)
{
  std::vector<Eigen::Vector3d> middles;
  vtkNew<vtkStringArray>       bodies;
  bodies->SetName("body");
  for (const Shape &shape : shapes)
  {
    middles.push_back(mean_of(shape.points));
    bodies->InsertNextValue(shape.name);
  }
  Surface surface;
  surface.set_points(middles);
  surface.set_vertices();
  for (std::size_t i = 0; i < shapes.size(); ++i)
    surface.displacement->SetTuple(vtkIdType(i), mean_of(shapes[i].displacement).data());
  surface.poly->GetPointData()->AddArray(bodies);
  surface.write(path);
}

} // namespace

void write_name_files(OwnFolder &folder, const Result &result, const std::vector<std::size_t> &pictures,
                      std::vector<std::string> &names)
{
  Collection collection;
  for (const std::size_t k : pictures)
  {
    std::vector<Shape> shapes = mechanism_shapes(result.scenery, result.run->picture_states[k]);
    if (!result.scenery.pins.empty()) // the last shape has all pins, which are not a body
      shapes.pop_back();
    const auto is_empty = [](const Shape &shape) { return shape.points.empty(); };
    shapes.erase(std::remove_if(shapes.begin(), shapes.end(), is_empty), shapes.end());
    if (shapes.empty())
      return;
    names.push_back(numbered("names/names_", collection.size()));
    write_names(folder.claim(names.back()), shapes);
    collection.add(result.run->picture_times[k], 0, names.back());
  }
  names.push_back("names.pvd");
  folder.write("names.pvd", collection.document());
}

} // namespace gestell::apps

#include "apps/output/paraview/force_files.h"

#include "apps/output/paraview/surface_file.h"

#include <vtkStringArray.h>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

/// Forces and torques at the places where they act, one point for each element and body, in one order at all times.
void write_forces(const fs::path &path, const std::vector<ActingForce> &forces)
{
  std::vector<Eigen::Vector3d> places;
  Eigen::Matrix3Xd             force(3, Eigen::Index(forces.size())), torque = force;
  vtkNew<vtkStringArray>       elements, bodies;
  elements->SetName("element");
  bodies->SetName("body");
  Surface surface;
  for (const ActingForce &one : forces)
  {
    force.col(Eigen::Index(places.size()))  = one.force;
    torque.col(Eigen::Index(places.size())) = one.torque;
    places.push_back(one.at);
    elements->InsertNextValue(one.name);
    bodies->InsertNextValue(one.body);
  }
  surface.set_points(places);
  surface.set_vertices();
  for (std::size_t i = 0; i < forces.size(); ++i)
    surface.displacement->SetTuple(static_cast<vtkIdType>(i), forces[i].displacement.data());
  surface.add_field("force [N]", force);
  surface.add_field("torque [N m]", torque);
  surface.poly->GetPointData()->AddArray(elements);
  surface.poly->GetPointData()->AddArray(bodies);
  surface.write(path);
}

} // namespace

std::vector<ActingForce> forces_at(const Result &result, std::size_t k)
{
  const coupling::RunResult &run = *result.run;
  if (!result.scenery.forces || run.picture_forces.size() != run.picture_states.size() ||
      run.picture_velocities.size() != run.picture_states.size())
    return {};
  return result.scenery.forces(run.picture_times[k], run.picture_states[k], run.picture_velocities[k],
                               run.picture_forces[k]);
}

void write_force_files(OwnFolder &folder, const Result &result, const std::vector<std::size_t> &pictures,
                       std::vector<std::string> &names)
{
  Collection collection;
  for (const std::size_t k : pictures)
  {
    const std::vector<ActingForce> forces = forces_at(result, k);
    if (forces.empty())
      return;
    const std::string file = numbered("forces/forces_", collection.size());
    names.push_back(file);
    write_forces(folder.claim(file), forces);
    collection.add(result.run->picture_times[k], 0, file);
  }
  names.push_back("forces.pvd");
  folder.write("forces.pvd", collection.document());
}

} // namespace gestell::apps

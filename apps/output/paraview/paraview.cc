#include "apps/output/paraview/paraview.h"

#include "apps/output/paraview/force_files.h"
#include "apps/output/paraview/name_files.h"
#include "apps/output/paraview/surface_file.h"
#include "apps/output/paraview/view_macro.h"
#include "apps/output/pictures/chosen_pictures.h"
#include "apps/output/pictures/machine_state.h"
#include "apps/output/pictures/mechanism_shapes.h"
#include "fem/values/number_text.h"

#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <string>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

/// The frame: its skin, or where it has none its interfaces as points.
class FrameSurface
{
public:
  explicit FrameSurface(const Scenery &scenery) : scenery_(scenery)
  {
    if (scenery.has_skin())
    {
      surface_.set_points(scenery.points);
      surface_.set_triangles(scenery.triangles);
      return;
    }
    std::vector<std::array<double, 3>> positions;
    for (const auto &interface : scenery.interface_positions)
      positions.push_back(interface.second);
    surface_.set_points(positions);
    surface_.set_vertices();
  }

  bool empty() const { return surface_.poly->GetNumberOfPoints() == 0; }

  /// Displacement [3 points; m] for the machine's or the frame's coordinates.
  Eigen::VectorXd displacement(const Eigen::VectorXd &q) const
  {
    if (scenery_.has_skin())
      return scenery_.displacement(q.head(scenery_.n_frame));
    Eigen::VectorXd u(3 * static_cast<long>(scenery_.interfaces.size()));
    for (std::size_t i = 0; i < scenery_.interfaces.size(); ++i)
      u.segment<3>(3 * static_cast<long>(i)) = translation(scenery_.interfaces[i], q);
    return u;
  }

  /// @param v  [3 points; m/s]; empty: unknown
  void write(const fs::path &path, const Eigen::VectorXd &u, const Eigen::VectorXd &v = {})
  {
    if (v.size() > 0)
      surface_.add_field("velocity [m/s]", Eigen::Map<const Eigen::Matrix3Xd>(v.data(), 3, v.size() / 3));
    for (long i = 0; i < u.size(); ++i)
      surface_.displacement->SetValue(i, static_cast<float>(u(i)));
    surface_.write(path);
  }

  double size() const { return surface_.poly->GetLength(); }
  void   note(const char *name, double value) { surface_.note(name, value); }

private:
  const Scenery &scenery_;
  Surface        surface_;
};

/// Names of the bodies as field data: the `body` of a cell counts them from 1.
void add_names(vtkPolyData &poly, const std::vector<Shape> &shapes)
{
  vtkNew<vtkStringArray> names;
  names->SetName("body names");
  for (const Shape &shape : shapes)
    names->InsertNextValue(shape.name);
  poly.GetFieldData()->AddArray(names);
}

/// All bodies in one surface; cell data distinguish them.
/// @param velocities  [m/s] of all points, in the order of the shapes; empty: unknown
void write_mechanism(const fs::path &path, const std::vector<Shape> &shapes,
                     const std::vector<Eigen::Vector3d> &velocities = {})
{
  std::vector<Eigen::Vector3d>    points, displacements;
  std::vector<std::array<int, 3>> triangles;
  vtkNew<vtkIntArray>             body;
  body->SetName("body");
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    const Shape &shape = shapes[i];
    const int    first = static_cast<int>(points.size());
    points.insert(points.end(), shape.points.begin(), shape.points.end());
    displacements.insert(displacements.end(), shape.displacement.begin(), shape.displacement.end());
    for (const auto &t : shape.triangles)
    {
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
      body->InsertNextValue(static_cast<int>(i + 1));
    }
  }
  Surface surface;
  surface.set_points(points);
  surface.set_triangles(triangles);
  surface.poly->GetCellData()->AddArray(body);
  add_names(*surface.poly, shapes);
  if (!velocities.empty())
    surface.add_field("velocity [m/s]", Eigen::Map<const Eigen::Matrix3Xd>(velocities.front().data(), 3,
                                                                           static_cast<long>(velocities.size())));
  for (std::size_t i = 0; i < displacements.size(); ++i)
    surface.displacement->SetTuple(static_cast<vtkIdType>(i), displacements[i].data());
  surface.write(path);
}

/// Velocities [m/s] of the points of the bodies: their places at q + v dt less those at q - v dt, by 2 dt.
std::vector<Eigen::Vector3d> body_velocities(const Scenery &scenery, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  const double             largest = v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.;
  const double             dt      = largest > 0. ? 1e-5 / largest : 1.; // 10 um or 10 urad
  const std::vector<Shape> before  = mechanism_shapes(scenery, q - dt * v),
                           after   = mechanism_shapes(scenery, q + dt * v);
  std::vector<Eigen::Vector3d> velocities;
  for (const auto &shape : differences(scenery, before, after))
    for (const Eigen::Vector3d &moved : shape)
      velocities.push_back(moved / (2. * dt));
  return velocities;
}

/// @param u  [3 points]
double largest_point(const Eigen::VectorXd &u)
{
  return u.size() > 0 ? Eigen::Map<const Eigen::Matrix3Xd>(u.data(), 3, u.size() / 3).colwise().norm().maxCoeff() : 0.;
}

void write_frame_modes(OwnFolder &folder, const Result &result, std::vector<std::string> &names)
{
  FrameSurface frame(result.scenery);
  if (frame.empty() || result.frame_modes.empty())
    return;

  Collection collection;
  for (std::size_t j = 0; j < result.frame_modes.size(); ++j)
  {
    Eigen::VectorXd u       = frame.displacement(result.frame_modes[j].shape);
    const double    largest = largest_point(u);
    if (largest > 0.)
      u *= shown_size * (frame.size() > 0. ? frame.size() : 1.) / largest;
    frame.note("frequency [Hz]", result.frame_modes[j].frequency_hz);
    const std::string file = numbered("frame_modes/mode_", j + 1);
    names.push_back(file);
    frame.write(folder.claim(file), u);
    collection.add(static_cast<double>(j + 1), 0, file);
  }
  names.push_back("frame_modes.pvd");
  folder.write("frame_modes.pvd", collection.document());
}

double largest_of(const std::vector<std::vector<Eigen::Vector3d>> &shapes)
{
  double largest = 0.;
  for (const auto &shape : shapes)
    for (const Eigen::Vector3d &u : shape)
      largest = std::max(largest, u.norm());
  return largest;
}

/// Frame and mechanism together, as write_frame_modes() writes the frame; not for a run, whose page shows them.
void write_coupled_modes(OwnFolder &folder, const Result &result, std::vector<std::string> &names)
{
  if (result.run || result.coupled_modes.empty() || result.modes_at.size() == 0 ||
      (result.scenery.bodies.empty() && result.scenery.n_frame == 0))
    return;
  FrameSurface       frame(result.scenery);
  Collection         collection;
  std::vector<Shape> shapes = mechanism_shapes(result.scenery, result.modes_at);
  const double       size   = shown_size * machine_state(result.scenery, result.modes_at).size();
  for (std::size_t j = 0; j < result.coupled_modes.size(); ++j)
  {
    const coupling::Mode &mode    = result.coupled_modes[j];
    const Eigen::VectorXd u       = frame.displacement(mode.shape);
    const auto            bodies  = body_mode(result.scenery, result.modes_at, mode.shape);
    const double          largest = std::max(result.scenery.has_skin() ? largest_point(u) : 0., largest_of(bodies));
    const double          times   = largest > 0. ? size / largest : size;
    int                   part    = 0;
    const auto            file    = [&](const std::string &part_name)
    {
      names.push_back(numbered("coupled_modes/" + part_name + '_', j + 1));
      collection.add(static_cast<double>(j + 1), part++, names.back(), part_name);
      return folder.claim(names.back());
    };
    frame.note("frequency [Hz]", mode.frequency_hz);
    if (!frame.empty())
      frame.write(file("frame"), times * u);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t p = 0; p < bodies[i].size(); ++p)
        shapes[i].displacement[p] = times * bodies[i][p];
    if (!shapes.empty())
      write_mechanism(file("mechanism"), shapes);
  }
  names.push_back("coupled_modes.pvd");
  folder.write("coupled_modes.pvd", collection.document());
}

/// View of the main peak or, if there is none, of the start of the motion.
ViewMacro macro_of(const Result &result, const std::vector<std::size_t> &pictures)
{
  const coupling::RunResult &run = *result.run;
  const auto         early       = [&](std::size_t k) { return result.peak && run.picture_times[k] < result.peak->t; };
  const std::size_t  k           = *std::partition_point(pictures.begin(), pictures.end() - 1, early);
  const MachineState state       = machine_state(result.scenery, run.picture_states[k]);
  ViewMacro          view;
  view.time        = run.picture_times[k];
  view.size        = state.size();
  view.enlargement = std::max(shown_enlargement(state), 1.);
  if (k < run.picture_velocities.size())
    for (const Eigen::Vector3d &v : body_velocities(result.scenery, run.picture_states[k], run.picture_velocities[k]))
      view.speed = std::max(view.speed, v.norm());
  for (const ActingForce &force : forces_at(result, k))
    view.force = std::max(view.force, force.force.norm());
  return view;
}

/// Bytes of files that are written.
double bytes_of(const OwnFolder &folder, const std::vector<std::string> &names)
{
  double bytes = 0.;
  for (const std::string &name : names)
  {
    std::error_code none; // a file that could not be written
    const auto      size = fs::file_size(folder.path() / name, none);
    bytes += none ? 0. : double(size);
  }
  return bytes;
}

/**
 * At most a hundred pictures, as many as keep all files within 20 MB; where these leave no room, a film of one swing or
 * two.  All pictures if large results are allowed.
 */
std::vector<std::size_t> pictures_of_motion(const Result &result, double bytes_of_a_picture, double bytes_of_others)
{
  constexpr double most = 100., film = 24., least = 3.; // least: the ends and the peak
  constexpr double most_bytes = 19.5e6;                 // forces, names and summary.json, which come later, take 0.5 MB
  const double     alone = most_bytes / bytes_of_a_picture, room = (most_bytes - bytes_of_others) / bytes_of_a_picture;
  const bool       all = result.requested.run && result.requested.run->allow_large;
  return chosen_pictures(result, all ? result.run->picture_states.size()
                                     : std::size_t(std::clamp(std::max(room, std::min(alone, film)), least, most)));
}

/// Files of the motion at saved state k.
void write_picture(OwnFolder &folder, const Result &result, std::size_t k, std::size_t number, FrameSurface &frame,
                   Collection &collection, std::vector<std::string> &names)
{
  const coupling::RunResult &run  = *result.run;
  const Eigen::VectorXd     &q    = run.picture_states[k];
  int                        part = 0;
  const auto                 file = [&](const std::string &part_name)
  {
    names.push_back(numbered("motion/" + part_name + '_', number));
    collection.add(run.picture_times[k], part++, names.back(), part_name);
    return folder.claim(names.back());
  };
  const bool            moves = k < run.picture_velocities.size();
  const Eigen::VectorXd v     = moves ? run.picture_velocities[k] : Eigen::VectorXd();
  if (!frame.empty())
    frame.write(file("frame"), frame.displacement(q), moves ? frame.displacement(v) : v);
  const std::vector<Shape> shapes = mechanism_shapes(result.scenery, q);
  if (!shapes.empty())
    write_mechanism(file("mechanism"), shapes,
                    moves ? body_velocities(result.scenery, q, v) : std::vector<Eigen::Vector3d>());
}

void write_motion(OwnFolder &folder, const Result &result, std::vector<std::string> &names)
{
  if (!result.run || result.run->picture_states.empty())
    return;
  FrameSurface      frame(result.scenery);
  Collection        collection, tried;
  const double      others = bytes_of(folder, names);
  const std::size_t before = names.size();
  // The last picture gives the size of one; the displacements of the first may be zero.
  write_picture(folder, result, result.run->picture_states.size() - 1, 0, frame, tried, names);
  const std::vector<std::size_t> pictures =
      pictures_of_motion(result, std::max(1., bytes_of(folder, names) - others), others);
  names.resize(before);
  for (std::size_t number = 0; number < pictures.size(); ++number)
    write_picture(folder, result, pictures[number], number, frame, collection, names);
  names.push_back("motion.pvd");
  folder.write("motion.pvd", collection.document());
  write_force_files(folder, result, pictures, names);
  write_name_files(folder, result, pictures, names);
  names.push_back("view.py");
  folder.write("view.py", view_macro(macro_of(result, pictures)));
}

void write_stress(OwnFolder &folder, const Result &result, std::vector<std::string> &names)
{
  if (!result.stress || result.stress->instants.empty())
    return;
  const StressResult &stress = *result.stress;
  Collection          collection;
  for (std::size_t k = 0; k < stress.instants.size(); ++k)
  {
    const StressAt  &at = stress.instants[k];
    Eigen::Matrix3Xd principal(3, at.field.von_mises.size()), first(principal);
    for (Eigen::Index i = 0; i < principal.cols(); ++i)
    {
      const auto values = coupling::principal_stresses(at.field.at(static_cast<int>(i)));
      principal.col(i)  = values.values;
      first.col(i)      = values.first;
    }
    Surface surface;
    surface.set_points(stress.points);
    surface.set_triangles(stress.triangles);
    for (Eigen::Index i = 0; i < at.displacement.size(); ++i)
      surface.displacement->SetValue(i, static_cast<float>(at.displacement(i % 3, i / 3)));
    surface.add_field("von Mises stress [Pa]", at.field.von_mises.transpose());
    surface.add_field("principal stresses [Pa]", principal);
    surface.add_field("first principal direction", first);
    surface.add_field("stress xx yy zz xy yz xz [Pa]", at.field.components);
    if (at.peak)
      surface.note("largest stress [Pa]", at.peak->von_mises);
    const std::string file = numbered("stress/stress_", k + 1);
    names.push_back(file);
    surface.write(folder.claim(file));
    collection.add(at.t, 0, file);
  }
  names.push_back("stress.pvd");
  folder.write("stress.pvd", collection.document());
}

} // namespace

std::string lacks_for_paraview()
{
  return "";
}

const std::vector<WriteSeries *> &paraview_series()
{
  static const std::vector<WriteSeries *> series = {write_frame_modes, write_coupled_modes, write_motion, write_stress};
  return series;
}

} // namespace gestell::apps

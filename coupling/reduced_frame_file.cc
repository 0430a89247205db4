#include "coupling/reduced_frame_file.h"

#include "coupling/hdf5_file.h"
#include "coupling/reduced_stress_file.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <unistd.h>

namespace gestell::coupling
{

namespace
{

namespace fs = std::filesystem;
using Eigen::MatrixXd;

constexpr const char *format  = "Gestell reduced frame";
constexpr int         version = 4;

MatrixXd number(double x)
{
  return MatrixXd::Constant(1, 1, x);
}

template <typename Matrix, typename Points>
Matrix columns(const Points &points)
{
  Matrix A(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int d = 0; d < 3; ++d)
      A(d, i) = points[i][d];
  return A;
}

template <typename Point, typename Matrix>
std::vector<Point> points(const Matrix &A)
{
  std::vector<Point> result(A.rows() == 3 ? A.cols() : 0);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (int d = 0; d < 3; ++d)
      result[i][d] = A(d, i);
  return result;
}

void write_interface(Hdf5File &file, const std::string &at, const fem::Interface &interface)
{
  file.write(at + "name", interface.name);
  file.write(at + "position", MatrixXd(Eigen::Vector3d(interface.position.data())));
  file.write(at + "coordinate",
             Eigen::MatrixXi(Eigen::Map<const Eigen::Matrix<int, 6, 1>>(interface.coordinate.data())));
  file.write(at + "sign", MatrixXd(Eigen::Map<const Eigen::Matrix<double, 6, 1>>(interface.sign.data())));
}

fem::Interface read_interface(const Hdf5File &file, const std::string &at)
{
  fem::Interface interface;
  interface.name        = file.read_text(at + "name");
  const auto position   = file.read_vector(at + "position");
  const auto coordinate = file.read_integers(at + "coordinate");
  const auto sign       = file.read_vector(at + "sign");
  if (position.size() != 3 || coordinate.size() != 6 || sign.size() != 6)
    throw std::runtime_error("interface '" + interface.name + "' is incomplete");
  for (int d = 0; d < 6; ++d)
  {
    interface.coordinate[d] = coordinate(d);
    interface.sign[d]       = sign(d);
    if (d < 3)
      interface.position[d] = position(d);
  }
  return interface;
}

void write_facts(Hdf5File &file, const fem::FrameFacts &facts)
{
  for (std::size_t i = 0; i < facts.parts.size(); ++i)
  {
    const std::string at = "facts/parts/" + std::to_string(i) + "/";
    file.write(at + "name", facts.parts[i].name);
    file.write(at + "material", facts.parts[i].material);
    file.write(at + "mass", number(facts.parts[i].mass));
  }
  file.write("facts/mass", number(facts.whole.mass));
  file.write("facts/centre", MatrixXd(facts.whole.centre));
  file.write("facts/inertia", MatrixXd(facts.whole.inertia));
  file.write("facts/rigid_energy", number(facts.rigid_energy));
  for (std::size_t i = 0; i < facts.free_motions.size(); ++i)
    file.write("facts/free_motions/" + std::to_string(i), facts.free_motions[i]);
}

fem::FrameFacts read_facts(const Hdf5File &file)
{
  fem::FrameFacts facts;
  const auto      each = [&](const std::string &group, const auto &read)
  {
    for (int i = 0; file.has(group) && file.has(group + "/" + std::to_string(i)); ++i)
      read(group + "/" + std::to_string(i));
  };
  each("facts/parts",
       [&](const std::string &at)
       {
         facts.parts.push_back(
             {file.read_text(at + "/name"), file.read_text(at + "/material"), file.read_number(at + "/mass")});
       });
  each("facts/free_motions", [&](const std::string &at) { facts.free_motions.push_back(file.read_text(at)); });
  const MatrixXd centre = file.read_matrix("facts/centre"), inertia = file.read_matrix("facts/inertia");
  if (centre.size() != 3 || inertia.rows() != 3 || inertia.cols() != 3)
    throw std::runtime_error("the mass properties are incomplete");
  facts.whole        = {file.read_number("facts/mass"), centre.reshaped(), inertia};
  facts.rigid_energy = file.read_number("facts/rigid_energy");
  return facts;
}

void write_all(Hdf5File &file, const ReducedFrame &frame, const std::string &key)
{
  file.write("format", std::string(format));
  file.write("version", number(version));
  file.write("key", key);
  file.write("M", frame.M);
  file.write("B", frame.B);
  file.write("C", frame.C);
  file.write("n_interface", number(frame.n_interface));
  file.write("omega0", MatrixXd(frame.omega0));
  file.write("translations_load", frame.translations_load);
  file.write("total_mass", MatrixXd(frame.total_mass));
  file.write("n_full", number(frame.n_full));
  file.write("n_cells", number(frame.n_cells));
  file.write("mass", number(frame.mass));
  file.write("frequencies_hz", MatrixXd(frame.frequencies_hz));
  file.write("frequency_limit_hz", number(frame.frequency_limit_hz));
  file.write("frequency_error", MatrixXd(frame.frequency_error));
  file.write("outputs_under_acceleration", frame.outputs_under_acceleration);
  file.write("static_residual", number(frame.static_residual));
  file.write("points", columns<MatrixXd>(frame.points));
  file.write("triangles", columns<Eigen::MatrixXi>(frame.triangles));
  file.write("displacement", frame.displacement);
  for (std::size_t i = 0; i < frame.interfaces.size(); ++i)
    write_interface(file, "interfaces/" + std::to_string(i) + "/", frame.interfaces[i]);
  for (std::size_t i = 0; i < frame.outputs.size(); ++i)
  {
    const std::string at = "outputs/" + std::to_string(i) + "/";
    file.write(at + "name", frame.outputs[i].name);
    file.write(at + "unit", frame.outputs[i].unit);
    file.write(at + "on_q", MatrixXd(frame.outputs[i].on_q));
    file.write(at + "on_v", MatrixXd(frame.outputs[i].on_v));
  }
  write_facts(file, frame.facts);
  for (std::size_t i = 0; i < frame.notes.size(); ++i)
    file.write("notes/" + std::to_string(i), frame.notes[i]);
  write_stress(file, frame.stress);
}

ReducedFrame read_all(const Hdf5File &file)
{
  ReducedFrame frame;
  frame.M                 = file.read_matrix("M");
  frame.B                 = file.read_matrix("B");
  frame.C                 = file.read_matrix("C");
  frame.n_interface       = int(file.read_number("n_interface"));
  frame.omega0            = file.read_vector("omega0");
  frame.translations_load = file.read_matrix("translations_load");
  const MatrixXd mass     = file.read_matrix("total_mass");
  if (mass.rows() != 3 || mass.cols() != 3)
    throw std::runtime_error("'total_mass' must be 3 x 3");
  frame.total_mass                 = mass;
  frame.n_full                     = int(file.read_number("n_full"));
  frame.n_cells                    = int(file.read_number("n_cells"));
  frame.mass                       = file.read_number("mass");
  frame.frequencies_hz             = file.read_vector("frequencies_hz");
  frame.frequency_limit_hz         = file.read_number("frequency_limit_hz");
  frame.frequency_error            = file.read_vector("frequency_error");
  frame.outputs_under_acceleration = file.read_matrix("outputs_under_acceleration");
  frame.static_residual            = file.read_number("static_residual");
  frame.points                     = points<std::array<double, 3>>(file.read_matrix("points"));
  frame.triangles                  = points<std::array<int, 3>>(file.read_integers("triangles"));
  frame.displacement               = file.read_floats("displacement");
  for (int i = 0; file.has("interfaces") && file.has("interfaces/" + std::to_string(i)); ++i)
    frame.interfaces.push_back(read_interface(file, "interfaces/" + std::to_string(i) + "/"));
  for (int i = 0; file.has("outputs") && file.has("outputs/" + std::to_string(i)); ++i)
  {
    const std::string at = "outputs/" + std::to_string(i) + "/";
    frame.outputs.push_back({file.read_text(at + "name"), file.read_text(at + "unit"), file.read_vector(at + "on_q"),
                             file.read_vector(at + "on_v")});
  }
  frame.facts = read_facts(file);
  for (int i = 0; file.has("notes") && file.has("notes/" + std::to_string(i)); ++i)
    frame.notes.push_back(file.read_text("notes/" + std::to_string(i)));
  frame.stress = read_stress(file, int(frame.points.size()), int(frame.M.rows()));
  return frame;
}

/// The parts must fit each other, whatever the file says.
void require_consistent(const ReducedFrame &frame)
{
  const auto n       = frame.M.rows();
  const auto require = [](bool fits, const char *what)
  {
    if (!fits)
      throw std::runtime_error(std::string(what) + " does not fit the matrices");
  };
  require(frame.M.cols() == n && frame.B.rows() == n && frame.B.cols() == n && frame.C.rows() == n &&
              frame.C.cols() == n,
          "the size of M, B or C");
  require(frame.n_interface >= 0 && frame.n_interface + frame.omega0.size() == n, "the number of modes");
  require(frame.translations_load.rows() == n && frame.translations_load.cols() == 3, "'translations_load'");
  require(frame.displacement.size() == 0 ||
              (frame.displacement.cols() == n && frame.displacement.rows() == Eigen::Index(3 * frame.points.size())),
          "'displacement'");
  for (const auto &interface : frame.interfaces)
    for (const int i : interface.coordinate)
      require(i >= -1 && i < frame.n_interface, "an interface coordinate");
  for (const auto &output : frame.outputs)
    require(output.on_q.size() == n && output.on_v.size() == n, "an output");
  for (const auto &triangle : frame.triangles)
    for (const int i : triangle)
      require(i >= 0 && i < int(frame.points.size()), "a triangle of the picture");
}

/// Reads and checks; the key is compared if one is given.
ReducedFrame read_checked(const std::string &name, const std::string *key)
{
  const Hdf5File file(name, Hdf5File::Mode::read);
  if (!file.has("format") || file.read_text("format") != format)
    throw std::runtime_error(name + ": holds no reduced frame of Gestell");
  const int found = int(file.read_number("version"));
  if (found != version)
    throw std::runtime_error(name + ": has version " + std::to_string(found) + " of the format; this program reads " +
                             std::to_string(version));
  if (key && file.read_text("key") != *key)
    throw std::runtime_error(name + ": was made from something else than its name says");
  ReducedFrame frame = read_all(file);
  require_consistent(frame);
  return frame;
}

} // namespace

void write_reduced_frame(const std::string &name, const ReducedFrame &frame, const std::string &key)
{
  if (!frame.modal)
    throw std::invalid_argument(name + ": a frame in physical coordinates is not reduced; files hold reduced frames");
  const fs::path  path(name), beside = path.string() + ".part" + std::to_string(getpid());
  std::error_code error;
  if (path.has_parent_path())
    fs::create_directories(path.parent_path(), error);
  if (error)
    throw std::runtime_error(name + ": its folder cannot be made: " + error.message());
  try
  {
    Hdf5File file(beside.string(), Hdf5File::Mode::create);
    write_all(file, frame, key);
    file.close();
    fs::rename(beside, path);
  }
  catch (const std::exception &failure)
  {
    fs::remove(beside, error);
    throw std::runtime_error(name + ": cannot be written: " + failure.what());
  }
}

ReducedFrame read_reduced_frame(const std::string &file)
{
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw std::invalid_argument(file + ": no such file; make it with `gestell reduce`");
  try
  {
    return read_checked(file, nullptr);
  }
  catch (const std::runtime_error &failure)
  {
    throw std::invalid_argument(file + ": not a whole reduced frame (" + failure.what() +
                                "); make it anew with `gestell reduce`");
  }
}

std::string cache_folder()
{
  const auto variable = [](const char *name)
  {
    const char *value = std::getenv(name);
    return std::string(value ? value : "");
  };
  if (const auto own = variable("GESTELL_CACHE"); !own.empty())
    return own;
  if (const auto xdg = variable("XDG_CACHE_HOME"); !xdg.empty())
    return (fs::path(xdg) / "gestell").string();
  const auto home = variable("HOME");
  return (home.empty() ? fs::temp_directory_path() / "gestell" : fs::path(home) / ".cache" / "gestell").string();
}

std::string cache_file(const std::string &key)
{
  return (fs::path(cache_folder()) / (key + ".h5")).string();
}

std::optional<ReducedFrame> find_in_cache(const std::string &key, std::string &note)
{
  const std::string file = cache_file(key);
  std::error_code   error;
  if (!fs::exists(file, error))
    return {};
  try
  {
    return read_checked(file, &key);
  }
  catch (const std::runtime_error &failure)
  {
    note += "cache: " + std::string(failure.what()) + "; the frame is reduced anew";
    return {};
  }
}

std::string keep_in_cache(const std::string &key, const ReducedFrame &frame)
{
  try
  {
    write_reduced_frame(cache_file(key), frame, key);
    return {};
  }
  catch (const std::exception &failure)
  {
    return "cache: the reduced frame is not kept for the next run: " + std::string(failure.what());
  }
}

} // namespace gestell::coupling

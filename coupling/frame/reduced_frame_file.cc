#include "coupling/frame/reduced_frame_file.h"

#include "coupling/frame/checksummed_file.h"
#include "coupling/frame/hdf5_file.h"
#include "coupling/frame/reduced_stress_file.h"
#include "coupling/frame/tried_file.h"
#include "fem/values/available_memory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace gestell::coupling
{

namespace
{

namespace fs = std::filesystem;
using Eigen::MatrixXd;

template <typename T, typename Archive>
void each(const std::string &at, T &value, Archive &archive);

constexpr const char *title = "Gestell reduced frame 9"; // raise the number with the format

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

/// Writes values under their names.
class FrameWriter
{
public:
  explicit FrameWriter(Hdf5File &file) : file_(file) {}

  void operator()(const std::string &name, const std::string &text) { file_.write(name, text); }
  void operator()(const std::string &name, double x) { file_.write(name, MatrixXd(MatrixXd::Constant(1, 1, x))); }
  void operator()(const std::string &name, int x) { (*this)(name, double(x)); }
  void operator()(const std::string &name, const std::optional<double> &x)
  {
    if (x)
      (*this)(name, *x);
  }
  template <typename Number, int rows, int columns>
  void operator()(const std::string &name, const Eigen::Matrix<Number, rows, columns> &A)
  {
    file_.write(name, Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>(A));
  }
  template <typename Number, std::size_t n>
  void operator()(const std::string &name, const std::array<Number, n> &a)
  {
    (*this)(name, Eigen::Matrix<Number, int(n), 1>(a.data()));
  }
  void operator()(const std::string &name, const std::vector<std::array<double, 3>> &points)
  {
    file_.write(name, columns<MatrixXd>(points));
  }
  void operator()(const std::string &name, const std::vector<std::array<int, 3>> &triangles)
  {
    file_.write(name, columns<Eigen::MatrixXi>(triangles));
  }
  template <typename T>
  void operator()(const std::string &name, const std::vector<T> &list)
  {
    for (std::size_t i = 0; i < list.size(); ++i)
      each(name + "/" + std::to_string(i), list[i], *this);
  }

private:
  Hdf5File &file_;
};

int whole_number(const Hdf5File &file, const std::string &name)
{
  const double x = file.read_number(name);
  if (!(std::abs(x) <= std::numeric_limits<int>::max()))
    throw std::runtime_error("'" + name + "' is not an integer");
  return int(x);
}

/// Reads them back.
class FrameReader
{
public:
  explicit FrameReader(const Hdf5File &file) : file_(file) {}

  void operator()(const std::string &name, std::string &text) { text = file_.read_text(name); }
  void operator()(const std::string &name, double &x) { x = file_.read_number(name); }
  void operator()(const std::string &name, int &x) { x = whole_number(file_, name); }
  void operator()(const std::string &name, std::optional<double> &x)
  {
    x = file_.has(name) ? std::optional(file_.read_number(name)) : std::nullopt;
  }
  void operator()(const std::string &name, Eigen::MatrixXf &A) { A = file_.read_floats(name); }
  template <int rows, int columns>
  void operator()(const std::string &name, Eigen::Matrix<double, rows, columns> &A)
  {
    A = sized<rows, columns>(name, file_.read_matrix(name));
  }
  template <std::size_t n>
  void operator()(const std::string &name, std::array<double, n> &a)
  {
    Eigen::Map<Eigen::Matrix<double, int(n), 1>>(a.data()) = sized<int(n), 1>(name, file_.read_matrix(name));
  }
  template <std::size_t n>
  void operator()(const std::string &name, std::array<int, n> &a)
  {
    Eigen::Map<Eigen::Matrix<int, int(n), 1>>(a.data()) = sized<int(n), 1>(name, file_.read_integers(name));
  }
  void operator()(const std::string &name, std::vector<std::array<double, 3>> &list)
  {
    list = points<std::array<double, 3>>(file_.read_matrix(name));
  }
  void operator()(const std::string &name, std::vector<std::array<int, 3>> &list)
  {
    list = points<std::array<int, 3>>(file_.read_integers(name));
  }
  template <typename T>
  void operator()(const std::string &name, std::vector<T> &list)
  {
    const auto at = [&] { return name + "/" + std::to_string(list.size()); };
    for (bool some = file_.has(name); some && file_.has(at());)
    {
      T value;
      each(at(), value, *this);
      list.push_back(std::move(value));
    }
  }

private:
  template <int rows, int columns, typename Matrix>
  static Matrix sized(const std::string &name, const Matrix &A)
  {
    if ((rows != Eigen::Dynamic && A.rows() != rows) || (columns != Eigen::Dynamic && A.cols() != columns))
      throw std::runtime_error("'" + name + "' has a wrong size");
    return A;
  }

  const Hdf5File &file_;
};

// Each value is taken apart by a structured binding that names all its members: one that is added later does not
// compile until it is stored, too.

template <typename Archive, typename Interface>
void each_interface(const std::string &at, Interface &interface, Archive &archive)
{
  auto &[name, position, coordinate, sign, face] = interface;
  auto &[centre, axes, half, degree, of_fields]  = face;
  archive(at + "/name", name);
  archive(at + "/position", position);
  archive(at + "/coordinate", coordinate);
  archive(at + "/sign", sign);
  archive(at + "/face/centre", centre);
  archive(at + "/face/axes", axes);
  archive(at + "/face/half", half);
  archive(at + "/face/degree", degree);
  archive(at + "/face/coordinate", of_fields);
}

template <typename Archive, typename Output>
void each_output(const std::string &at, Output &output, Archive &archive)
{
  auto &[name, unit, on_q, on_v, under_acceleration, on_a, constant] = output;
  archive(at + "/name", name);
  archive(at + "/unit", unit);
  archive(at + "/on_q", on_q);
  archive(at + "/on_v", on_v);
  archive(at + "/under_acceleration", under_acceleration);
  archive(at + "/on_a", on_a);
  archive(at + "/constant", constant);
}

template <typename Archive, typename Part>
void each_part_of_facts(const std::string &at, Part &part, Archive &archive)
{
  auto &[name, material, mass] = part;
  archive(at + "/name", name);
  archive(at + "/material", material);
  archive(at + "/mass", mass);
}

template <typename Archive, typename Facts>
void each_fact(const std::string &at, Facts &facts, Archive &archive)
{
  auto &[parts, whole, rigid_energy, free_motions, buckling_factor] = facts;
  auto &[mass, centre, inertia]                                     = whole;
  archive(at + "/parts", parts);
  archive(at + "/mass", mass);
  archive(at + "/centre", centre);
  archive(at + "/inertia", inertia);
  archive(at + "/rigid_energy", rigid_energy);
  archive(at + "/free_motions", free_motions);
  archive(at + "/buckling_factor", buckling_factor);
}

template <typename T, typename Archive>
void each(const std::string &at, T &value, Archive &archive)
{
  using Value = std::remove_const_t<T>;
  if constexpr (std::is_same_v<Value, fem::Interface>)
    each_interface(at, value, archive);
  else if constexpr (std::is_same_v<Value, fem::FrameOutput>)
    each_output(at, value, archive);
  else if constexpr (std::is_same_v<Value, fem::FrameFacts::SolidMass>)
    each_part_of_facts(at, value, archive);
  else
    archive(at, value);
}

template <typename Archive, typename Frame>
void each_part(Frame &frame, Archive &&archive)
{
  auto &[M, B, C, n_interface, modal, omega0, interfaces, translations_load, outputs, points, triangles, displacement,
         stress, n_full, n_cells, n_fixed_modes, mass, facts, frequencies_hz, frequency_limit_hz, frequency_error,
         left_out, static_residual, notes, statements, cache_notes] = frame;
  archive("M", M);
  archive("B", B);
  archive("C", C);
  archive("n_interface", n_interface); // files contain only modal frames
  archive("omega0", omega0);
  archive("interfaces", interfaces);
  archive("translations_load", translations_load);
  archive("outputs", outputs);
  archive("points", points);
  archive("triangles", triangles);
  archive("displacement", displacement);
  archive("n_full", n_full);
  archive("n_cells", n_cells);
  archive("n_fixed_modes", n_fixed_modes);
  archive("mass", mass);
  each_fact("facts", facts, archive);
  archive("frequencies_hz", frequencies_hz);
  archive("frequency_limit_hz", frequency_limit_hz);
  archive("frequency_error", frequency_error);
  archive("left_out", left_out);
  archive("static_residual", static_residual);
  archive("notes", notes);
  archive("statements", statements);
}

/// The parts must be consistent, whatever the file contains.
void require_consistent(const ReducedFrame &frame)
{
  const auto n       = frame.M.rows();
  const auto require = [](bool fits, const char *what)
  {
    if (!fits)
      throw std::runtime_error(std::string(what) + " does not match the matrices");
  };
  require(frame.M.cols() == n && frame.B.rows() == n && frame.B.cols() == n && frame.C.rows() == n &&
              frame.C.cols() == n,
          "the size of M, B or C");
  require(frame.n_interface >= 0 && frame.n_interface + frame.omega0.size() == n, "the number of modes");
  require(frame.translations_load.rows() == n && frame.translations_load.cols() == 3, "'translations_load'");
  require(frame.displacement.size() == 0 ||
              (frame.displacement.cols() == n && frame.displacement.rows() == Eigen::Index(3 * frame.points.size())),
          "'displacement'");
  require(frame.M.allFinite() && frame.B.allFinite() && frame.C.allFinite() && frame.omega0.allFinite() &&
              frame.translations_load.allFinite() && frame.frequencies_hz.allFinite(),
          "a number that is not finite");
  require(frame.n_fixed_modes >= 0 && frame.n_fixed_modes <= frame.omega0.size(), "the number of fixed modes");
  require(frame.left_out.size() == 0 ||
              (frame.left_out.rows() == frame.n_interface && frame.left_out.cols() == frame.n_interface),
          "'left_out'");
  for (const auto &interface : frame.interfaces)
  {
    constexpr int highest_degree = 100; // of the fields of a face; beyond, their number would leave its range
    require(interface.face.degree >= 0 && interface.face.degree <= highest_degree, "the degree of a face");
    for (const int i : interface.coordinate)
      require(i >= -1 && i < frame.n_interface, "an interface coordinate");
    for (const int i : interface.face.coordinate)
      require(i >= 0 && i < frame.n_interface, "the coordinate of a field");
    require(int(interface.face.coordinate.size()) == fem::n_fields(interface.face.degree), "the degree of a face");
  }
  for (const auto &output : frame.outputs)
    require(output.on_q.allFinite() && output.on_v.allFinite() && output.on_a.allFinite() && output.on_q.size() == n &&
                output.on_v.size() == n && (output.on_a.size() == 0 || output.on_a.size() == n),
            "an output");
  for (const auto &triangle : frame.triangles)
    for (const int i : triangle)
      require(i >= 0 && i < int(frame.points.size()), "a triangle of the picture");
}

FrameOrigin read_origin(const Hdf5File &file)
{
  return {parse_recipe(file.read_text("made_from")), file.read_text("scene"), file.read_text("source"),
          file.has("cpu") ? file.read_number("cpu") : 0.};
}

} // namespace

void write_reduced_frame(const std::string &name, const ReducedFrame &frame, const FrameOrigin &origin)
{
  if (!frame.modal)
    throw std::invalid_argument(name + ": a frame in physical coordinates is not reduced; files store reduced frames");
  const fs::path  path(name);
  std::error_code error;
  if (path.has_parent_path())
    fs::create_directories(path.parent_path(), error);
  if (error)
    throw std::runtime_error(name + ": its folder cannot be created: " + error.message());
  const auto alone = hdf5_alone();
  Hdf5File   file;
  file.write("made_from", text_of(origin.recipe));
  file.write("scene", origin.scene);
  file.write("source", origin.source);
  if (origin.cpu > 0.)
    FrameWriter{file}("cpu", origin.cpu);
  each_part(frame, FrameWriter(file));
  write_stress(file, frame.stress);
  write_sealed(name, title, file.image());
}

namespace
{

FrameSummary read_summary(const std::string &name)
{
  const Hdf5File file(name);
  return {read_origin(file), whole_number(file, "n_full"), whole_number(file, "n_interface"),
          int(file.read_vector("omega0").size()), false};
}

StoredFrame read_content(const std::string &name)
{
  const Hdf5File file(name);
  StoredFrame    stored;
  stored.origin = read_origin(file);
  each_part(stored.frame, FrameReader(file));
  stored.frame.stress = read_stress(file, int(stored.frame.points.size()), int(stored.frame.M.rows()));
  require_consistent(stored.frame);
  return stored;
}

fem::ReadingLimits limits_of(const std::string &file)
{
  return fem::reading_limits(file, fem::FileContent::geometry, fem::available_memory());
}

/// Why a file cannot be read; "" if it can.
template <typename Read>
std::string defect_of(const Read &read, const std::string &name)
{
  try
  {
    read(name);
    return "";
  }
  catch (const std::runtime_error &failure)
  {
    return failure.what();
  }
}

} // namespace

FrameSummary read_frame_summary(const std::string &name)
{
  const bool is_part = head_defect(name, title_of_parts).empty();
  if (const std::string defect = is_part ? "" : head_defect(name, title); !defect.empty())
    throw std::runtime_error(defect);
  fem::ReadingLimits limits = limits_of(name);
  // of processor time, for some kilobytes: a thousand times what it takes
  constexpr double seconds_for_a_head = 10.;
  limits.seconds                      = std::min(limits.seconds, seconds_for_a_head); // 0: none
  const auto  alone                   = hdf5_alone();
  std::string defect;
  try
  {
    defect =
        defect_in_child(name, "reading the header of the frame", limits, [&] { return defect_of(read_summary, name); });
  }
  catch (const std::invalid_argument &died)
  {
    defect = died.what();
  }
  catch (const std::runtime_error &)
  {
    // No child can be made: the file is not to blame, and is read without.
  }
  if (!defect.empty())
    throw std::runtime_error("is damaged: " + defect);
  try
  {
    FrameSummary summary = read_summary(name);
    summary.is_part      = is_part;
    return summary;
  }
  catch (const std::runtime_error &failure)
  {
    throw std::runtime_error("is damaged: " + std::string(failure.what()));
  }
}

StoredFrame read_stored_frame(const std::string &name)
{
  const auto alone = hdf5_alone();
  if (const std::string defect = seal_defect(name, title); !defect.empty())
    throw std::runtime_error(defect);
  return read_content(name);
}

ReducedFrame read_reduced_frame(const std::string &file)
{
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw std::invalid_argument(file + (fs::exists(file, error) ? ": is not a regular file" : ": no such file") +
                                "; create it with `gestell reduce`");
  const auto  alone  = hdf5_alone();
  std::string defect = seal_defect(file, title);
  if (defect.empty())
    defect = defect_in_child(file, "reading the frame", limits_of(file), [&] { return defect_of(read_content, file); });
  if (defect.empty())
    try
    {
      return read_content(file).frame;
    }
    catch (const std::runtime_error &failure) // if there was no child process
    {
      defect = failure.what();
    }
  throw std::invalid_argument(file + ": not a complete reduced frame (" + defect +
                              "); create it again with `gestell reduce`");
}

} // namespace gestell::coupling

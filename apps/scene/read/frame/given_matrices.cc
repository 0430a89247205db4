#include "apps/scene/read/frame/given_matrices.h"

#include "apps/scene/read/frame/matrix_checks.h"
#include "coupling/exchange/matrices_of_file.h"
#include "coupling/exchange/node_places.h"
#include "coupling/exchange/row_table.h"
#include "coupling/frame/matrix_file.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace gestell::apps
{
namespace
{

using coupling::LabelledMatrix;
using coupling::MatrixRole;
using coupling::RowLabel;
using Sparse = Eigen::SparseMatrix<double>;

Eigen::MatrixXd dense(const std::vector<std::vector<double>> &rows)
{
  Eigen::MatrixXd result(rows.size(), rows.front().size());
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    for (Eigen::Index j = 0; j < result.cols(); ++j)
      result(i, j) = rows[i][j];
  return result;
}

/// Calls `read` and reports its std::invalid_argument at the key that names the file.
template <typename Read>
auto at_key(const SceneTable &frame, const std::string &key, const Read &read)
{
  try
  {
    return read();
  }
  catch (const std::invalid_argument &e)
  {
    throw frame.error(key, e.what());
  }
}

struct FileUnits
{
  double length = 1., mass = 1., time = 1., force = 1.; ///< SI

  bool are_si() const { return length == 1. && mass == 1. && time == 1. && force == 1.; }
};

FileUnits read_units(const SceneTable &frame)
{
  FileUnits  units;
  const auto table = frame.optional_table("file_units");
  if (!table)
    return units;
  units.length = table->value("length");
  units.mass   = table->value("mass");
  units.time   = table->value("time");
  units.force  = table->value_or("force", units.mass * units.length / (units.time * units.time));
  return units;
}

/// Files of other programs, each read once.
class MatrixFiles
{
public:
  explicit MatrixFiles(const SceneTable &frame) : frame_(frame), names_(frame.optional_table("matrix_names"))
  {
    if (frame.has("rows"))
      rows_ = at_key(frame, "rows", [&] { return coupling::read_row_table(frame.file("rows")); });
  }

  LabelledMatrix read(const std::string &key, MatrixRole role, const Kind &kind)
  {
    LabelledMatrix matrix;
    if (!frame_.is_text(key))
      matrix.A = dense(frame_.matrix(key, kind)).sparseView();
    else
      matrix = at_key(frame_, key, [&] { return from_file(frame_.file(key), key, role); });
    n_rows_ = matrix.A.rows();
    if (matrix.A.rows() != matrix.A.cols())
      throw frame_.error(key, "is " + shape_text(matrix.A.rows(), matrix.A.cols()) + ", but must be square");
    if (matrix.rows.empty() && !rows_.empty())
      name_rows(key, matrix);
    return matrix;
  }

  /// The name of another matrix with entries in the files that were read, by a test of names.
  template <typename Is>
  std::string left_in_files(const Is &is) const
  {
    for (const auto &[path, matrices] : read_)
      for (const auto &[name, matrix] : matrices)
        if (is(name) && matrix.A.nonZeros() > 0 && matrix.A.coeffs().cwiseAbs().maxCoeff() > 0.)
          return name;
    return "";
  }

private:
  LabelledMatrix from_file(const std::string &path, const std::string &key, MatrixRole role)
  {
    const auto found = read_.find(path);
    auto      &all   = found != read_.end() ? found->second : read_[path] = coupling::matrices_of_file(path, n_rows_);
    return coupling::matrix_for(all, role, names_ ? names_->text(key, "") : "", path);
  }

  void name_rows(const std::string &key, LabelledMatrix &matrix) const
  {
    if (matrix.A.rows() != Eigen::Index(rows_.size()))
      throw frame_.error("rows", "names " + std::to_string(rows_.size()) + " rows, but " + key + " is " +
                                     shape_text(matrix.A.rows(), matrix.A.cols()) +
                                     "; is it the file of another matrix?");
    matrix.rows = rows_;
  }

  const SceneTable                                            &frame_;
  std::optional<SceneTable>                                    names_;
  std::vector<RowLabel>                                        rows_;
  Eigen::Index                                                 n_rows_ = 0; ///< of the matrix read before
  std::map<std::string, std::map<std::string, LabelledMatrix>> read_;
};

std::string text_of_some(const std::vector<RowLabel> &rows)
{
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), 3); ++i)
    text += (i > 0 ? "; " : "") + text_of(rows[i]);
  return text + (rows.size() > 3 ? "; ..." : "");
}

/// The rows of `of` that are not in `in`.
std::vector<RowLabel> missing_rows(const std::vector<RowLabel> &of, const std::vector<RowLabel> &in)
{
  const std::vector<int> place = places_of(of, in);
  std::vector<RowLabel>  missing;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (place[i] < 0)
      missing.push_back(of[i]);
  return missing;
}

/// Appends rows that only the mass or the damping has to the rows of the stiffness.
void join_rows(const SceneTable &frame, const std::string &key, const std::vector<RowLabel> &stiff,
               const LabelledMatrix &other, std::vector<RowLabel> &rows)
{
  const auto more = missing_rows(other.rows, stiff);
  if (more.size() == other.rows.size() && !more.empty())
    throw frame.error(key, "has no row in common with the stiffness (" + text_of_some(more) + " here, " +
                               text_of_some(stiff) + " there); are they of different models?");
  if (!more.empty())
    frame.warn(key, count_text(more.size(), "row") +
                        " of it are not in the stiffness, so they are unconstrained: " + text_of_some(more) +
                        "; this is correct if the interfaces support the frame statically determinately, otherwise the "
                        "files belong to different models");
  for (const RowLabel &row : missing_rows(more, rows))
    rows.push_back(row);
}

bool is_named(const LabelledMatrix &matrix)
{
  return !matrix.rows.empty();
}

/// All named or none.
void require_named_alike(const SceneTable &frame, const LabelledMatrix &M, const LabelledMatrix &C,
                         const std::optional<LabelledMatrix> &B)
{
  if (is_named(M) == is_named(C) && (!B || is_named(*B) == is_named(C)))
    return;
  const std::string key = is_named(M) != is_named(C) ? "mass" : "damping";
  throw frame.error(key,
                    "identifies its rows in a different way from the stiffness: one file gives nodes and directions, "
                    "the other only row numbers; set 'rows' to the file that defines the row numbers (.dof, .mapping)");
}

Eigen::VectorXd scales(const std::vector<RowLabel> &rows, const FileUnits &units)
{
  Eigen::VectorXd s(Eigen::Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    s[Eigen::Index(i)] = rows[i].is_rotation()       ? 1.
                         : rows[i].is_displacement() ? 1. / units.length
                                                     : 1. / (units.length * std::sqrt(units.mass));
  return s;
}

void require_size(const SceneTable &frame, const std::string &key, const Sparse &A, Eigen::Index n)
{
  if (A.rows() != n)
    throw frame.error(key, "is " + shape_text(A.rows(), A.cols()) + ", but must be " + shape_text(n, n) +
                               " like the mass matrix");
}

/// The three in one order of rows, in SI.
void unite(const SceneTable &frame, LabelledMatrix &M, LabelledMatrix &C, std::optional<LabelledMatrix> &B,
           const FileUnits &units, GivenMatrices &given)
{
  given.rows = C.rows;
  join_rows(frame, "mass", C.rows, M, given.rows);
  if (B)
    join_rows(frame, "damping", C.rows, *B, given.rows);
  if (const auto massless = missing_rows(given.rows, M.rows); !massless.empty())
    given.statements.push_back("mass: " + count_text(massless.size(), "row") +
                               " of the stiffness have none: " + text_of_some(massless));
  const Eigen::VectorXd s      = scales(given.rows, units);
  const double          energy = units.force * units.length;
  const auto            in_si  = [&](const std::string &key, const LabelledMatrix &matrix, double factor)
  {
    Sparse     A          = spread(matrix, given.rows);
    const bool is_written = !frame.is_text(key); // in the scene itself, in SI
    for (int j = 0; j < A.outerSize() && !units.are_si() && !is_written; ++j)
      for (Sparse::InnerIterator a(A, j); a; ++a)
        a.valueRef() *= factor * (s[a.row()] * s[j]);
    return A;
  };
  given.M = in_si("mass", M, units.mass * units.length * units.length);
  given.C = in_si("stiffness", C, energy);
  if (B)
    given.B = in_si("damping", *B, energy * units.time);
}

/// Relative rounding of the entries in the files.
struct Roundings
{
  double of_mass, of_damping;
};

double rounding_in(const SceneTable &frame, const std::string &key, const Sparse &A)
{
  return frame.is_text(key) ? rounding_of(A) : least_rounding;
}

void check(const SceneTable &frame, const GivenMatrices &given, const Roundings &rounding)
{
  const auto magnitude = [&](const std::string &key, const Sparse &A)
  {
    check_symmetry(frame, key, A, given.rows);
    check_magnitude(frame, key, A);
  };
  magnitude("mass", given.M);
  magnitude("stiffness", given.C);
  require_positive_diagonal(frame, "stiffness", given.C, given.rows); // its signs are checked when it is factorised
  if (given.B)
  {
    magnitude("damping", *given.B);
    check_semidefinite(frame, "damping", *given.B, rounding.of_damping, given.rows);
  }
  check_mass(frame, given.M, rounding.of_mass, given.C, given.rows);
}

/// Warns of damping in the files that the scene does not use.
void tell_left_damping(const SceneTable &frame, const MatrixFiles &files)
{
  if (frame.has("damping"))
    return;
  const std::string viscous    = files.left_in_files([](const std::string &name) { return name[0] == 'B'; });
  const std::string structural = files.left_in_files([](const std::string &name) { return name.rfind("K4", 0) == 0; });
  if (!viscous.empty())
    frame.warn("stiffness", "the file has a damping matrix " + viscous +
                                ", which is ignored; to use it set damping to the same file, to ignore it without this "
                                "note set damping = { ratio = 0.01 }");
  if (!structural.empty())
    frame.warn("stiffness", "the file has structural damping " + structural +
                                ", which has no equivalent in the time domain and is ignored; set damping = { ratio = "
                                "... } to half the loss factor");
}

/// The matrix files that also contain nodes, each once.
std::vector<std::string> models_beside(const SceneTable &frame)
{
  std::vector<std::string> models;
  for (const std::string key : {"stiffness", "mass", "damping"})
    if (frame.has(key) && frame.is_text(key))
      if (const std::string file = frame.file(key);
          std::find(models.begin(), models.end(), file) == models.end() && coupling::has_node_places(file))
        models.push_back(file);
  return models;
}

} // namespace

std::string shape_text(Eigen::Index rows, Eigen::Index columns)
{
  return std::to_string(rows) + " x " + std::to_string(columns);
}

void turn_to_global(const SceneTable &frame, const std::map<long, Eigen::Matrix3d> &axes, GivenMatrices &given)
{
  if (axes.empty())
    return;
  std::map<RowLabel, int> place;
  for (std::size_t i = 0; i < given.rows.size(); ++i)
    place.emplace(given.rows[i], int(i));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < given.rows.size(); ++i)
  {
    const RowLabel &row  = given.rows[i];
    const auto      turn = axes.find(row.node);
    if (row.component == 0 || turn == axes.end())
    {
      entries.emplace_back(int(i), int(i), 1.);
      continue;
    }
    const int first = row.is_rotation() ? 4 : 1;
    for (int d = 0; d < 3; ++d)
    {
      const auto other = place.find({row.node, first + d});
      if (other == place.end())
        throw frame.error(frame.has("nodes") ? "nodes" : "stiffness",
                          "node " + std::to_string(row.node) +
                              " has its own displacement coordinate system (CD), and " +
                              text_of(RowLabel{row.node, first + d}) +
                              " has no row; all three are needed to rotate them to the global axes");
      entries.emplace_back(other->second, int(i), turn->second(d, row.component - first));
    }
  }
  Sparse G(given.M.rows(), given.M.rows());
  G.setFromTriplets(entries.begin(), entries.end());
  const auto turned = [&](const Sparse &A) { return Sparse(G * A * Sparse(G.transpose())); };
  given.M           = turned(given.M);
  given.C           = turned(given.C);
  if (given.B)
    given.B = turned(*given.B);
}

Sparse read_plain_matrix(const SceneTable &frame, const std::string &key, const Kind &kind)
{
  if (!frame.is_text(key))
    return dense(frame.matrix(key, kind)).sparseView();
  return at_key(frame, key, [&] { return coupling::read_matrix_file(frame.file(key)); });
}

GivenMatrices read_given_matrices(const SceneTable &frame)
{
  const FileUnits units = read_units(frame);
  GivenMatrices   given;
  given.length = units.length;
  MatrixFiles                   files(frame);
  LabelledMatrix                M = files.read("mass", MatrixRole::mass, kind::mass_entry);
  LabelledMatrix                C = files.read("stiffness", MatrixRole::stiffness, kind::stiffness_entry);
  std::optional<LabelledMatrix> B;
  if (frame.has("damping") && !frame.is_table("damping"))
    B = files.read("damping", MatrixRole::damping, kind::damping_entry);
  require_named_alike(frame, M, C, B);
  const Roundings rounding{rounding_in(frame, "mass", M.A), B ? rounding_in(frame, "damping", B->A) : 0.};
  if (is_named(C))
    unite(frame, M, C, B, units, given);
  else
  {
    if (!units.are_si())
      throw frame.error("file_units", "needs to know which rows are displacements and which are rotations: add rows = "
                                      "the file that defines them (.dof, .mapping), or write the matrices in kg, m, N");
    require_size(frame, "stiffness", C.A, M.A.rows());
    given.M = std::move(M.A);
    given.C = std::move(C.A);
    if (B)
    {
      require_size(frame, "damping", B->A, given.M.rows());
      given.B = std::move(B->A);
    }
  }
  check(frame, given, rounding);
  tell_left_damping(frame, files);
  if (is_named(C))
    given.models = models_beside(frame);
  return given;
}

} // namespace gestell::apps

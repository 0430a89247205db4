#include "apps/scene/read/frame/matrix_keys.h"
#include "apps/scene/read/frame/matrix_units.h"
#include "apps/scene/read/frame/read_damping.h"
#include "apps/scene/read/frame/read_frame.h"
#include "apps/scene/read/frame/read_node_table.h"
#include "apps/scene/read/names.h"
#include "coupling/frame/matrix_file.h"
#include "fem/values/nearest_name.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace gestell::apps
{
namespace
{

using Sparse = Eigen::SparseMatrix<double>;

constexpr double symmetry_tolerance     = 1e-9; // of the largest entry: files written with 10 digits pass
constexpr double semidefinite_tolerance = 1e-9; // of unit diagonal, likewise
constexpr double largest_entry          = 1e100;
constexpr double vanishing_mass         = 1e-30; // of the largest

const std::vector<std::string> motion_names{"ux", "uy", "uz", "rx", "ry", "rz"};

Eigen::MatrixXd dense(const std::vector<std::vector<double>> &rows)
{
  Eigen::MatrixXd result(rows.size(), rows.front().size());
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    for (Eigen::Index j = 0; j < result.cols(); ++j)
      result(i, j) = rows[i][j];
  return result;
}

std::string shape(Eigen::Index rows, Eigen::Index columns)
{
  return std::to_string(rows) + " x " + std::to_string(columns);
}

/// Inline rows, or a file.
Sparse read_any(const SceneTable &frame, const std::string &key, const Kind &kind)
{
  if (!frame.is_text(key))
    return dense(frame.matrix(key, kind)).sparseView();
  const std::string path = frame.file(key);
  try
  {
    return coupling::read_matrix_file(path);
  }
  catch (const std::invalid_argument &e)
  {
    throw frame.error(key, e.what());
  }
}

std::string number_text(double x)
{
  std::ostringstream text;
  text << x;
  return text.str();
}

bool has_one_triangle_only(const Sparse &A)
{
  bool below = false, above = false;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator a(A, j); a; ++a)
      if (a.value() != 0. && a.row() != j)
        (a.row() > j ? below : above) = true;
  return below != above;
}

void check_symmetry(const SceneTable &frame, const std::string &key, const Sparse &A)
{
  double size = 0., skew = 0.;
  int    row = 0, column = 0;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator a(A, j); a; ++a)
    {
      if (!std::isfinite(a.value()))
        throw frame.error(key, "has an entry that is not a finite number in row " + std::to_string(a.row() + 1));
      size = std::max(size, std::abs(a.value()));
    }
  const Sparse difference = A - Sparse(A.transpose());
  for (int j = 0; j < difference.outerSize(); ++j)
    for (Sparse::InnerIterator a(difference, j); a; ++a)
      if (std::abs(a.value()) > skew)
      {
        skew   = std::abs(a.value());
        row    = int(a.row());
        column = j;
      }
  if (skew <= symmetry_tolerance * size)
    return;
  if (has_one_triangle_only(A))
    throw frame.error(key, "holds one triangle of a symmetric matrix only; write both, or a MatrixMarket file with "
                           "'symmetric' in its head line and the lower triangle");
  const auto entry = [&](int i, int j) {
    return "row " + std::to_string(i + 1) + ", column " + std::to_string(j + 1) + " is " + number_text(A.coeff(i, j));
  };
  throw frame.error(key, "is not symmetric: " + entry(row, column) + ", but " + entry(column, row) +
                             "; frames with gyroscopic or follower terms cannot be taken, export the symmetric part");
}

void require_positive_diagonal(const SceneTable &frame, const std::string &key, const Sparse &matrix)
{
  const Eigen::VectorXd diagonal = matrix.diagonal();
  Eigen::Index          lowest;
  if (diagonal.minCoeff(&lowest) < 0.)
    throw frame.error(key, "is not positive semidefinite: row " + std::to_string(lowest + 1) + " has " +
                               number_text(diagonal[lowest]) + " on the diagonal; it must be zero or positive");
}

/// Refuses a matrix by which some motion has negative energy; coordinates without an own entry may be, as rotations of
/// lumped masses are.  Scaled to unit diagonal it must have no eigenvalue below -semidefinite_tolerance.
void check_semidefinite(const SceneTable &frame, const std::string &key, const Sparse &matrix)
{
  require_positive_diagonal(frame, key, matrix);
  const Eigen::VectorXd diagonal = matrix.diagonal();
  const double          largest  = diagonal.maxCoeff() > 0. ? diagonal.maxCoeff() : 1.;
  const Eigen::VectorXd scale =
      diagonal.unaryExpr([largest](double m) { return 1. / std::sqrt(m > 0. ? m : largest); });
  Sparse unit(matrix.rows(), matrix.rows());
  unit.setIdentity();
  const Sparse shifted = Sparse(scale.asDiagonal() * matrix * scale.asDiagonal()) + semidefinite_tolerance * unit;
  if (Eigen::SimplicialLLT<Sparse>(shifted).info() != Eigen::Success)
    throw frame.error(key, "is not positive semidefinite: by its entries beside the diagonal some motion has negative "
                           "energy; check their signs and units");
}

void check_mass(const SceneTable &frame, const Sparse &M, const Sparse &C)
{
  check_semidefinite(frame, "mass", M);
  if (M.diagonal().maxCoeff() == 0.)
    throw frame.error("mass", "has nothing but zeros on its diagonal; some coordinate needs a mass");
  const Eigen::VectorXd mass = M.diagonal(), stiffness = C.diagonal(); // of semidefinite matrices zero rows
  for (Eigen::Index i = 0; i < mass.size(); ++i)
    if (mass[i] == 0. && stiffness[i] == 0.)
      throw frame.error("mass", "row " + std::to_string(i + 1) +
                                    " has neither mass nor stiffness, so that nothing says how "
                                    "it moves; remove the row and column from all matrices");
    else if (mass[i] > 0. && mass[i] < vanishing_mass * mass.maxCoeff())
      throw frame.error("mass", "row " + std::to_string(i + 1) + " has " + number_text(mass[i]) +
                                    " on the diagonal, next to nothing beside the largest, " +
                                    number_text(mass.maxCoeff()) +
                                    ": its frequency would be beyond all numbers; write 0 where there is no mass");
}

/// Products of the largest entries must stay numbers.
void check_magnitude(const SceneTable &frame, const std::string &key, const Sparse &A)
{
  const double largest = A.nonZeros() > 0 ? A.coeffs().cwiseAbs().maxCoeff() : 0.;
  if (largest > largest_entry || (largest > 0. && largest < 1. / largest_entry))
    throw frame.error(key, "has " + number_text(largest) +
                               " as its largest entry, which no frame has in kg, m, N and "
                               "rad; check its units and how it was written");
}

/// n = 0: any size.
Sparse read_square(const SceneTable &frame, const std::string &key, const Kind &kind, Eigen::Index n)
{
  const Sparse A = read_any(frame, key, kind);
  if (A.rows() != A.cols() || (n > 0 && A.rows() != n))
    throw frame.error(key, "is " + shape(A.rows(), A.cols()) + ", but must be " +
                               (n > 0 ? shape(n, n) + " like the mass matrix" : "square"));
  check_symmetry(frame, key, A);
  check_magnitude(frame, key, A);
  return A;
}

/// rows = { "-uz" = 1 }: row 1 of q is the displacement against z.
void add_interface(const SceneTable &any, Eigen::Index n, std::map<int, std::string> &owner,
                   std::vector<fem::Interface> &interfaces)
{
  const SceneTable table = any.declared(matrix_interface_keys());
  check_thing_name(table);
  for (const auto &other : interfaces)
    if (other.name == table.name())
      throw table.error("is a node of the table of nodes already; rename one of them");
  fem::Interface interface;
  interface.name     = table.name();
  interface.position = table.vector_or("position", {});
  const auto rows    = table.table("rows");
  for (const auto &key : rows.keys())
  {
    const bool minus = key[0] == '-';
    const auto found = std::find(motion_names.begin(), motion_names.end(), key.substr(minus));
    if (found == motion_names.end())
      throw rows.error(key, "is no motion; valid: " + listed(motion_names) +
                                ", each with '-' before it if the row counts "
                                "against the axis");
    const int motion = found - motion_names.begin(), row = rows.integer(key, 0);
    if (row < 1 || row > n)
      throw rows.error(key,
                       "there is no row " + std::to_string(row) + "; the matrices have rows 1 to " + std::to_string(n));
    if (interface.coordinate[motion] >= 0)
      throw rows.error(key, "the motion " + *found + " has a row already");
    if (const auto [first, is_new] = owner.emplace(row, interface.name + "." + *found); !is_new)
      throw rows.error(key, "row " + std::to_string(row) + " is " + first->second + " already");
    interface.coordinate[motion] = row - 1;
    interface.sign[motion]       = minus ? -1. : 1.;
  }
  if (rows.keys().empty())
    throw rows.error("needs at least one row such as { uz = 1 }");
  interfaces.push_back(std::move(interface));
}

/// Nodes that have a name in the table of nodes are interfaces.
std::vector<fem::Interface> named_nodes(const SceneTable &frame, const std::vector<TableNode> &nodes,
                                        std::map<int, std::string> &owner)
{
  std::map<std::string, std::string> place_of;
  std::vector<fem::Interface>        interfaces;
  for (const TableNode &node : nodes)
  {
    const fem::Interface &motions = node.motions;
    if (motions.name.empty())
      continue;
    const auto refused = [&](const std::string &what)
    { return frame.error("nodes", node.place + "node '" + motions.name + "' " + what); };
    if (const auto [first, is_new] = place_of.emplace(motions.name, node.place); !is_new)
      throw refused("is there already: " + first->second);
    for (int motion = 0; motion < 6; ++motion)
      if (const int row = motions.coordinate[motion] + 1; row > 0)
        if (const auto [first, is_new] = owner.emplace(row, motions.name + "." + motion_names[motion]); !is_new)
          throw refused("has row " + std::to_string(row) + ", which is " + first->second + " already");
    if (*std::max_element(motions.coordinate.begin(), motions.coordinate.end()) < 0)
      throw refused("has no row; a node with a name is an interface and needs one at least");
    interfaces.push_back(motions);
  }
  return interfaces;
}

/// Those of x, y, z that a support has tables of.
std::vector<std::string> directions_of(const SceneTable &support)
{
  std::vector<std::string> directions;
  for (const std::string direction : {"x", "y", "z"})
    if (support.has(direction))
      directions.push_back(direction);
  return directions;
}

/// A force read off the frame: stiffness_row . q + damping_row . q' + acceleration_row . g.
fem::FrameOutput read_output(const SceneTable &any, const std::string &before, Eigen::Index n)
{
  const SceneTable table = any.declared(matrix_output_keys());
  check_thing_name(table);
  const auto row = [&](const std::string &key, const Kind &kind, Eigen::Index size, const std::string &needed)
  {
    const auto values = table.numbers(key, kind);
    if (static_cast<Eigen::Index>(values.size()) != size)
      throw table.error(key, "has " + std::to_string(values.size()) + " entries, but " + needed);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), size));
  };
  const std::string coordinates = "the frame has " + std::to_string(n) + " coordinates";
  fem::FrameOutput  output;
  output.name = before + table.name();
  output.unit = "N";
  output.on_q = row("stiffness_row", kind::stiffness_entry, n, coordinates);
  output.on_v =
      table.has("damping_row") ? row("damping_row", kind::damping_entry, n, coordinates) : Eigen::VectorXd::Zero(n);
  if (table.has("acceleration_row"))
    output.under_acceleration = row("acceleration_row", kind::mass_entry, 3, "x, y, z take three");
  return output;
}

/// q of a unit translation in x, y, z: given, or read off the nodes and interfaces if every row belongs to one.
Eigen::MatrixXd read_translations(const SceneTable &frame, const fem::FrameMatrices &matrices,
                                  const std::vector<TableNode> &nodes, bool &known)
{
  const Eigen::Index n = matrices.M.rows();
  known                = true;
  if (frame.has("translations"))
  {
    const Eigen::MatrixXd R = read_any(frame, "translations", kind::number);
    if (R.rows() != n || R.cols() != 3)
      throw frame.error("translations", "is " + shape(R.rows(), R.cols()) + ", but must be " + shape(n, 3));
    return R;
  }
  std::vector<bool> known_row(n, false);
  Eigen::MatrixXd   R    = Eigen::MatrixXd::Zero(n, 3);
  const auto        read = [&](const fem::Interface &motions)
  {
    for (int motion = 0; motion < 6; ++motion)
      if (const int row = motions.coordinate[motion]; row >= 0)
      {
        known_row[row] = true;
        if (motion < 3)
          R(row, motion) = motions.sign[motion];
      }
  };
  for (const auto &interface : matrices.interfaces)
    read(interface);
  for (const auto &node : nodes)
    read(node.motions);
  known = std::find(known_row.begin(), known_row.end(), false) == known_row.end();
  return R;
}

/// [kg] as given, or by the rigid translations if those of all rows are known; else 0.
double total_mass(const SceneTable &frame, const fem::FrameMatrices &matrices, bool has_translations)
{
  if (!has_translations && !frame.has("total_mass"))
    return 0.;
  const Eigen::Matrix3d mass = matrices.translations.transpose() * Eigen::MatrixXd(matrices.M * matrices.translations);
  return frame.value_or("total_mass", mass.diagonal().maxCoeff());
}

} // namespace

fem::FrameMatrices read_frame_matrices(const SceneTable &frame, bool &has_translations)
{
  fem::FrameMatrices matrices;
  matrices.M           = read_square(frame, "mass", kind::mass_entry, 0);
  const Eigen::Index n = matrices.M.rows();
  matrices.C           = read_square(frame, "stiffness", kind::stiffness_entry, n);
  require_positive_diagonal(frame, "stiffness", matrices.C); // by the factor all of it is judged later
  matrices.B.resize(n, n);
  if (frame.is_table("damping"))
  {
    const FrameDamping damping   = read_damping(frame.table("damping"));
    matrices.modal_damping_ratio = damping.ratios;
    if (damping.alpha > 0. || damping.beta > 0.)
      matrices.B = damping.alpha * matrices.M + damping.beta * matrices.C;
  }
  else if (frame.has("damping"))
  {
    matrices.B = read_square(frame, "damping", kind::damping_entry, n);
    check_semidefinite(frame, "damping", matrices.B);
  }
  check_mass(frame, matrices.M, matrices.C);

  std::map<int, std::string> owner;
  const auto                 nodes = read_node_table(frame, n);
  matrices.interfaces              = named_nodes(frame, nodes, owner);
  for (const auto &table : frame.tables("interface"))
    add_interface(table, n, owner, matrices.interfaces);
  if (matrices.interfaces.empty())
    throw frame.error("has no interface; declare at least one [frame.interface.NAME] with rows = { uz = 1 }, or name a "
                      "node in the table of nodes");
  matrices.picture = read_node_picture(frame, nodes, n);
  for (const auto &table : frame.tables("cut"))
    matrices.outputs.push_back(read_output(table, "cut.", n));
  for (const auto &table : frame.tables("support")) // by matrix_support_keys()
    if (const auto directions = directions_of(table); directions.empty())
      matrices.outputs.push_back(read_output(table, "support.", n));
    else
      for (const auto &direction : directions)
        matrices.outputs.push_back(read_output(table.table(direction), "support." + table.name() + ".", n));

  matrices.translations = read_translations(frame, matrices, nodes, has_translations);
  matrices.mass         = total_mass(frame, matrices, has_translations);
  if (matrices.mass == 0.)
    matrices.statements.push_back("mass of the frame: not known, and effective masses count the rows of interfaces and "
                                  "nodes alone; 'translations' says how all rows move, 'total_mass' what it weighs");
  std::vector<fem::Interface> placed = matrices.interfaces;
  for (const TableNode &node : nodes)
    placed.push_back(node.motions);
  for (const std::string &suspicion : suspect_units(matrices, placed))
    frame.warn("mass", suspicion);
  return matrices;
}

} // namespace gestell::apps

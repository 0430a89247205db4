#include "apps/scene/read/frame/matrix_checks.h"

#include "fem/values/number_text.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using coupling::RowLabel;
using Sparse = Eigen::SparseMatrix<double>;

std::string number_text(double x)
{
  return rounded(x, 6);
}

/// Significant digits of the shortest decimal number that is x.
int digits_of(double x)
{
  std::string text = exact_text(std::abs(x));
  text.resize(std::min(text.find('e'), text.size()));
  text.erase(std::remove(text.begin(), text.end(), '.'), text.end());
  const auto first = text.find_first_not_of('0'), last = text.find_last_not_of('0');
  return first == std::string::npos ? 0 : int(last - first) + 1;
}

/// D A D of unit diagonal; rows without an own entry are scaled as the one with the largest.
Sparse at_unit_diagonal(const Sparse &A)
{
  const Eigen::VectorXd diagonal = A.diagonal();
  const double          largest  = diagonal.maxCoeff() > 0. ? diagonal.maxCoeff() : 1.;
  const Eigen::VectorXd scale =
      diagonal.unaryExpr([largest](double m) { return 1. / std::sqrt(m > 0. ? m : largest); });
  return scale.asDiagonal() * A * scale.asDiagonal();
}

double largest_row_sum(const Sparse &symmetric)
{
  double largest = 0.;
  for (int j = 0; j < symmetric.outerSize(); ++j)
  {
    double sum = 0.;
    for (Sparse::InnerIterator a(symmetric, j); a; ++a)
      sum += std::abs(a.value());
    largest = std::max(largest, sum);
  }
  return largest;
}

/// No eigenvalue below -tolerance.
bool is_semidefinite(const Sparse &A, double tolerance)
{
  Sparse unit(A.rows(), A.rows());
  unit.setIdentity();
  return Eigen::SimplicialLLT<Sparse>(A + tolerance * unit).info() == Eigen::Success;
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

} // namespace

std::string row_text(Eigen::Index row, const std::vector<RowLabel> &rows)
{
  return "row " + std::to_string(row + 1) + (rows.empty() ? "" : " (" + text_of(rows[std::size_t(row)]) + ")");
}

void check_symmetry(const SceneTable &frame, const std::string &key, const Sparse &A, const std::vector<RowLabel> &rows)
{
  double size = 0., skew = 0.;
  int    row = 0, column = 0;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator a(A, j); a; ++a)
    {
      if (!std::isfinite(a.value()))
        throw frame.error(key, "has an entry that is not a finite number in " + row_text(a.row(), rows));
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
  constexpr double symmetry_tolerance = 1e-9; // of the largest entry: files written with 10 digits pass
  if (skew <= symmetry_tolerance * size)
    return;
  if (has_one_triangle_only(A))
    throw frame.error(key, "contains only one triangle of a symmetric matrix; write both, or a MatrixMarket file with "
                           "'symmetric' in its header line and the lower triangle");
  const auto entry = [&](int i, int j)
  {
    return "row " + std::to_string(i + 1) + ", column " + std::to_string(j + 1) +
           (rows.empty() ? "" : " (" + text_of(rows[i]) + "; " + text_of(rows[j]) + ")") + " is " +
           number_text(A.coeff(i, j));
  };
  throw frame.error(key, "is not symmetric: " + entry(row, column) + ", but " + entry(column, row) +
                             "; gyroscopic or follower terms are not supported, export the symmetric part");
}

void require_positive_diagonal(const SceneTable &frame, const std::string &key, const Sparse &matrix,
                               const std::vector<RowLabel> &rows)
{
  const Eigen::VectorXd diagonal = matrix.diagonal();
  Eigen::Index          lowest;
  if (diagonal.minCoeff(&lowest) < 0.)
    throw frame.error(key, "is not positive semidefinite: " + row_text(lowest, rows) + " has " +
                               number_text(diagonal[lowest]) + " on the diagonal; it must be zero or positive");
}

double rounding_of(const Sparse &A)
{
  int most = 0;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator a(A, j); a; ++a)
      if (most = std::max(most, digits_of(a.value())); most >= 10)
        return least_rounding;
  constexpr double worst_rounding = 5e-5; // rounding to 5 digits, as in short fields of Nastran
  return std::min(0.5 * std::pow(10., 1 - most), worst_rounding);
}

void check_semidefinite(const SceneTable &frame, const std::string &key, const Sparse &matrix, double rounding,
                        const std::vector<RowLabel> &rows)
{
  require_positive_diagonal(frame, key, matrix, rows);
  const Sparse A         = at_unit_diagonal(matrix);
  const double explained = rounding * std::max(largest_row_sum(A), 1.);
  if (is_semidefinite(A, explained))
    return;
  // times what rounding explains: its own program had fewer digits, no more
  constexpr double beyond_doubt = 100.;
  if (is_semidefinite(A, beyond_doubt * explained))
    frame.warn(key, "has slightly negative energy for some motion, beyond " + number_text(explained) +
                        " at unit diagonal, the rounding of its file; was it written with fewer digits before?");
  else
    throw frame.error(key, "is not positive semidefinite: its off-diagonal entries give some motion negative energy; "
                           "check their signs and units");
}

void check_mass(const SceneTable &frame, const Sparse &M, double rounding, const Sparse &C,
                const std::vector<RowLabel> &rows)
{
  check_semidefinite(frame, "mass", M, rounding, rows);
  if (M.diagonal().maxCoeff() == 0.)
    throw frame.error("mass", "has only zeros on its diagonal; at least one coordinate needs a mass");
  const Eigen::VectorXd mass = M.diagonal(), stiffness = C.diagonal(); // of semidefinite matrices zero rows
  // of the largest: frequencies would differ by 1e15, more than a double has digits
  constexpr double vanishing_mass = 1e-30;
  for (Eigen::Index i = 0; i < mass.size(); ++i)
    if (mass[i] == 0. && stiffness[i] == 0.)
      throw frame.error("mass", row_text(i, rows) + " has neither mass nor stiffness, so its motion is undefined; "
                                                    "remove the row and column from all matrices");
    else if (mass[i] > 0. && mass[i] < vanishing_mass * mass.maxCoeff())
      throw frame.error("mass", row_text(i, rows) + " has " + number_text(mass[i]) +
                                    " on the diagonal, negligible relative to the largest, " +
                                    number_text(mass.maxCoeff()) +
                                    ": its frequency would overflow; write 0 for no mass");
}

void check_magnitude(const SceneTable &frame, const std::string &key, const Sparse &A)
{
  const double     largest       = A.nonZeros() > 0 ? A.coeffs().cwiseAbs().maxCoeff() : 0.;
  constexpr double largest_entry = 1e100; // products of three entries stay finite, and their inverses above zero
  if (largest > largest_entry || (largest > 0. && largest < 1. / largest_entry))
    throw frame.error(
        key, "has " + number_text(largest) +
                 " as its largest entry, implausible for a frame in kg, m, N and rad; check its units and its export");
}

} // namespace gestell::apps

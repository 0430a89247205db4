#include "coupling/exchange/rigid_motion_check.h"

#include "coupling/exchange/node_places.h"
#include "fem/values/number_text.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <set>

namespace gestell::coupling
{

namespace
{

using Sparse = Eigen::SparseMatrix<double>;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double vanishing = 1e-3; ///< share of what cancels: small fields of Nastran have four digits

Vector3d vector(const std::array<double, 3> &x)
{
  return {x[0], x[1], x[2]};
}

/// Rigid motions in the rows of nodes with positions; zero in other rows.
MatrixXd moved_nodes(const std::vector<RowLabel> &rows, const NodePlaces &places, const Vector3d &centre)
{
  MatrixXd R = MatrixXd::Zero(Eigen::Index(rows.size()), 6);
  for (Eigen::Index i = 0; i < R.rows(); ++i)
  {
    const RowLabel &row = rows[std::size_t(i)];
    if (row.is_rotation())
      R(i, row.component - 1) = 1.;
    else if (row.is_displacement())
    {
      const Vector3d arm      = vector(places.at(row.node)) - centre;
      R(i, row.component - 1) = 1.;
      for (int w = 0; w < 3; ++w)
        R(i, 3 + w) = Vector3d::Unit(w).cross(arm)[row.component - 1];
    }
  }
  return R;
}

/// R_s = -C_ss^-1 C_sb R_b of rows without a place.
void follow_without_strain(const Sparse &C, const std::vector<RowLabel> &rows, MatrixXd &R)
{
  std::vector<int> place(rows.size(), -1), pointless;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].component == 0)
    {
      place[i] = int(pointless.size());
      pointless.push_back(int(i));
    }
  if (pointless.empty())
    return;
  std::vector<Eigen::Triplet<double>> entries;
  for (const int j : pointless)
    for (Sparse::InnerIterator a(C, j); a; ++a)
      if (place[std::size_t(a.row())] >= 0)
        entries.emplace_back(place[std::size_t(a.row())], place[std::size_t(j)], a.value());
  Sparse Css(Eigen::Index(pointless.size()), Eigen::Index(pointless.size()));
  Css.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Sparse> factor(Css);
  if (factor.info() != Eigen::Success)
    return; // a mode without stiffness takes no part
  const MatrixXd x = factor.solve(MatrixXd(-(C * R)(pointless, Eigen::all)));
  if (x.allFinite())
    R(pointless, Eigen::all) = x;
}

/// |C r|_i over sum_j |C_ij r_j|; 0 where nothing acts.
MatrixXd residuals(const Sparse &C, const MatrixXd &R)
{
  const MatrixXd force = C * R, cancels = Sparse(C.cwiseAbs()) * MatrixXd(R.cwiseAbs());
  return (cancels.array() > 0.).select(force.cwiseAbs().cwiseQuotient(cancels), 0.);
}

/// Nodes with a support: at least one of their rows has a force under a translation.
std::set<long> supported_nodes(const MatrixXd &share, const std::vector<RowLabel> &rows)
{
  std::set<long> nodes;
  for (Eigen::Index i = 0; i < share.rows(); ++i)
    if (rows[std::size_t(i)].component > 0 && share.row(i).head(3).maxCoeff() > vanishing)
      nodes.insert(rows[std::size_t(i)].node);
  return nodes;
}

void compare_rows(const Sparse &C, const std::vector<RowLabel> &rows, RigidMotionCheck &check)
{
  const MatrixXd       share     = residuals(C, check.R);
  const std::set<long> supported = supported_nodes(share, rows);
  for (Eigen::Index i = 0; i < share.rows(); ++i)
  {
    if (rows[std::size_t(i)].component == 0)
      continue;
    ++check.n_rows;
    check.translation_residual = std::max(check.translation_residual, share.row(i).head(3).maxCoeff());
    if (supported.count(rows[std::size_t(i)].node) > 0)
      continue;
    ++check.n_quiet;
    const double rotation = share.row(i).tail(3).maxCoeff();
    check.n_disturbed += rotation > vanishing;
    if (rotation > check.rotation_residual)
    {
      check.rotation_residual = rotation;
      check.worst             = int(i);
    }
  }
}

/// Number of eigenvalues below a negligible value sigma, by Sylvester's law of C - sigma M.
int count_free_motions(const Sparse &M, const Sparse &C)
{
  const double  mass = M.diagonal().mean(), stiffness = C.diagonal().mean();
  constexpr int most_rows = 20000; // rows factorised to count free motions: takes a second
  if (C.rows() > most_rows || !(mass > 0.))
    return -1;
  constexpr double                    no_motion = 1e-12; // of mean C over mean M: far below elastic motions
  const Sparse                        shifted   = C - no_motion * stiffness / mass * M;
  const Eigen::SimplicialLDLT<Sparse> factor(shifted);
  return factor.info() == Eigen::Success ? int((factor.vectorD().array() < 0.).count()) : -1;
}

/// c of the block -m [c]x of R^T M R about the origin.
Vector3d centre_of_mass(const MatrixXd &mass)
{
  const auto m    = [&](int d) { return mass(d, d) > 0. ? mass(d, d) : 1.; };
  const auto mean = [](double a, double b, bool has_a, bool has_b) {
    return has_a && has_b ? (a + b) / 2. : has_a ? a : has_b ? b : 0.;
  };
  const bool x = mass(0, 0) > 0., y = mass(1, 1) > 0., z = mass(2, 2) > 0.;
  return {mean(mass(1, 5) / m(1), -mass(2, 4) / m(2), y, z), mean(mass(2, 3) / m(2), -mass(0, 5) / m(0), z, x),
          mean(mass(0, 4) / m(0), -mass(1, 3) / m(1), x, y)};
}

void bound(const std::vector<RowLabel> &rows, const NodePlaces &places, RigidMotionCheck &check)
{
  bool first = true;
  for (const RowLabel &row : rows)
    if (row.component > 0)
    {
      const auto &x = places.at(row.node);
      for (int d = 0; d < 3; ++d)
      {
        check.lowest[d]  = first ? x[d] : std::min(check.lowest[d], x[d]);
        check.highest[d] = first ? x[d] : std::max(check.highest[d], x[d]);
      }
      first = false;
    }
}

std::string share_text(double share)
{
  return short_text(share, 2);
}

} // namespace

RigidMotionCheck check_rigid_motions(const Sparse &M, const Sparse &C, const std::vector<RowLabel> &rows,
                                     const NodePlaces &places)
{
  RigidMotionCheck check;
  bound(rows, places, check);
  const Vector3d middle = (vector(check.lowest) + vector(check.highest)) / 2.;
  check.R               = moved_nodes(rows, places, middle);
  follow_without_strain(C, rows, check.R);
  const MatrixXd mass = check.R.transpose() * MatrixXd(M * check.R);
  check.mass          = mass.diagonal().head(3);
  const Vector3d arm  = centre_of_mass(mass);
  check.centre        = middle + arm;
  for (int w = 0; w < 3; ++w) // about the centre: w x (x - c) = w x (x - middle) - w x arm
    check.R.col(3 + w) -= check.R.leftCols(3) * Vector3d::Unit(w).cross(arm);
  compare_rows(C, rows, check);
  if (2 * check.n_quiet < check.n_rows) // otherwise supports are few, and rotations are sufficient
    check.n_free = count_free_motions(M, C);
  return check;
}

MatrixXd rigid_translations(const Sparse &C, const std::vector<RowLabel> &rows)
{
  MatrixXd R = MatrixXd::Zero(Eigen::Index(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].is_displacement())
      R(Eigen::Index(i), rows[i].component - 1) = 1.;
  follow_without_strain(C, rows, R);
  return R;
}

std::string statement_of(const RigidMotionCheck &check)
{
  const Vector3d &m       = check.mass;
  const double    largest = m.maxCoeff();
  std::string     text    = "rigid motions of the nodes: mass ";
  if (largest - m.minCoeff() <= 1e-6 * largest)
    text += rounded(largest) + " kg";
  else
    for (int d = 0; d < 3; ++d)
      if (m[d] > 0.) // of a plane frame some have no rows
        text += (text.back() == ' ' ? "" : ", ") + rounded(m[d]) + " kg by " + "xyz"[d];
  text += ", centre " + place_text({check.centre[0], check.centre[1], check.centre[2]});
  const std::string quiet = std::to_string(check.n_quiet) + " of " + std::to_string(check.n_rows) + " rows";
  if (check.n_quiet == 0)
    return text + "; supports act on all rows, so the stiffness cannot verify the positions of the rows";
  text += check.n_quiet == check.n_rows ? "; free: " : "; " + quiet + " are without support: ";
  return text + "translations leave, relative to the forces that cancel in a row, " +
         (check.n_quiet == check.n_rows ? share_text(check.translation_residual) : "less than 0.001") + ", rotations " +
         share_text(check.rotation_residual);
}

std::string suspicion_of(const RigidMotionCheck &check, const std::vector<RowLabel> &rows)
{
  if (check.n_disturbed > 0)
    return "the positions of nodes do not match the stiffness: under rigid-body rotation, " +
           std::to_string(check.n_disturbed) + " of " + std::to_string(check.n_quiet) +
           " rows without support have forces, the worst (" + text_of(rows[std::size_t(check.worst)]) + ") with " +
           share_text(check.rotation_residual) +
           " of the forces that cancel in it. The table of nodes may be of another model, unit or order, or rows of "
           "rotations may be missing";
  const bool is_free = check.n_free >= 6 || check.n_quiet == check.n_rows;
  if (check.n_free >= 6 && check.n_quiet < check.n_rows)
    return "the stiffness has " + std::to_string(check.n_free) +
           " unconstrained motions, but not the rigid-body modes of the nodes: under translation, rows have " +
           share_text(check.translation_residual) +
           " of the forces that cancel in them. The rows may be of other nodes or directions";
  const double largest = check.mass.maxCoeff();
  const double least = (check.mass.array() > 0.).select(check.mass, largest).minCoeff(); // of directions that have rows
  // masses by x, y and z of a free frame: digits of files, not a part that is missing in one direction
  constexpr double alike = 0.02;
  if (is_free && least < (1. - alike) * largest)
    return "the frame is free, but its mass is " + rounded(check.mass[0]) + ", " + rounded(check.mass[1]) + " and " +
           rounded(check.mass[2]) + " kg in x, y and z; check that mass and stiffness have the same rows";
  return "";
}

} // namespace gestell::coupling

#include "coupling/periodic/shift_invariance.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/integration/system/turning_forces.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double rounding_of_sums = 1e-11; ///< of a sum of products, of the sum of their sizes
constexpr double same_row         = 1e-9;  ///< of unit rows: what rounding leaves of dependent ones

/// Numbers in (-1, 1), the same ones in every run.
class Numbers
{
public:
  double next() { return 2. * double(generator_() >> 11) * 0x1p-53 - 1.; }
  /// Of either sign, from 10^low to 10^high in size.
  double of_any_size(double low, double high)
  {
    const double sign = next() < 0. ? -1. : 1.;
    return sign * std::pow(10., low + (high - low) * 0.5 * (next() + 1.));
  }

private:
  std::mt19937_64 generator_{44};
};

/// Independent combinations of rows of about unit length, each with a one where all others have a zero.
MatrixXd echelon_form(const MatrixXd &rows)
{
  if (rows.rows() == 0)
    return rows;
  const Eigen::JacobiSVD<MatrixXd> svd(rows, Eigen::ComputeThinV);
  const VectorXd                  &s    = svd.singularValues();
  const Index                      rank = (s.array() > same_row * s[0]).count();
  MatrixXd                         R    = svd.matrixV().leftCols(rank).transpose();
  std::vector<Index>               leads;
  for (Index k = 0; k < rank; ++k)
  {
    Index row, column;
    R.bottomRows(rank - k).cwiseAbs().maxCoeff(&row, &column);
    R.row(k).swap(R.row(k + row));
    R.row(k) /= R(k, column);
    for (Index i = 0; i < rank; ++i)
      if (i != k)
        R.row(i) -= RowVectorXd(R(i, column) * R.row(k));
  }
  return (R.array().abs() > same_row).select(R, 0.);
}

/// Orthonormal null space [columns x k] of rows.
MatrixXd null_space(const MatrixXd &rows)
{
  if (rows.rows() == 0)
    return MatrixXd::Identity(rows.cols(), rows.cols());
  const Eigen::JacobiSVD<MatrixXd> svd(rows, Eigen::ComputeFullV);
  const VectorXd                  &s    = svd.singularValues();
  const Index                      rank = (s.array() > same_row * s[0]).count();
  return svd.matrixV().rightCols(rows.cols() - rank);
}

/// Row products a b, without those that are the rounding of sums.
void append_rows(const MatrixXd &a, const MatrixXd &b, MatrixXd &rows)
{
  const MatrixXd product = a * b, size = a.cwiseAbs() * b.cwiseAbs();
  for (Index i = 0; i < product.rows(); ++i)
    if (const double norm = product.row(i).norm(); norm > rounding_of_sums * size.row(i).norm() && std::isfinite(norm))
    {
      rows.conservativeResize(rows.rows() + 1, b.cols());
      rows.bottomRows(1) = product.row(i) / norm;
    }
}
} // namespace

AngleInvariance::AngleInvariance(SecondOrderSystem &system, std::vector<int> angles, const PeriodicGuess &about,
                                 double t)
    : system_(system), angles_(std::move(angles)), n_(system.linear().size()),
      n_u_(int(system.forces().directions().cols()))
{
  const Index a = Index(angles_.size());
  to_measures_.resize(n_u_, a);
  mass_.resize(a);
  VectorXd y(n_);
  for (Index k = 0; k < a; ++k)
  {
    const VectorXd e    = VectorXd::Unit(n_, angles_[std::size_t(k)]);
    to_measures_.col(k) = system_.forces().directions().transpose() * e;
    system_.linear().mass_times(e, y);
    mass_[k] = y[angles_[std::size_t(k)]] > 0. ? y[angles_[std::size_t(k)]] : 1.;
  }
  EventSystem   &events     = system_.events();
  const VectorXd remembered = events.save_history();
  events.follow_history(false);
  gather_laws();
  make_samples(about, t);
  find_driven();
  look_at_laws();
  look_at_stiffness();
  events.restore_history(remembered);
}

/// Elements that act on an angle, and joints of one.
void AngleInvariance::gather_laws()
{
  const auto acts = [&](int first, int n) { return !to_measures_.middleRows(first, n).isZero(0.); };
  for (const ForceBlock &block : system_.forces().blocks())
    if (acts(block.first_measure, block.n_measures))
      laws_.push_back(
          {block.first_measure, block.n_measures, system_.forces().element_of(block.first_measure), {}, false});
  for (const ConstraintBlock &block : system_.joints().blocks())
    if (acts(block.first_measure, block.n_measures))
      laws_.push_back({n_u_ + block.first_row, block.n_rows, system_.joints().name(block.first_row), {}, false});
}

void AngleInvariance::make_samples(const PeriodicGuess &about, double t)
{
  Numbers     numbers;
  const auto &W = system_.forces().directions();
  LocalState  state;
  state.resize(system_);
  constexpr int n_samples = 48; // states; a law with a gap acts in about half of them
  for (int k = 0; k < n_samples && !laws_.empty(); ++k)
  {
    state.t                      = t;
    state.u                      = W.transpose() * about.q;
    state.v                      = W.transpose() * about.v;
    constexpr double turns_about = 8.; // that angles are shifted by, so that gaps of any size close
    const VectorXd   shift =
        VectorXd::NullaryExpr(Index(angles_.size()), [&](Index) { return 2. * M_PI * turns_about * numbers.next(); });
    state.u += to_measures_ * shift;
    for (int i = 0; i < n_u_; ++i)
    {
      if (k % 2 == 1) // else all that is no angle stays where it is
        state.u[i] += numbers.of_any_size(-6., 0.);
      state.v[i] += numbers.next() * state.v[i] + numbers.of_any_size(-6., 1.);
      state.a[i] = numbers.of_any_size(-3., 3.);
    }
    try
    {
      VectorXd all = laws_at(state);
      samples_.push_back(state);
      at_samples_.push_back(std::move(all));
    }
    catch (const std::exception &) // a state that a law does not know
    {
    }
  }
}

/// Joints whose equations change with the time.
void AngleInvariance::find_driven()
{
  constexpr double later[] = {0.3819660112501052, 1.902113032590307, 7.320508075688773}; // [s] of no period: irrational
  for (std::size_t k = 0; k < samples_.size(); ++k)
    for (const double time : later)
    {
      LocalState state = samples_[k];
      state.t += time;
      const VectorXd after = laws_at(state);
      for (Law &law : laws_)
        law.driven = law.driven || (law.first >= n_u_ && changes(law, at_samples_[k], after));
    }
}

/// Forces of the elements and equations of the joints, one behind the other.
VectorXd AngleInvariance::laws_at(LocalState state) const
{
  const IdealJoints &joints = system_.joints();
  VectorXd           p = VectorXd::Zero(n_u_), g = VectorXd::Zero(joints.n_rows()), all(n_u_ + g.size());
  system_.events().start(state);
  system_.forces().force(state, p);
  if (g.size() > 0)
  {
    ConstraintJacobian G(joints.blocks());
    joints.constraints(state, g, G);
  }
  all << p, g;
  return all;
}

void AngleInvariance::look_at_laws()
{
  const IdealJoints &joints = system_.joints();
  MatrixXd           p_u = MatrixXd::Zero(n_u_, n_u_), p_v = p_u;
  VectorXd           p = VectorXd::Zero(n_u_), g(joints.n_rows());
  ConstraintJacobian G(joints.blocks());
  for (const LocalState &state : samples_)
  {
    system_.events().start(state);
    p_u.setZero();
    linearise(system_.forces(), state, p, p_u, p_v);
    if (g.size() > 0)
      joints.constraints(state, g, G);
    for (Law &law : laws_)
      if (law.first < n_u_)
        append_rows(p_u.block(law.first, law.first, law.n, law.n), to_measures_.middleRows(law.first, law.n), law.rows);
      else
        for (std::size_t b = 0; b < joints.blocks().size(); ++b)
          if (const ConstraintBlock &block = joints.blocks()[b]; n_u_ + block.first_row == law.first)
            append_rows(G[b], to_measures_.middleRows(block.first_measure, block.n_measures), law.rows);
  }
  for (Law &law : laws_)
  {
    law.rows = echelon_form(law.rows);
    if (law.rows.rows() == 0)
      continue;
    const MatrixXd along = law.rows.transpose() * (law.rows * law.rows.transpose()).inverse();
    for (Index k = 0; k < law.rows.rows(); ++k)
    {
      AngleDependence dependence{law.rows.row(k), 0, law.name};
      constexpr int   most_turns = 64; // after which a law of an angle repeats, or a machine
      for (int turns = 1; turns <= most_turns && dependence.turns == 0; ++turns)
        if (!changes(law, 2. * M_PI * turns * along.col(k)))
          dependence.turns = turns;
      if (dependence.turns > 0 || !law.driven)
        dependences_.push_back(std::move(dependence));
    }
  }
}

void AngleInvariance::look_at_stiffness()
{
  MatrixXd C(n_, Index(angles_.size())), rows(0, C.cols());
  VectorXd y(n_);
  double   largest = 0.;
  for (Index k = 0; k < C.cols(); ++k)
  {
    system_.linear().stiffness_times(VectorXd::Unit(n_, angles_[std::size_t(k)]), y);
    C.col(k) = y;
    largest  = std::max(largest, y.cwiseAbs().maxCoeff());
  }
  for (Index i = 0; i < n_; ++i)
    if (const double norm = C.row(i).norm(); norm > rounding_of_sums * largest)
    {
      rows.conservativeResize(rows.rows() + 1, C.cols());
      rows.bottomRows(1) = C.row(i) / norm;
    }
  const MatrixXd independent = echelon_form(rows);
  for (Index k = 0; k < independent.rows(); ++k)
    dependences_.push_back({independent.row(k), 0, "the stiffness"});
}

bool AngleInvariance::changes(const Law &law, const VectorXd &before, const VectorXd &after) const
{
  double largest = 0.;
  for (const VectorXd &all : at_samples_)
    if (const auto of_law = all.segment(law.first, law.n); of_law.allFinite())
      largest = std::max(largest, of_law.cwiseAbs().maxCoeff());
  const auto a = before.segment(law.first, law.n), b = after.segment(law.first, law.n);
  if (!a.allFinite())
    return false;
  constexpr double same_force = 1e-8;  // of forces after up to 64 turns, whose angles are rounded to 1e-13
  constexpr double no_force   = 1e-12; // of the largest of all samples
  return !((a - b).cwiseAbs().maxCoeff() <=
           same_force * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()) + no_force * largest);
}

bool AngleInvariance::changes(const Law &law, const VectorXd &shift) const
{
  for (std::size_t k = 0; k < samples_.size(); ++k)
  {
    LocalState state = samples_[k];
    state.u += to_measures_ * shift;
    try
    {
      if (changes(law, at_samples_[k], laws_at(state)))
        return true;
    }
    catch (const std::invalid_argument &) // the law is not defined there, such as gas without volume
    {
      return true;
    }
  }
  return false;
}

std::string AngleInvariance::changed_by(const VectorXd &shift) const
{
  EventSystem   &events     = system_.events();
  const VectorXd remembered = events.save_history();
  events.follow_history(false);
  std::string element;
  for (const Law &law : laws_)
    if (element.empty() && !law.driven && changes(law, shift))
      element = law.name;
  events.restore_history(remembered);
  return element;
}

MatrixXd AngleInvariance::free() const
{
  MatrixXd rows(Index(dependences_.size()), Index(angles_.size()));
  for (std::size_t k = 0; k < dependences_.size(); ++k)
    rows.row(Index(k)) = dependences_[k].of.normalized();
  const MatrixXd null      = null_space(rows);
  MatrixXd       all       = MatrixXd::Zero(n_, null.cols());
  all(angles_, Eigen::all) = null;
  return all;
}

VectorXd AngleInvariance::nearest(const VectorXd &x, const VectorXd &values, bool never_repeating) const
{
  MatrixXd rows(0, x.size());
  VectorXd missing(0);
  for (std::size_t k = 0; k < dependences_.size(); ++k)
    if (const AngleDependence &d = dependences_[k]; d.turns == 0 || !never_repeating)
    {
      const double norm = d.of.norm();
      rows.conservativeResize(rows.rows() + 1, x.size());
      missing.conservativeResize(rows.rows());
      rows.bottomRows(1) = d.of / norm;
      missing.tail(1)[0] = (values[Index(k)] - d.of.dot(x)) / norm;
    }
  if (rows.rows() == 0)
    return x;
  const VectorXd                                   weight = mass_.cwiseSqrt().cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(same_row);
  solver.compute(rows * weight.asDiagonal());
  return x + weight.asDiagonal() * solver.solve(missing);
}

std::string free_coordinate(const PeriodicProblem &problem)
{
  Index most;
  problem.free.col(0).cwiseAbs().maxCoeff(&most);
  return problem.system->linear().coordinate_name(int(most));
}

MatrixXd without_coordinate(const MatrixXd &free, int coordinate)
{
  return free.cols() == 0 ? free : MatrixXd(free * null_space(free.row(coordinate)));
}

} // namespace gestell::coupling

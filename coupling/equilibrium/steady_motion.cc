#include "coupling/equilibrium/steady_motion.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/configuration/loop_closure.h"
#include "coupling/machine/configuration/plays.h"

#include <Eigen/QR>

#include <cmath>
#include <sstream>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double torn = 0.01; ///< opening of a closed chain relative to the motions that cause it; deflections: 1e-3

/// Linear demands A x = b on a motion, for several right-hand sides at once.
struct Demands
{
  MatrixXd A; ///< [k x n]
  MatrixXd b; ///< [k x number of motions]
};

/// Satisfies demands one after the other: each can use only the DOFs that the previous ones leave.
class Freedom
{
public:
  /// @param scale  [n] of the coordinates: motions of equal size have equal kinetic energy; 0: at rest
  Freedom(const VectorXd &scale, Eigen::Index n_motions)
      : Z_(scale.asDiagonal()), X_(MatrixXd::Zero(scale.size(), n_motions))
  {
  }

  /// Satisfies the demands by least squares with the smallest motion.
  /// @return the rank of the demands in the remaining DOFs
  Eigen::Index satisfy(const Demands &demands)
  {
    if (demands.A.rows() == 0 || Z_.cols() == 0)
      return 0;
    constexpr double         dependent = 1e-10; // pivot of rows scaled to unit masses that counts as zero
    const LeastSquaresSolver solver(demands.A * Z_, dependent);
    X_ += Z_ * solver.solve(demands.b - demands.A * X_);
    Z_ = Z_ * solver.null_space();
    return solver.rank();
  }

  /// For rows of the size `whole`: no effect if they have no part in the remaining DOFs.
  bool satisfy(const Demands &demands, double whole)
  {
    const MatrixXd P         = demands.A * Z_;
    const double   threshold = free_threshold(P, whole);
    if (threshold >= 1.)
      return false;
    const LeastSquaresSolver solver(P, threshold);
    X_ += Z_ * solver.solve(demands.b - demands.A * X_);
    Z_ = Z_ * solver.null_space();
    return true;
  }

  const MatrixXd &motions() const { return X_; }
  const MatrixXd &free() const { return Z_; }

private:
  MatrixXd Z_, X_;
};

/// 1/sqrt(m) of bodies; 0 for coordinates at rest or without mass.
VectorXd motion_scale(const Machine &machine)
{
  const MatrixXd M     = dense_mass(machine);
  VectorXd       scale = VectorXd::Zero(machine.size());
  for (int i = machine.model().n_frame(); i < machine.size(); ++i)
    scale[i] = M(i, i) > 0. ? 1. / std::sqrt(M(i, i)) : 1.;
  for (const int i : machine.linear().virtual_coordinates())
    scale[i] = 0.;
  return scale;
}

/// Right-hand sides as columns: v, a, S.
MatrixXd sides(const VectorXd &rate, const VectorXd &acceleration, Eigen::Index n_held)
{
  MatrixXd b = MatrixXd::Zero(rate.size(), 2 + n_held);
  b.col(0)   = rate;
  b.col(1)   = acceleration;
  return b;
}

Demands joint_demands(const Machine &machine, const LocalState &local, Eigen::Index n_held)
{
  const int          n_c = machine.joints().n_rows();
  VectorXd           g(n_c), rate(n_c), bias(n_c);
  ConstraintJacobian G(machine.joints().blocks());
  machine.joints().constraints(local, g, G);
  machine.joints().rates(local, rate, bias);
  return {joint_jacobian(machine, G), sides(-rate, -bias, n_held)};
}

/// Rows of coordinates with a given speed; their acceleration is zero, with a unit column in S.
Demands given_demands(const Machine &machine, const KnownStart &known, const VectorXd &q, const VectorXd &v)
{
  const int             n = machine.size();
  std::vector<VectorXd> rows;
  std::vector<double>   speeds, accelerations;
  const auto            add = [&](const VectorXd &row, double speed, double acceleration)
  {
    rows.push_back(row);
    speeds.push_back(speed);
    accelerations.push_back(acceleration);
  };
  for (int i = machine.model().n_frame(); i < n; ++i)
    if (known.v_given[i])
      add(VectorXd::Unit(n, i), known.state.v[i], 0.);
  VectorXd gradient;
  for (const auto &[name, rate] : known.rates)
  {
    machine.model().measure(name).evaluate(q, v, &gradient);
    add(gradient, rate, -machine.model().measure(name).acceleration(q, v, VectorXd::Zero(n)));
  }
  for (const KnownSpin &spin : known.spins)
    add(spin_gradient(machine, spin, q), spin.value, 0.);

  const auto n_held = Eigen::Index(rows.size());
  Demands    result{MatrixXd(n_held, n),
                 sides(VectorXd::Map(speeds.data(), n_held), VectorXd::Map(accelerations.data(), n_held), n_held)};
  for (Eigen::Index i = 0; i < n_held; ++i)
    result.A.row(i) = rows[std::size_t(i)];
  result.b.rightCols(n_held).setIdentity();
  return result;
}

/// Demands of compliant joints, treated as ideal joints.
Demands compliant_demands(const Machine &machine, const LocalState &local, Eigen::Index n_held)
{
  std::vector<VectorXd> rows;
  std::vector<double>   biases;
  for (const CompliantPlace &place : compliant_joints(machine))
    for (int i = 0; i < place.joint->n_equations(); ++i)
    {
      const int  k = place.joint->n_measures();
      VectorXd   gradient(k);
      const auto opening = place.joint->opening(i, local.u.data() + place.first_measure,
                                                local.v.data() + place.first_measure, gradient.data());
      biases.push_back(-opening.bias);
      rows.push_back(machine.forces().directions().middleCols(place.first_measure, k) * gradient);
    }
  const auto n = Eigen::Index(rows.size());
  Demands    result{MatrixXd(n, machine.size()), sides(VectorXd::Zero(n), VectorXd::Map(biases.data(), n), n_held)};
  for (Eigen::Index i = 0; i < n; ++i)
    result.A.row(i) = rows[std::size_t(i)];
  return result;
}

Demands chain_demands(const Machine &machine, const VectorXd &q, const VectorXd &v, Eigen::Index n_held)
{
  const Closures chain = closures(machine, q, v);
  return {chain.J, sides(VectorXd::Zero(chain.g.size()), -chain.curvature, n_held)};
}

/// First measures of plays that something free closes, and plays that nothing free has a part in.
struct SatisfiedPlays
{
  std::vector<int>        closed;
  std::vector<PlacedPlay> determined;
};

/// Closes plays: both sides move together, and a play that presses on its stop stays there.
SatisfiedPlays satisfy_plays(const Machine &machine, const VectorXd &q, const VectorXd &v, const VectorXd &scale,
                             Freedom &freedom, Eigen::Index n_held)
{
  SatisfiedPlays result;
  for (const PlacedPlay &own : plays(machine, q, v))
  {
    if (!own.play.both && !own.play.presses())
      continue;
    if (own.chain || freedom.satisfy({own.G, sides(VectorXd::Zero(own.play.n), -own.bias(), n_held)},
                                     (own.G * scale.asDiagonal()).norm()))
      result.closed.push_back(own.first_measure);
    else if (own.play.both)
      result.determined.push_back(own);
  }
  return result;
}

/// Stationary elastic energy 1/2 x^T K x in what is free, Z^T K x = 0.
Demands elastic_demands(const Machine &machine, const VectorXd &q, const MatrixXd &Z, Eigen::Index n_motions)
{
  MatrixXd engaged, damping;
  engaged_matrices(machine, q, {}, engaged, damping);
  return {Z.transpose() * (dense_stiffness(machine) + engaged), MatrixXd::Zero(Z.cols(), n_motions)};
}

[[noreturn]] void refuse_speeds()
{
  throw std::invalid_argument(
      "the joints make the speeds in start.v depend on each other, or block one of them; for a steady initial state "
      "give only the speeds of the drives; the joints determine the others");
}

/// Least squares may leave elastic closures open, but not by more than their deflections explain, relative to the
/// largest opening by a motion x of the same kinetic energy, |A_i x| <= |A_i scale| |x / scale|.
void require_closed(const Demands &demands, const MatrixXd &X, const VectorXd &scale)
{
  const MatrixXd open  = (demands.A * X - demands.b).cwiseAbs();
  const VectorXd rows  = (demands.A * scale.asDiagonal()).rowwise().norm();
  const MatrixXd sizes = X.array().colwise() * scale.unaryExpr([](double s) { return s > 0. ? 1. / s : 0.; }).array();
  if ((open.array() > torn * (rows * sizes.colwise().norm()).array()).any())
    refuse_speeds();
}

/// A clearance with both sides determined by given speeds and prescribed motions closes at once if these contradict
/// each other.  If one of them determines both sides, the clearance is a stop that the machine passes.
void require_agreement(const Machine &machine, const SatisfiedPlays &plays, const KnownStart &known, const VectorXd &q,
                       const MatrixXd &X)
{
  const VectorXd     speeds    = given_demands(machine, known, q, X.col(0)).b.col(0);
  const Eigen::Index n_held    = speeds.size();
  const MatrixXd     of_speeds = X.rightCols(n_held) * speeds.asDiagonal();
  for (const PlacedPlay &own : plays.determined)
  {
    MatrixXd shares(own.play.n, 1 + n_held); // of prescribed motions and of each speed
    shares << own.G * (X.col(0) - of_speeds.rowwise().sum()), own.G * of_speeds;
    const VectorXd sizes = shares.colwise().norm();
    const double   part = torn * sizes.maxCoeff(), rate = shares.rowwise().sum().norm();
    if (rate > part && (sizes.array() > part).count() > 1)
    {
      std::ostringstream text;
      text << "the speeds in start.v contradict each other across the play of \"" << own.name << "\", which closes at "
           << rate
           << " m/s (or rad/s); for a steady initial state give only the speeds of the drives, since clearances "
              "determine the others; for an impact use rule = \"given\"";
      throw std::invalid_argument(text.str());
    }
  }
}

/// One pass: v does not depend on `v_before`; a and its curvatures are correct if `v_before` equals v.
SteadyMotion motion_with(const Machine &machine, const KnownStart &known, const VectorXd &q, const VectorXd &v_before)
{
  LocalState local;
  local.resize(machine);
  machine.gather(known.state.t, q, v_before, VectorXd::Zero(machine.size()), local);
  const Demands      given  = given_demands(machine, known, q, v_before);
  const Eigen::Index n_held = given.A.rows();
  const VectorXd     scale  = motion_scale(machine);
  Freedom            freedom(scale, 2 + n_held);
  freedom.satisfy(joint_demands(machine, local, n_held));
  if (freedom.satisfy(given) < n_held)
    refuse_speeds();
  const Demands compliant = compliant_demands(machine, local, n_held),
                chain     = chain_demands(machine, q, v_before, n_held);
  freedom.satisfy(compliant);
  freedom.satisfy(chain);
  SatisfiedPlays plays = satisfy_plays(machine, q, v_before, scale, freedom, n_held);
  freedom.satisfy(elastic_demands(machine, q, freedom.free(), 2 + n_held));
  const MatrixXd &X = freedom.motions();
  require_closed(compliant, X, scale);
  require_closed(chain, X, scale);
  require_agreement(machine, plays, known, q, X);
  return {X.col(0), X.col(1), X.rightCols(n_held), std::move(plays.closed)};
}

} // namespace

SteadyMotion steady_motion(const Machine &machine, const KnownStart &known, const VectorXd &q)
{
  return motion_with(machine, known, q, motion_with(machine, known, q, VectorXd::Zero(machine.size())).v);
}

} // namespace gestell::coupling

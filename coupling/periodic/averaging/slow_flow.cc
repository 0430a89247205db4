#include "coupling/periodic/averaging/slow_flow.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/integration/system/turning_forces.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rest_tolerance = 1e-13; ///< of the motion: rounding of sums over its coordinates

[[noreturn]] void refuse_averaging(const std::string &reason)
{
  throw std::invalid_argument("averaging: " + reason);
}

} // namespace

SlowFlow::SlowFlow(const PeriodicProblem &problem, int mode)
    : problem_(problem), entry_history_(problem.system->events().save_history())
{
  const SecondOrderSystem &system = *problem.system;
  if (system.joints().n_rows() > 0)
    refuse_averaging("it does not support ideal joints; use shooting, or compliant joints");
  if (!system.linear().dense_matrices(M_, B_, C_))
    refuse_averaging("it works in a mode of the base system, and an unreduced frame has too many; reduce the frame");
  if (problem.turn.size() > 0 && !problem.turn.isZero(0.))
    refuse_averaging("a rotating motion is not a vibration about an equilibrium; use shooting");
  W_ = MatrixXd(system.forces().directions());
  problem.system->events().follow_history(false);
  find_rest();
  find_load();
  find_mode(mode);
}

SlowFlow::~SlowFlow()
{
  problem_.system->events().restore_history(entry_history_);
}

/// C q = f_0 + W p(W^T q, 0) by Newton's method, and the system linearised there.
void SlowFlow::find_rest()
{
  const SecondOrderSystem &system = *problem_.system;
  LocalState               state;
  state.resize(W_.cols());
  MatrixXd       dp_du = MatrixXd::Zero(W_.cols(), W_.cols()), dp_dv = dp_du;
  const VectorXd load           = system.linear().excitation().constant();
  rest_                         = VectorXd::Zero(M_.rows());
  constexpr int rest_iterations = 100; // Newton's, of piecewise linear laws: a branch each
  for (int k = 0; k < rest_iterations; ++k)
  {
    state.t = problem_.begin;
    state.u = W_.transpose() * rest_;
    if (k == 0)
      problem_.system->events().start(state);
    if (W_.cols() > 0)
      linearise(system.forces(), state, state.p, dp_du, dp_dv);
    linear_C_           = C_ - W_ * dp_du * W_.transpose();
    const VectorXd step = lu_solution(linear_C_, load + W_ * state.p - C_ * rest_);
    if (!step.allFinite())
      refuse_averaging("the system has an unconstrained DOF, so it has no equilibrium; use shooting");
    rest_ += step;
    if (step.norm() <= rest_tolerance * (1e-300 + rest_.norm()))
    {
      linear_B_    = B_ - W_ * dp_dv * W_.transpose();
      flexibility_ = lu_solution(linear_C_, MatrixXd::Identity(C_.rows(), C_.rows()));
      q_0_         = rest_;
      return;
    }
  }
  refuse_averaging("the equilibrium of the system is not found; use settling");
}

void SlowFlow::find_load()
{
  const Excitation &excitation = problem_.system->linear().excitation();
  if (excitation.has_rest() || excitation.harmonics().size() > 1)
    refuse_averaging("it supports loads of one frequency only; use harmonic-balance for more");
  if (!excitation.harmonics().empty())
    load_omega_ = excitation.harmonics()[0].omega;
}

/// Distance of a mode from what is asked for; infinite for one that neither load nor elements move.
double SlowFlow::nearness(int mode, const VectorXd &omega, const MatrixXd &shapes) const
{
  constexpr double never = std::numeric_limits<double>::infinity();
  const VectorXd   phi   = shapes.col(mode);
  if (!(omega[mode] > 0.))
    return never;
  if (load_omega_ > 0.)
  {
    double force = 0., largest = 0.;
    for (const Excitation::Entry &entry : problem_.system->linear().excitation().harmonics()[0].load)
    {
      force += phi[entry.coordinate] * std::hypot(entry.cosine, entry.sine);
      largest += phi.cwiseAbs().maxCoeff() * std::hypot(entry.cosine, entry.sine);
    }
    constexpr double no_mode_moved = 1e-9; // of the largest force on a mode: rounding
    return std::abs(force) > no_mode_moved * largest ? std::abs(omega[mode] - load_omega_) : never;
  }
  return phi.dot(linear_B_ * phi) < 0. ? std::abs(omega[mode] - 2. * M_PI / problem_.period) : never;
}

void SlowFlow::find_mode(int mode)
{
  constexpr double symmetric = 1e-9; // C - C^T beside C that moves the answer less than averaging itself errs
  if ((linear_C_ - linear_C_.transpose()).cwiseAbs().maxCoeff() > symmetric * linear_C_.cwiseAbs().maxCoeff())
    refuse_averaging("follower forces (loads with carried_by, friction under a moving load) make its modes "
                     "non-orthogonal; use shooting or harmonic-balance");
  const SymmetricPencilSolver modes(0.5 * (linear_C_ + linear_C_.transpose()), M_);
  if (!modes.converged())
    refuse_averaging("the modes of the base system were not found: its mass matrix is singular");
  const VectorXd omega = modes.eigenvalues().unaryExpr([](double x) { return x > 0. ? std::sqrt(x) : 0.; });
  if (mode < 0)
  {
    double best = std::numeric_limits<double>::infinity();
    for (int j = 0; j < omega.size(); ++j)
      if (const double distance = nearness(j, omega, modes.eigenvectors()); distance < best)
      {
        best = distance;
        mode = j;
      }
    if (mode < 0)
      refuse_averaging(load_omega_ > 0. ? "the load excites no mode"
                                        : "there is no load, and no mode is self-excited about its equilibrium");
  }
  if (mode >= omega.size() || !(omega[mode] > 0.))
    refuse_averaging("there is no vibration of mode " + std::to_string(mode + 1));
  omega_0_        = omega[mode];
  phi_            = modes.eigenvectors().col(mode);
  d_              = W_.transpose() * phi_;
  linear_k_       = phi_.dot((linear_C_ - C_) * phi_);
  linear_damping_ = phi_.dot(B_ * phi_);
  start_moving();
  if (load_omega_ > 0.)
    for (const Excitation::Entry &entry : problem_.system->linear().excitation().harmonics()[0].load)
      load_ += phi_[entry.coordinate] * Complex(entry.cosine, -entry.sine);
}

/// Histories of a motion of the mode: what sticks at rest slides in it.
void SlowFlow::start_moving()
{
  LocalState state;
  state.resize(W_.cols());
  state.t = problem_.begin;
  state.u = W_.transpose() * rest_;
  state.v = d_;
  problem_.system->events().start(state);
}

/// q_0 that the mean forces keep at the amplitude a, from the last one; what rounding moves stays.
void SlowFlow::settle_mean(double a)
{
  const VectorXd  load = problem_.system->linear().excitation().constant();
  DescribedForces described(*problem_.system, d_);
  constexpr int   mean_iterations = 500; // a fixed point with contraction 0.94 still gets to rounding
  for (int k = 0; k < mean_iterations; ++k)
  {
    described.at(W_.transpose() * q_0_, a, omega_0_);
    const VectorXd step     = flexibility_ * (load + W_ * described.mean_forces() - C_ * q_0_);
    const VectorXd rounding = (flexibility_ * W_).cwiseAbs() * VectorXd::Constant(W_.cols(), described.largest_force());
    if (step.norm() <= rest_tolerance * (a * phi_.norm() + q_0_.norm() + rounding.norm()))
      return;
    q_0_ += step;
  }
  std::ostringstream message;
  message << "averaging: the mean of the motion is not found at the amplitude " << a << " of the mode";
  throw NoPeriodicMotion(message.str());
}

SlowFlow::Rates SlowFlow::at(double a)
{
  if (problem_.interrupted())
    throw SearchInterrupted();
  problem_.system->events().follow_history(false); // an integration in between may have changed it
  if (W_.cols() == 0)
    return {omega_0_, 0.5 * linear_damping_};
  settle_mean(a);
  DescribedForces          described(*problem_.system, d_);
  const DescribingFunction f = described.at(W_.transpose() * q_0_, a, omega_0_);
  return {omega_0_ + (f.stiffness - linear_k_) / (2. * omega_0_), 0.5 * (linear_damping_ + f.damping)};
}

/// Zero where a is steady.
double SlowFlow::balance(double a)
{
  const Rates rates = at(a);
  if (load_omega_ == 0.)
    return rates.delta;
  return a * std::hypot(rates.omega - load_omega_, rates.delta) - std::abs(load_) / (2. * omega_0_);
}

double SlowFlow::root(double below, double above)
{
  const bool rising = balance(above) > 0.;
  for (int k = 0; k < 200; ++k)
  {
    const double middle = 0.5 * (below + above);
    if (middle <= below || middle >= above)
      break;
    ((balance(middle) > 0.) == rising ? above : below) = middle;
  }
  return 0.5 * (below + above);
}

/// Two roots between points of the grid: where |balance| dips, its extremum has the other sign.
void SlowFlow::add_roots_of_dip(double from, double to, double side, std::vector<double> &found)
{
  double below = from, above = to;
  for (int k = 0; k < 60 && above - below > 1e-12 * above; ++k)
  {
    const double one = below + (above - below) / 3., two = above - (above - below) / 3.;
    if (side * balance(one) < side * balance(two))
      above = two;
    else
      below = one;
  }
  const double extremum = 0.5 * (below + above);
  if (side * balance(extremum) >= 0.)
    return;
  found.push_back(root(from, extremum));
  found.push_back(root(extremum, to));
}

std::vector<double> SlowFlow::amplitudes(double from, double to)
{
  if (!(to > from))
  {
    const double     push    = std::abs(load_) / (2. * omega_0_);
    const double     at_rest = 0.5 * std::abs(phi_.dot(linear_B_ * phi_)), base = 0.5 * std::abs(linear_damping_);
    constexpr double least_damping = 1e-4; // share of critical that is assumed at resonance, where a mode has less
    const double     linear = push / std::hypot(omega_0_ - load_omega_, std::max(at_rest, least_damping * omega_0_));
    // friction that damps small motions much damps large ones little
    const double     least  = std::max(std::min(at_rest, base), least_damping * omega_0_);
    constexpr double reach  = 1e3; // of amplitudes searched, below that of the linear system
    from                    = load_omega_ > 0. ? linear / reach : 1. / reach;
    constexpr double beyond = 10.; // times its amplitude in resonance: play and friction may enlarge it
    to                      = load_omega_ > 0. ? beyond * push / least : reach;
  }
  constexpr int       grid_points = 1500; // amplitudes, about 1 % apart over six decades
  const double        ratio       = std::pow(to / from, 1. / (grid_points - 1));
  std::vector<double> a(grid_points), value(grid_points), found;
  q_0_ = rest_;
  for (int i = 0; i < grid_points; ++i)
  {
    a[i]     = from * std::pow(ratio, i);
    value[i] = balance(a[i]);
  }
  for (int i = 1; i < grid_points; ++i)
  {
    if ((value[i - 1] > 0.) != (value[i] > 0.))
      found.push_back(root(a[i - 1], a[i]));
    const double side  = value[i] > 0. ? 1. : -1.;
    const bool   alike = i + 1 < grid_points && side * value[i - 1] > 0. && side * value[i + 1] > 0.;
    if (alike && side * value[i] < side * value[i - 1] && side * value[i] <= side * value[i + 1])
      add_roots_of_dip(a[i - 1], a[i + 1], side, found);
  }
  return found;
}

Complex SlowFlow::steady(double a)
{
  const Rates rates = at(a);
  if (load_omega_ == 0.)
    return a;
  const Complex z = Complex(0., 0.5) * load_ / (omega_0_ * Complex(-rates.delta, rates.omega - load_omega_));
  return a * z / std::abs(z);
}

/// Of z = (a + x + i y) exp(i psi):  x' = (g + a dg/da) x,  with g = -delta + i (omega - Omega).
Eigen::Vector2cd SlowFlow::eigenvalues(double a)
{
  const double  step = 1e-4 * a;
  const Rates   here = at(a), above = at(a + step), below = at(a - step);
  const Complex g(-here.delta, load_omega_ > 0. ? here.omega - load_omega_ : 0.);
  const Complex slope(-(above.delta - below.delta) / (2. * step), (above.omega - below.omega) / (2. * step));
  const double  trace       = 2. * g.real() + a * slope.real();
  const double  determinant = (g.real() + a * slope.real()) * g.real() + g.imag() * (g.imag() + a * slope.imag());
  const Complex root        = std::sqrt(Complex(0.25 * trace * trace - determinant));
  return {0.5 * trace + root, 0.5 * trace - root};
}

} // namespace gestell::coupling

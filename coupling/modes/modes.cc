#include "coupling/modes/modes.h"

#include "coupling/algebra/circulatory_modes.h"
#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/configuration/local_stiffness.h"
#include "coupling/modes/damped_modes.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{
/// @throws std::invalid_argument if a mass is so small, or its damper so large, that the state overflows.
GeneralEigenSolver solve_state(const Eigen::MatrixXd &state, const Eigen::VectorXd &omega)
{
  if (!state.allFinite()) // the solver would leave its arrays
  {
    std::ostringstream message;
    message << "modes: the highest frequency is " << omega.maxCoeff() / two_pi
            << " Hz, too high to compute with dampers; a mass is far too small for its spring or damper: check its "
               "unit, or remove it";
    throw std::invalid_argument(message.str());
  }
  return GeneralEigenSolver(state);
}

/// y'' + damping y' + stiffness y = 0 of the undamped modes: both diag(omega^2) and V^T B V, or by the dual basis.
struct InModes
{
  Eigen::MatrixXd stiffness, damping;
};

/// How well a solution s, in which a mode has the share `own`, matches the mode. A flutter and its counterpart have the
/// same shares; the one with the closer s matches better.
double fit(const Mode &mode, const std::complex<double> &s, double own)
{
  if (mode.growth == 0.)
    return own;
  const std::complex<double> undamped(mode.growth, two_pi * mode.frequency_hz);
  return own / (1. + std::norm(s - undamped) / std::norm(undamped));
}

/// Damped frequencies and ratios, from the quadratic eigenproblem in the undamped modes; each of them takes the
/// vibrating solution in which it is largest.  In the state (omega y, y') all entries are of the size of omega, so that
/// rounding of the highest mode does not reach the ratios of the low ones.
void add_damping(const DenseModes &modes, const InModes &in_modes, std::vector<Mode> &result)
{
  const int             p = static_cast<int>(modes.omega.size());
  Eigen::MatrixXd       state(2 * p, 2 * p);
  const Eigen::VectorXd weight = (modes.omega.array() > 0.).select(modes.omega, 1.);
  state << Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd(weight.asDiagonal()),
      -in_modes.stiffness * weight.cwiseInverse().asDiagonal(), -in_modes.damping;
  const auto             solver  = solve_state(state, modes.omega);
  const Eigen::VectorXcd s       = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  std::vector<bool>      taken(2 * p, false);
  for (std::size_t j = 0; j < result.size(); ++j)
  {
    int    best  = -1;
    double share = 0., best_fit = 0.;
    for (int k = 0; k < 2 * p && result[j].frequency_hz > 0.; ++k)
    {
      if (taken[k] || s[k].imag() <= 1e-9 * std::abs(s[k]))
        continue;
      const auto   y   = vectors.col(k).tail(p); // y' = s y
      const double own = std::norm(y[static_cast<Eigen::Index>(j)]) / y.squaredNorm();
      if (const double own_fit = fit(result[j], s[k], own); own_fit > best_fit)
      {
        best_fit = own_fit;
        share    = own;
        best     = k;
      }
    }
    result[j].damping_ratio = std::numeric_limits<double>::quiet_NaN();
    if (best < 0 || share < 0.3)
      continue;
    taken[best]                   = true;
    result[j].damped_frequency_hz = s[best].imag() / two_pi;
    const double ratio            = -s[best].real() / std::abs(s[best]);
    result[j].damping_ratio       = std::abs(ratio) > rounding_of_ratio ? ratio : 0.;
  }
}

/// Result of add_damping() without dampers.
void leave_undamped(std::vector<Mode> &result)
{
  for (Mode &mode : result)
  {
    const bool vibrates      = mode.frequency_hz > 0.;
    mode.damped_frequency_hz = vibrates ? mode.frequency_hz : 0.;
    mode.damping_ratio       = vibrates ? 0. : std::numeric_limits<double>::quiet_NaN();
    if (vibrates && mode.growth != 0.)
      mode.damping_ratio = -mode.growth / std::hypot(mode.growth, two_pi * mode.frequency_hz);
  }
}

/// Matrices [n x n] and loads M R [n x 3] of a unit acceleration; the effective mass of a mode v is (v . load)^2.
struct ModalProblem
{
  Eigen::MatrixXd    M, B, C, loads;
  bool               damped = true;
  std::optional<int> n_rigid{};           ///< see dense_modes()
  bool               circulatory = false; ///< C is not symmetric
};

std::vector<Mode> modes_of(const ModalProblem &problem, int n_modes)
{
  const auto &[M, B, C, loads, damped, n_rigid, circulatory] = problem;
  if (M.rows() == 0) // everything is fixed
    return {};
  CirculatoryModes found;
  if (circulatory)
    found = circulatory_modes(C, M);
  else
    found.modes = n_rigid ? dense_modes(C, M, cancelled_by_reduction, n_rigid) : dense_modes(C, M);
  const DenseModes &modes = found.modes;
  std::vector<Mode> result(std::min<Eigen::Index>(n_modes, modes.omega.size()));
  for (std::size_t j = 0; j < result.size(); ++j)
  {
    const Eigen::VectorXd v = modes.V.col(static_cast<Eigen::Index>(j));
    result[j].frequency_hz  = modes.omega[static_cast<Eigen::Index>(j)] / two_pi;
    result[j].growth        = modes.growth[static_cast<Eigen::Index>(j)];
    result[j].shape         = v;
    for (int d = 0; d < 3; ++d)
      result[j].effective_mass[d] = std::pow(v.dot(loads.col(d)), 2);
  }
  if (!damped || result.empty())
    return result;
  if (B.isZero(0.))
    leave_undamped(result);
  else if (circulatory)
    add_damping(modes, {found.left.transpose() * C * modes.V, found.left.transpose() * B * modes.V}, result);
  else
    add_damping(
        modes, {Eigen::MatrixXd(modes.omega.array().square().matrix().asDiagonal()), modes.V.transpose() * B * modes.V},
        result);
  return result;
}

} // namespace

Eigen::VectorXd multipliers_at_rest(const Machine &machine, const Eigen::VectorXd &q, LocalState &local)
{
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  Eigen::VectorXd       a    = zero;
  IntegrationWork       work;
  ConsistentStart(machine, "modes").solve(q, zero, a, local, work);
  return local.lambda;
}

double refined_hz(const ReducedFrame &frame, Eigen::Index j)
{
  const bool reduced = frame.modal && frame.n_full > frame.M.rows(), known = j < frame.frequency_error.size();
  return reduced && known ? frame.frequencies_hz[j] / (1. + frame.frequency_error[j])
                          : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Mode> frame_modes(const Machine &machine, int n_modes)
{
  const ReducedFrame *frame = machine.model().reduced_frame();
  if (!frame)
    return {};
  std::vector<Mode> modes =
      modes_of({frame->M, frame->B, frame->C, frame->translations_load, true, frame->n_rigid()}, n_modes);
  for (std::size_t j = 0; j < modes.size(); ++j)
    modes[j].refined_hz = refined_hz(*frame, Eigen::Index(j));
  for (std::size_t j = 0; j < std::min(modes.size(), frame->facts.free_motions.size()); ++j)
  {
    modes[j].frequency_hz = modes[j].damped_frequency_hz = modes[j].growth = 0.; // only rounding remains
    modes[j].damping_ratio                                                 = std::numeric_limits<double>::quiet_NaN();
  }
  return modes;
}

namespace
{

/// M, B, K [p x p] of the free motions Z [n x p], with engaged dampers and stiffness.
struct Linear
{
  Eigen::MatrixXd M, B, K, Z;
  bool            circulatory = false; ///< K is not symmetric
  LocalState      local{};             ///< the motion at rest, with multipliers
};

/// A motion whose stiffness is what rounding leaves of the forces that balance in it has none: a linkage whose weights
/// balance.
void settle_free_motions(const Eigen::VectorXd &terms, std::vector<Mode> &modes)
{
  for (std::size_t j = 0; j < modes.size(); ++j)
  {
    Mode        &mode     = modes[j];
    const double rounding = std::sqrt(cancelled_by_rounding * terms[Eigen::Index(j)]);
    if (std::max(two_pi * mode.frequency_hz, std::abs(mode.growth)) > rounding)
      continue;
    mode.frequency_hz = mode.damped_frequency_hz = mode.growth = 0.;
    mode.damping_ratio                                         = std::numeric_limits<double>::quiet_NaN();
  }
}

/// Refuses matrices in which sums of masses or forces overflow.
void require_finite(const Machine &machine, const Linear &linear)
{
  const auto check = [&](const Eigen::MatrixXd &A, const char *what, const char *reason)
  {
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      if (!A.row(i).allFinite())
        throw std::invalid_argument("modes: the " + std::string(what) + " of coordinate " +
                                    machine.coordinate_name(int(i)) + " is not finite; " + reason +
                                    " too large to compute with: check their units");
  };
  check(linear.M, "mass", "masses or inertias are");
  check(linear.B, "damping", "dampers are");
  check(linear.K, "stiffness", "springs are, or the forces (such as weights) that rotate with its motion are,");
}

Linear linearised(const Machine &machine, const Eigen::VectorXd &q, const Linearisation &linearisation)
{
  if (machine.model().full_frame())
    throw std::invalid_argument("modes: the machine has " + std::to_string(machine.size()) +
                                " DOFs; reduce the frame (reduction.method = \"craig-bampton\") for its modes");
  Linear linear;
  engaged_matrices(machine, q, linearisation.open, linear.K, linear.B);
  linear.M = dense_mass(machine);
  linear.K += dense_stiffness(machine);
  linear.B += dense_damping(machine);

  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  LocalState            local;
  local.resize(machine);
  machine.gather(0., q, zero, zero, local);
  const bool jointed = machine.joints().n_rows() > 0;
  if (linearisation.geometric == GeometricStiffness::included)
  {
    if (jointed)
      local.lambda = linearisation.multipliers ? *linearisation.multipliers : multipliers_at_rest(machine, q, local);
    linear.K += geometric_stiffness(machine, local, linearisation.acting);
    linear.circulatory = is_circulatory(machine, local, acting_measures(machine, local.u, linearisation.acting));
  }
  require_finite(machine, linear);
  linear.Z     = free_motions(machine, local, linearisation.fixed);
  linear.local = std::move(local);
  return linear;
}

} // namespace

std::vector<Mode> linearised_modes(const Machine &machine, const Eigen::VectorXd &q, const Linearisation &linearisation,
                                   int n_modes)
{
  const auto [M, B, K, Z, circulatory, local] = linearised(machine, q, linearisation);
  std::vector<Mode> modes                     = modes_of({Z.transpose() * M * Z,
                                                          Z.transpose() * B * Z,
                                                          Z.transpose() * K * Z,
                                                          Z.transpose() * machine.translation_loads(),
                                                          linearisation.damping,
                                                          {},
                                                          circulatory},
                                                         n_modes);
  for (Mode &mode : modes)
    mode.shape = Z * mode.shape;
  Eigen::MatrixXd V(machine.size(), Eigen::Index(modes.size()));
  for (std::size_t j = 0; j < modes.size(); ++j)
    V.col(Eigen::Index(j)) = modes[j].shape;
  const bool            geometric = linearisation.geometric == GeometricStiffness::included;
  const Eigen::MatrixXd size      = V.cwiseAbs();
  Eigen::VectorXd       terms     = size.cwiseProduct(dense_stiffness(machine).cwiseAbs() * size).colwise().sum();
  terms += stiffness_terms(machine, q, linearisation.open, geometric ? &local : nullptr, V);
  settle_free_motions(terms, modes);
  return modes;
}

namespace
{

/// Contributions of drives and controllers to the structure.
struct Drives
{
  bool             any = false;
  std::vector<int> lags; ///< virtual coordinates of active elements; others only decay with their own constants
};

/// Whether an element sticks in a motion that starts here.
bool sticks(const mechanism::Element &element, const mechanism::LocalMotion &motion)
{
  double rate;
  return element.branches() && element.branches()->holds(started(element, motion).data(), rate);
}

/// Adds -dp/du and -dp/dv [n x n] of the drives, which are not structure, at a motion.
Drives add_drives(const Machine &machine, const LocalState &local, Eigen::MatrixXd &K, Eigen::MatrixXd &B)
{
  const Eigen::VectorXd structure = acting_measures(machine, local.u, Acting::structure);
  const auto           &W         = machine.forces().directions();
  const auto           &lags      = machine.linear().virtual_coordinates(); // ascending
  Drives                found;
  int                   first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const mechanism::Element &element = *placement.element;
    const int                 k       = element.n_measures();
    mechanism::LocalMotion    motion{local.t, local.u.data() + first, local.v.data() + first, local.a.data() + first};
    const bool drives = structure[first] == 0. && placement.joint < 0 && element.work() == mechanism::Work::input;
    if (drives && !sticks(element, motion)) // a sticking drive is rigid
    {
      Eigen::VectorXd p(k);
      Eigen::MatrixXd du(k, k), dv(k, k);
      element.force_law()->derivatives(motion, started(element, motion).data(), p.data(), du.data(), dv.data());
      const Eigen::MatrixXd own = W.middleCols(first, k);
      K -= own * du * own.transpose();
      B -= own * dv * own.transpose();
      found.any = found.any || !du.isZero(0.) || !dv.isZero(0.);
    }
    const bool acts = drives || !structure.segment(first, k).isZero(0.);
    for (const Measure &u : placement.measures)
      for (const auto &term : u)
        if (acts && std::binary_search(lags.begin(), lags.end(), term.first))
          found.lags.push_back(term.first);
    first += k;
  }
  return found;
}

/// Whether an element drives the machine or has a virtual coordinate; only these affect its modes.
bool may_have_drives(const Machine &machine)
{
  const auto &elements = machine.model().elements();
  return !machine.linear().virtual_coordinates().empty() ||
         std::any_of(elements.begin(), elements.end(),
                     [](const ElementPlacement &placement)
                     { return placement.element->work() == mechanism::Work::input; });
}

/// [rad/s] weight of motions without frequency in the state: the lowest one, of a machine without any the rate at which
/// its dampers slow it down.
double weight_at_rest(const Linear &linear, const DenseModes &modes, const Eigen::MatrixXd &V)
{
  double lowest = std::numeric_limits<double>::infinity();
  for (const double omega : modes.omega)
    if (omega > 0.)
      lowest = std::min(lowest, omega);
  const double rate = (V.transpose() * linear.B * V).norm();
  return std::isfinite(lowest) ? lowest : rate > 0. ? rate : 1.;
}

/// d/dt (Omega y, y', x) of motions V y and virtual coordinates x.
Eigen::MatrixXd state_matrix(const Linear &linear, const Eigen::VectorXd &omega, const Eigen::MatrixXd &V,
                             const Eigen::MatrixXd &L)
{
  const Eigen::Index    p = V.cols(), m = L.cols();
  const Eigen::MatrixXd K_y = V.transpose() * linear.K * V * omega.cwiseInverse().asDiagonal();
  Eigen::MatrixXd       A   = Eigen::MatrixXd::Zero(2 * p + m, 2 * p + m);
  A.block(0, p, p, p)       = omega.asDiagonal();
  A.block(p, 0, p, p)       = -K_y;
  A.block(p, p, p, p)       = -V.transpose() * linear.B * V;
  if (m == 0)
    return A;
  A.block(p, 2 * p, p, m) = -V.transpose() * linear.K * L;
  Eigen::MatrixXd x_rate(m, 2 * p + m); // T x' = ...
  x_rate << -L.transpose() * linear.K * V * omega.cwiseInverse().asDiagonal(), -L.transpose() * linear.B * V,
      -L.transpose() * linear.K * L;
  const Eigen::VectorXd T = (L.transpose() * linear.B * L).diagonal();
  A.bottomRows(m)         = T.cwiseInverse().asDiagonal() * x_rate;
  return A;
}

/// The coordinate that a solution (y', x) moves most, by kinetic energy, or else the largest virtual coordinate.
std::string moved_most(const Machine &machine, const std::vector<int> &lags, const Eigen::MatrixXd &M,
                       const Eigen::MatrixXd &V, const Eigen::VectorXcd &y_rate, const Eigen::VectorXcd &x)
{
  Eigen::Index most = 0;
  if (y_rate.norm() <= 1e-9 * x.norm())
  {
    x.cwiseAbs().maxCoeff(&most);
    return machine.coordinate_name(lags[most]);
  }
  const Eigen::VectorXcd v = V * y_rate;
  v.conjugate().cwiseProduct(M * v).real().maxCoeff(&most);
  return machine.coordinate_name(int(most));
}

} // namespace

double Pole::frequency_hz() const
{
  return s.imag() / two_pi;
}

double Pole::damping_ratio() const
{
  const double ratio = -s.real() / std::abs(s);
  return std::abs(ratio) > rounding_of_ratio ? ratio : 0.;
}

std::vector<Pole> operating_poles(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v, double t,
                                  const Linearisation &linearisation)
{
  std::vector<Pole> poles;
  if (!may_have_drives(machine))
    return poles;
  Linear     linear = linearised(machine, q, linearisation);
  LocalState local;
  local.resize(machine);
  machine.gather(t, q, v, Eigen::VectorXd::Zero(machine.size()), local);
  const auto     &Z = linear.Z;
  Eigen::MatrixXd K = Z.transpose() * linear.K * Z; // of the structure only
  if (linear.circulatory)
    K = 0.5 * (K + K.transpose()).eval(); // a basis; what follows the motion is in the state
  const DenseModes modes = dense_modes(K, Z.transpose() * linear.M * Z);
  const auto [any, lags] = add_drives(machine, local, linear.K, linear.B);
  const auto m           = Eigen::Index(lags.size());
  if (!any && m == 0)
    return poles;
  const Eigen::MatrixXd V = Z * modes.V;
  Eigen::MatrixXd       L = Eigen::MatrixXd::Zero(machine.size(), m);
  for (Eigen::Index i = 0; i < m; ++i)
    L(lags[i], i) = 1.;
  const Eigen::Index p = V.cols();
  if (p + m == 0) // nothing has mass
    return poles;
  const double           slowest = weight_at_rest(linear, modes, V);
  const auto             solver  = solve_state(state_matrix(linear, modes.omega.cwiseMax(slowest), V, L), modes.omega);
  const Eigen::VectorXcd s       = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const double           largest = s.size() > 0 ? s.cwiseAbs().maxCoeff() : 0.;
  // A motion at rest is a double root; rounding splits it by the root of the error in the matrix.
  const double rest = 10. * std::sqrt(std::numeric_limits<double>::epsilon() * std::max(largest, slowest) * slowest);
  for (Eigen::Index k = 0; k < s.size(); ++k)
    if (std::abs(s[k]) > rest && s[k].imag() >= 0.)
      poles.push_back(
          {s[k], moved_most(machine, lags, linear.M, V, vectors.col(k).segment(p, p), vectors.col(k).tail(m))});
  std::sort(poles.begin(), poles.end(), [](const Pole &a, const Pole &b) { return std::abs(a.s) < std::abs(b.s); });
  return poles;
}

} // namespace gestell::coupling

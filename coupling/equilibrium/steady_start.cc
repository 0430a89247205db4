#include "coupling/equilibrium/steady_start.h"

#include "coupling/equilibrium/seated_plays.h"
#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/equilibrium/steady_motion.h"
#include "coupling/integration/system/dense_solvers.h"

#include "coupling/machine/configuration/assembly.h"
#include "coupling/machine/configuration/coordinate_sizes.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/configuration/loop_closure.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Positions that angles determine, and the state that follows by kinematics.
struct Kinematics
{
  std::vector<bool> given; ///< coordinates whose value is not unknown
  int               driver = -1;
  InitialState      state;
  Eigen::VectorXd   acceleration;
};

void check_driver(const SteadyStart &start, const Kinematics &kinematics)
{
  const long n_given = std::count(kinematics.given.begin(), kinematics.given.end(), true);
  if (n_given != (kinematics.driver >= 0 ? 1 : 0))
    throw std::invalid_argument("start: " + std::to_string(n_given) + " angles are given and " +
                                (start.driver.empty() ? "no driver" : "one driver") +
                                "; each given angle replaces the balance of one driver, so give one of each, or none");
}

Kinematics kinematics_of(const Machine &machine, const SteadyStart &start)
{
  const int  n = machine.size();
  Kinematics result{std::vector<bool>(n, false), -1, {start.t, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)}, {}};
  auto      &q = result.state.q, &v = result.state.v;
  for (const Body &body : machine.model().bodies()) // other rotors are aligned with the first one given
    if (body.kind == BodyKind::rotor && !start.angles.empty())
      q[body.coordinate] = start.angles.front().second;
  for (const auto &[name, angle] : start.angles)
  {
    result.given[machine.model().body(name).coordinate] = true;
    q[machine.model().body(name).coordinate]            = angle;
  }
  for (const auto &[name, speed] : start.speeds)
    v[machine.model().body(name).coordinate] = speed;
  if (!start.driver.empty())
    result.driver = machine.model().body(start.driver).coordinate;
  check_driver(start, result);

  close_chains(machine, q);
  const Closures chain = closures(machine, q, v);
  v += slider_solution(machine, chain.J, -chain.J * v);
  result.acceleration = slider_solution(machine, chain.J, -closures(machine, q, v).curvature);
  return result;
}

/// Equilibrium in the coordinates that are not given, with the balance of all coordinates except the driver.
class DrivenEquilibrium
{
public:
  DrivenEquilibrium(Machine &machine, const Kinematics &kinematics)
      : machine_(machine), t_(kinematics.state.t), v_(kinematics.state.v), acceleration_(kinematics.acceleration),
        stiffness_(dense_stiffness(machine)), p_(Eigen::VectorXd::Zero(machine.forces().directions().cols()))
  {
    const int n = machine.size();
    for (int i = 0; i < n; ++i)
    {
      if (!kinematics.given[i])
        unknown_.push_back(i);
      if (i != kinematics.driver)
        equations_.push_back(i);
    }
    Eigen::VectorXd product(n);
    constant_ = machine.linear().excitation().constant();
    machine.linear().mass_times(acceleration_, product);
    constant_ -= product;
    machine.linear().damping_times(v_, product);
    constant_ -= product;
  }

  /// Unbalanced forces [equations] at q.
  Eigen::VectorXd residual(const Eigen::VectorXd &q)
  {
    machine_.gather(t_, q, v_, acceleration_, local_);
    machine_.events().start(local_);
    machine_.forces().force(local_, p_);
    const Eigen::VectorXd local = machine_.forces().directions() * p_, elastic = stiffness_ * q;
    size_of_forces_ = constant_.cwiseAbs().maxCoeff() + local.cwiseAbs().maxCoeff() + elastic.cwiseAbs().maxCoeff();
    return (constant_ + local - elastic)(equations_);
  }

  /// Largest force in the last evaluation of residual().
  double size_of_forces() const { return size_of_forces_; }

  /// One Newton step for the residual at q; if the matrix is singular, the shortest step with the least residual.
  Eigen::VectorXd step(const Eigen::VectorXd &q, const Eigen::VectorXd &balance)
  {
    Eigen::MatrixXd dp(p_.size(), p_.size());
    machine_.forces().tangent(local_, 1., 0., 0., p_, dp);
    const auto &W = machine_.forces().directions();
    decompose(stiffness_ - Eigen::MatrixXd(W * dp * W.transpose()));
    if (solver_.rank() < static_cast<Eigen::Index>(unknown_.size()))
    {
      // Open play has no stiffness; the stiffness of closed elements gives the direction.
      Eigen::MatrixXd closed, damping;
      engaged_matrices(machine_, q, {}, closed, damping);
      decompose(stiffness_ + closed);
    }
    const Eigen::VectorXd scaled   = row_scale_.asDiagonal() * balance;
    const Eigen::VectorXd solution = solver_.solve(scaled);
    held_                          = (matrix_ * solution - scaled).norm() <= 1e-6 * scaled.norm();
    Eigen::VectorXd change         = Eigen::VectorXd::Zero(q.size());
    change(unknown_)               = scale_.asDiagonal() * solution;
    return change;
  }

  /// Whether the last step balances its forces to first order: not if one acts along a free motion.
  bool held() const { return held_; }

  /// The first coordinate, with those of the frame before the bodies it carries, that moves at least half as much as
  /// the largest in the unconstrained motion of the last matrix; -1 if there is none.
  int free_coordinate() const
  {
    const Eigen::MatrixXd free = solver_.null_space();
    if (free.cols() == 0)
      return -1;
    const Eigen::VectorXd motion = scale_.asDiagonal() * free.rightCols<1>();
    const double          half   = 0.5 * motion.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < unknown_.size(); ++i)
      if (std::abs(motion[static_cast<Eigen::Index>(i)]) >= half)
        return unknown_[i];
    return unknown_.front();
  }

private:
  /// Decomposes the tangent, scaled to unit diagonal to make metres and radians comparable.
  void decompose(const Eigen::MatrixXd &tangent)
  {
    const auto inverse_root = [&](int i) { return 1. / std::sqrt(std::max(std::abs(tangent(i, i)), 1e-300)); };
    scale_.resize(static_cast<Eigen::Index>(unknown_.size()));
    row_scale_.resize(static_cast<Eigen::Index>(equations_.size()));
    for (std::size_t j = 0; j < unknown_.size(); ++j)
      scale_[static_cast<Eigen::Index>(j)] = tangent(unknown_[j], unknown_[j]) == 0. ? 1. : inverse_root(unknown_[j]);
    for (std::size_t i = 0; i < equations_.size(); ++i)
      row_scale_[static_cast<Eigen::Index>(i)] =
          tangent(equations_[i], equations_[i]) == 0. ? 1. : inverse_root(equations_[i]);
    const Eigen::MatrixXd part = tangent(equations_, unknown_);
    matrix_                    = row_scale_.asDiagonal() * part * scale_.asDiagonal();
    // Stiffness of a motion relative to that of its coordinates, if unconstrained: reduction leaves 1e-10.
    constexpr double least_singular = 1e-9;
    solver_                         = LeastSquaresSolver(matrix_, least_singular);
  }

  Machine         &machine_;
  double           t_;
  Eigen::VectorXd  v_, acceleration_, constant_;
  Eigen::MatrixXd  stiffness_, matrix_;
  std::vector<int> unknown_, equations_;
  LocalState       local_;
  Eigen::VectorXd  p_, scale_, row_scale_;
  double           size_of_forces_ = 0.;
  bool             held_           = true;

  LeastSquaresSolver solver_;
};

[[noreturn]] void refuse(const Machine &machine, const DrivenEquilibrium &equilibrium, double unbalanced)
{
  std::ostringstream message;
  message << "start: no equilibrium; residual force " << unbalanced << " N (or N m)";
  const int free = equilibrium.free_coordinate();
  if (free < 0)
    throw ConvergenceFailure(message.str() +
                             " after the Newton iterations; start from another angle or give the state");
  throw std::invalid_argument(
      message.str() + ": unconstrained DOF " + machine.coordinate_name(free) +
      "; add a support to the frame or an element to the body, or give an angle and its driver");
}

} // namespace

InitialState steady_start(Machine &machine, const SteadyStart &start)
{
  if (has_joints(machine))
    throw std::invalid_argument("angles, speeds and driver do not work with joints; for a steady initial state give "
                                "position and speed of the driving bodies as q and v, the joints determine the rest");
  const Kinematics kinematics = kinematics_of(machine, start);
  InitialState     state      = kinematics.state;
  if (std::count(kinematics.given.begin(), kinematics.given.end(), false) == 0)
    return state;
  DrivenEquilibrium equilibrium(machine, kinematics);

  Eigen::VectorXd balance = equilibrium.residual(state.q);
  for (int iteration = 0; iteration < 200; ++iteration)
  {
    const Eigen::VectorXd change = equilibrium.step(state.q, balance);
    if (!equilibrium.held())
      break;
    // While clearances are open the residual is constant until contact: continue in doubled steps as long as it does
    // not grow.
    double          stretch = 1.;
    Eigen::VectorXd next    = equilibrium.residual(state.q + change);
    while (stretch < 1e12 && next.norm() > 0.5 * balance.norm() && change.norm() > 0.)
    {
      const Eigen::VectorXd further = equilibrium.residual(state.q + 2. * stretch * change);
      if (!(further.norm() <= next.norm()))
        break;
      stretch *= 2.;
      next = further;
    }
    const double before = balance.norm();
    state.q += stretch * change;
    balance = equilibrium.residual(state.q);
    if (!balance.allFinite())
      break;
    const double unbalanced = balance.cwiseAbs().maxCoeff();
    // Rounding prevents a further decrease.
    if (unbalanced <= 1e-10 * equilibrium.size_of_forces() && (balance.norm() >= 0.3 * before || unbalanced == 0.))
      return state;
  }
  refuse(machine, equilibrium, balance.cwiseAbs().maxCoeff());
}

namespace
{

/// The same known start with the coordinates of given speed fixed in position `at`, and no other condition.
KnownStart held_at(const Machine &machine, const KnownStart &known, const InitialState &at)
{
  KnownStart held = known;
  held.state      = at;
  held.state.v    = known.state.v;
  held.q_given    = known.v_given;
  held.measures.clear();
  for (const auto &rate : known.rates)
    held.measures.emplace_back(rate.first, machine.model().measure(rate.first).evaluate(at.q, at.v).s);
  return held;
}

} // namespace

InitialState steady_start(Machine &machine, const KnownStart &known)
{
  const bool given =
      std::any_of(known.v_given.begin() + machine.model().n_frame(), known.v_given.end(), [](char g) { return g; });
  if (!given && known.rates.empty() && known.spins.empty())
    throw std::invalid_argument("a steady initial state needs the speed of a drive, as in v = { crank = \"30 rpm\" }");
  InitialState     state   = assemble(machine, known, BehindPlay::followed);
  const KnownStart held    = held_at(machine, known, state);
  const auto       largest = [sizes = coordinate_sizes(machine)](const Eigen::VectorXd &x)
  { return x.cwiseQuotient(sizes).cwiseAbs().maxCoeff(); };
  constexpr int most_rounds = 50; // inertia moves deflections less in each round, if at all
  for (int round = 0; round < most_rounds; ++round)
  {
    const SteadyMotion motion     = steady_motion(machine, held, state.q);
    InitialState       from       = state;
    from.q                        = seated_plays(machine, held, motion, state);
    HeldEquilibrium next          = held_equilibrium(machine, held, &motion, &from);
    const double    change        = largest(next.q - state.q);
    state.q                       = next.q;
    state.v                       = motion.v;
    constexpr double least_change = 1e-12; // change of q in a round, against its size
    if (change <= least_change * std::max(1e-3, largest(state.q)))
      return state;
  }
  throw std::invalid_argument("no steady motion was found from the initial position: the deflections by inertia do not "
                              "converge; give a lower speed, a better position, or start with rule = \"given\"");
}

} // namespace gestell::coupling

#include "coupling/periodic/settling.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/propagation/modal_blocks.h"
#include "coupling/integration/system/acceleration_forces.h"
#include "coupling/integration/system/second_order_system.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/**
 * A second-order system with more damping in its linear base: B + beta C.  A mode of omega [rad/s] gets beta omega/2
 * of critical more; motions without stiffness, such as that of a drive, are not braked.
 */
class RaisedDamping final : public SecondOrderSystem
{
public:
  RaisedDamping(SecondOrderSystem &system, double beta);
  ~RaisedDamping() override;

  const LinearSystem  &linear() const override;
  const LocalForces   &forces() const override { return system_.forces(); }
  const IdealJoints   &joints() const override { return system_.joints(); }
  const EventSystem   &events() const override { return static_cast<const SecondOrderSystem &>(system_).events(); }
  EventSystem         &events() override { return system_.events(); }
  const EnergyAccount &energy() const override { return system_.energy(); }

private:
  class Base;

  SecondOrderSystem    &system_;
  std::unique_ptr<Base> base_;
};

class RaisedDamping::Base final : public LinearSystem
{
public:
  Base(const LinearSystem &base, double beta) : base_(base), beta_(beta), product_(base.size()) {}

  int  size() const override { return base_.size(); }
  void mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override { base_.mass_times(x, y); }
  void damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override
  {
    base_.damping_times(x, y);
    base_.stiffness_times(x, product_);
    y += beta_ * product_;
  }
  void stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override { base_.stiffness_times(x, y); }
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override
  {
    return base_.factorise(w_M, w_B, w_C + beta_ * w_B);
  }
  std::vector<SpectrumLine> spectrum() const override
  {
    std::vector<SpectrumLine> lines = base_.spectrum();
    for (SpectrumLine &line : lines)
      line.zeta += 0.5 * beta_ * line.omega;
    return lines;
  }
  const Excitation &excitation() const override { return base_.excitation(); }
  bool              dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const override
  {
    const bool dense = base_.dense_matrices(M, B, C);
    if (dense)
      B += beta_ * C;
    return dense;
  }
  bool sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                       Eigen::SparseMatrix<double> &C) const override
  {
    const bool sparse = base_.sparse_matrices(M, B, C);
    if (sparse)
      B += beta_ * C;
    return sparse;
  }
  const std::vector<int> &virtual_coordinates() const override { return base_.virtual_coordinates(); }
  std::string             coordinate_name(int i) const override { return base_.coordinate_name(i); }

private:
  const LinearSystem     &base_;
  double                  beta_;
  mutable Eigen::VectorXd product_;
};

RaisedDamping::RaisedDamping(SecondOrderSystem &system, double beta)
    : system_(system), base_(std::make_unique<Base>(system.linear(), beta))
{
}

RaisedDamping::~RaisedDamping() = default;

const LinearSystem &RaisedDamping::linear() const
{
  return *base_;
}
using Eigen::VectorXd;

constexpr int usual_lead_in = 10; ///< periods: a motion of 5 % damping has lost 96 % of its start
/// closing error at which the lead-in ends: Newton's method starts within its reach
constexpr double near_enough = 0.01;

/// One period; the state behind it, whole turns taken off, becomes the next start.
double one_period(PeriodFlow &flow, const PeriodicProblem &problem, PeriodicGuess &at)
{
  const double         expected    = at.period > 0. ? at.period : problem.period;
  constexpr double     turn_margin = 3.; // of the period expected, within which an angle comes round
  const PeriodPassage &passage     = problem.period_is_unknown() ? flow.pass_turn(at.q, at.v, turn_margin * expected)
                                                                 : flow.pass(at.q, at.v, problem.period, false);
  const VectorXd       q           = passage.q - problem.turn;
  const double         error = closing_error(q - at.q, passage.v - at.v, 2. * M_PI / passage.period, passage.fastest);
  at                         = {q, passage.v, passage.period};
  return error;
}

struct Settled
{
  PeriodicGuess at;
  int           periods = 0;
  double        error = 1., contraction = 1.;
  PeriodicWork  work;
};

/// From `at` until the motion closes to `tolerance`, or `most` periods.
Settled settle(const PeriodicProblem &problem, const PeriodicGuess &from, const PeriodicOptions &options,
               double tolerance, int most)
{
  PeriodFlow flow(problem, options.integration);
  Settled    settled;
  settled.at = from;
  while (settled.periods < most && settled.error > tolerance && !problem.interrupted())
  {
    const double before = settled.error;
    settled.error       = one_period(flow, problem, settled.at);
    settled.work.add({0, 1, flow.passage().work});
    ++settled.periods;
    settled.contraction = settled.error / before;
  }
  return settled;
}

/// With damping raised at first, and set back.
Settled settle_damped(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicOptions &options)
{
  constexpr double levels[] = {1., 0.3, 0.1}; // of added damping: each starts where the stronger one led
  Settled          all;
  all.at       = guess;
  double omega = 0.;
  for (const SpectrumLine &line : problem.system->linear().spectrum())
    if (line.omega > 0. && (omega == 0. || line.omega < omega))
      omega = line.omega;
  for (const double level : levels)
  {
    const double extra = options.value("damping", 0.);
    if (!(extra > 0.) || omega == 0.)
      break;
    RaisedDamping   damped(*problem.system, 2. * level * extra / omega);
    PeriodicProblem harder = problem;
    harder.system          = &damped;
    const Settled part     = settle(harder, all.at, options, near_enough, options.periods);
    all.at                 = part.at;
    all.periods += part.periods;
    all.work.add(part.work);
  }
  const Settled last = settle(problem, all.at, options, options.tolerance, options.periods);
  all.at             = last.at;
  all.periods += last.periods;
  all.work.add(last.work);
  all.error       = last.error;
  all.contraction = last.contraction;
  return all;
}

/// The passage that the settled motion is, with multipliers where the integrator tells them.
PeriodicSolution reported(const PeriodicProblem &problem, const Settled &settled, const PeriodicOptions &options)
{
  PeriodFlow           flow(problem, options.integration);
  const double         period  = problem.period_is_unknown() ? settled.at.period : problem.period;
  const PeriodPassage &passage = flow.pass(settled.at.q, settled.at.v, period, flow.has_tangents());
  PeriodicSolution     solution;
  solution.begin       = problem.begin;
  solution.period      = period;
  solution.ratio       = problem.ratio;
  solution.q           = settled.at.q;
  solution.v           = settled.at.v;
  solution.turn        = turned(problem, passage);
  solution.residual    = closing_error(passage.q - passage.q_begin - problem.turn, passage.v - passage.v_begin,
                                       2. * M_PI / period, passage.fastest);
  solution.events      = passage.events;
  solution.method      = "settling";
  solution.integration = options.integration;
  solution.work        = settled.work;
  solution.work.add({0, 1, passage.work});
  solution.trivial_multiplier = problem.period_is_unknown() && flow.has_tangents();
  if (flow.has_tangents())
    solution.multipliers = multipliers_of(passage.monodromy, problem);
  else
  {
    solution.multipliers = Eigen::VectorXcd::Constant(1, std::min(settled.contraction, 1. - 1e-9));
    solution.notes.push_back("the multiplier is estimated from the convergence of the last periods; --method shooting "
                             "computes all of them");
  }
  solution.notes.push_back("settled in " + std::to_string(settled.periods) + " periods");
  return solution;
}

[[noreturn]] void not_settled(const Settled &settled, const PeriodicProblem &problem)
{
  std::ostringstream text;
  text << "the motion does not repeat after " << settled.periods << " periods of " << problem.period
       << " s: it deviates from the initial state by " << settled.error << " of its speed";
  if (settled.contraction > 0.9 && settled.contraction < 1.)
    text << " and converges by " << 100. * (1. - settled.contraction)
         << " % per period; integrate more periods, or use --method shooting";
  else
    text << " and does not converge: it may repeat after several periods (--ratio 2, 3 ...), or not at all";
  throw NoPeriodicMotion(text.str());
}

class Settling final : public PeriodicMethod
{
public:
  std::string name() const override { return "settling"; }
  std::string meaning() const override
  {
    return "Integrates period by period until (5.5.4/1) is satisfied, optionally with more damping at first; a second "
           "initial state searches for another solution.";
  }
  std::string                 refuses(const PeriodicProblem &) const override { return ""; }
  bool                        integrates() const override { return true; }
  std::vector<PeriodicOption> options() const override
  {
    return {{"damping", "of settling: damping ratio added to the lowest mode at first", 0., 1e6, false}};
  }

  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override
  {
    const Settled first = settle_damped(problem, guess, options);
    if (!(first.error <= options.tolerance))
      not_settled(first, problem);
    std::vector<PeriodicSolution> found = {reported(problem, first, options)};
    PeriodicGuess                 other = first.at;
    constexpr double kick = 0.5; // of the velocities, for the second start: more than doubles its kinetic energy
    other.v *= 1. + kick;
    if (problem.period_is_unknown())
      return found; // a drive that is kicked only needs long to come back
    const Settled second = settle(problem, other, options, options.tolerance, options.periods);
    if (second.error <= options.tolerance && !alike(first.at, second.at, problem))
      found.push_back(reported(problem, second, options));
    else
      found[0].notes.push_back("a second initial state, with 1.5 times the speed, settled " +
                               std::string(second.error <= options.tolerance ? "to the same solution" : "nowhere"));
    return found;
  }

private:
  static bool alike(const PeriodicGuess &a, const PeriodicGuess &b, const PeriodicProblem &problem)
  {
    const double     omega = 2. * M_PI / problem.period;
    const double     size  = std::sqrt(omega * omega * a.q.squaredNorm() + a.v.squaredNorm());
    constexpr double same  = 1e-4; // distance of two motions, of their size, within which they are one
    return std::sqrt(omega * omega * (a.q - b.q).squaredNorm() + (a.v - b.v).squaredNorm()) <= same * size;
  }
};

} // namespace

std::string why_not_propagated(const SecondOrderSystem &system, const std::string &instead)
{
  try
  {
    modal_blocks(system);
    LocalState local;
    local.resize(system);
    if (local.u.size() > 0)
      refuse_acceleration_forces(system, local, "exact propagation");
    return "";
  }
  catch (const std::invalid_argument &reason)
  {
    return std::string(reason.what()) + "; use --method " + instead + "";
  }
}

void lead_in(PeriodFlow &flow, const PeriodicProblem &problem, const PeriodicOptions &options, PeriodicGuess &guess)
{
  if (!(guess.period > 0.))
    guess.period = problem.period;
  for (int k = 0; k < options.value("lead-in", usual_lead_in) && !problem.interrupted(); ++k)
    if (one_period(flow, problem, guess) < near_enough)
      return;
}

PeriodicOption lead_in_option()
{
  return {"lead-in", "periods integrated before Newton's method begins (default " + std::to_string(usual_lead_in) + ")",
          0.,        1e9,
          true,      true};
}

PeriodicOptions without_lead_in(PeriodicOptions options)
{
  options.own[lead_in_option().name] = 0.;
  return options;
}

const PeriodicMethod &settling_method()
{
  static const Settling method;
  return method;
}

} // namespace gestell::coupling

#include "coupling/periodic/shooting/multiple_shooting.h"

#include "coupling/periodic/newton.h"
#include "coupling/periodic/shooting/shooting.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr long least_steps = 1000; ///< that a segment may take, however short the first ones were
} // namespace

CyclicSystem::CyclicSystem(const std::vector<MatrixXd> &A, const MatrixXd &b, Index phase)
    : N_(A[0].rows()), extra_(b.cols() > 0 ? 1 : 0)
{
  const Index K = N_ + extra_;
  MatrixXd    begin(N_, K), next = -MatrixXd::Identity(N_, N_);
  begin.leftCols(N_) = A[0];
  if (extra_)
    begin.col(N_) = b.col(0);
  for (std::size_t i = 1; i < A.size(); ++i)
  {
    MatrixXd here(2 * N_, N_), others = MatrixXd::Zero(2 * N_, K + N_);
    here << next, A[i];
    others.topLeftCorner(N_, K)      = begin;
    others.bottomRightCorner(N_, N_) = -MatrixXd::Identity(N_, N_);
    if (extra_)
      others.col(N_).tail(N_) = b.col(Index(i));
    Eigen::HouseholderQR<MatrixXd> rows(here);
    others.applyOnTheLeft(rows.householderQ().adjoint());
    eliminations_.push_back({std::move(rows), others.topLeftCorner(N_, K), others.topRightCorner(N_, N_)});
    begin = others.bottomLeftCorner(N_, K);
    next  = others.bottomRightCorner(N_, N_);
  }
  MatrixXd closing    = MatrixXd::Zero(K, K);
  closing.topRows(N_) = begin;
  closing.topLeftCorner(N_, N_) += next;
  if (extra_)
    closing(N_, phase) = 1.;
  closing_.compute(closing);
}

VectorXd CyclicSystem::solve(const VectorXd &r) const
{
  const Index           M = Index(eliminations_.size()) + 1;
  std::vector<VectorXd> right;
  VectorXd              rest(N_ + extra_), pair(2 * N_), x(M * N_ + extra_);
  rest << r.head(N_), r.tail(extra_);
  for (Index i = 1; i < M; ++i)
  {
    pair << rest.head(N_), r.segment(i * N_, N_);
    pair.applyOnTheLeft(eliminations_[std::size_t(i - 1)].rows.householderQ().adjoint());
    right.push_back(pair.head(N_));
    rest.head(N_) = pair.tail(N_);
  }
  const VectorXd begin = closing_.solve(rest);
  x.head(N_)           = begin.head(N_);
  x.tail(extra_)       = begin.tail(extra_);
  VectorXd next        = begin.head(N_);
  for (Index i = M - 1; i > 0; --i)
  {
    const auto &[rows, of_begin, of_next] = eliminations_[std::size_t(i - 1)];
    next                                  = right[std::size_t(i - 1)] - of_begin * begin - of_next * next;
    rows.matrixQR().topRows(N_).triangularView<Eigen::Upper>().solveInPlace(next);
    x.segment(i * N_, N_) = next;
  }
  return x;
}

SegmentEquations::SegmentEquations(const PeriodicProblem &problem, const MethodOptions &integration, int segments)
    : problem_(problem), integration_(integration), M_(segments), omega_(2. * M_PI / problem.period),
      flow_(problem_, integration)
{
  problem_.most_steps = std::max(least_steps, problem.most_steps / std::max(segments, 1));
  if (segments < 1)
    throw std::invalid_argument("multiple shooting: " + std::to_string(segments) +
                                " segments, but at least 1 is needed");
}

double SegmentEquations::period_of(const VectorXd &z) const
{
  const double period = problem_.period_is_unknown() ? z.tail(1)[0] : problem_.period;
  if (!(period > 0.))
    throw ConvergenceFailure("Newton's method gives a period that is not positive");
  return period;
}

/// Off the round shares at which symmetric motions have their events: an event where two segments meet belongs to none.
double SegmentEquations::share(int i) const
{
  constexpr double off_round = 0.0377; // of a segment: no fraction of small numbers
  return i == 0 ? 0. : i == M_ ? 1. : (i - off_round) / M_;
}

const PeriodPassage &SegmentEquations::pass(const VectorXd &z, int i, double period, bool tangents)
{
  const Index n = problem_.turn.size(), at = 2 * n * i;
  flow_.pass_part(z.segment(at, n) / omega_, z.segment(at + n, n), problem_.begin + period * share(i),
                  problem_.begin + period * share(i + 1), tangents);
  if (i + 1 == M_)
    flow_.put_back(z.head(n) / omega_);
  return flow_.passage();
}

VectorXd SegmentEquations::along_motion(const PeriodicGuess &guess)
{
  const Index n   = problem_.turn.size();
  VectorXd    z   = at_one_place(guess);
  z.segment(n, n) = guess.v;
  for (int i = 0; i + 1 < M_; ++i)
  {
    const PeriodPassage &passage = pass(z, i, period_of(z), false);
    z.segment(2 * n * (i + 1), 2 * n) << omega_ * passage.q, passage.v;
    work_.add({0, 0, passage.work});
  }
  return z;
}

VectorXd SegmentEquations::at_one_place(const PeriodicGuess &guess) const
{
  const Index  n      = problem_.turn.size();
  const double period = problem_.period_is_unknown() && guess.period > 0. ? guess.period : problem_.period;
  VectorXd     z(2 * n * M_ + (problem_.period_is_unknown() ? 1 : 0));
  for (int i = 0; i < M_; ++i)
    z.segment(2 * n * i, 2 * n) << omega_ * (guess.q + problem_.turn * share(i)), problem_.turn / period;
  if (problem_.period_is_unknown())
    z.tail(1)[0] = period;
  return z;
}

/// Segment i joins those before it.
void SegmentEquations::take(const PeriodPassage &passage, int i)
{
  const Index n = problem_.turn.size();
  MatrixXd   &A = parts_[std::size_t(i)];
  A             = passage.monodromy;
  A.topRightCorner(n, n) *= omega_;
  A.bottomLeftCorner(n, n) /= omega_;
  if (problem_.period_is_unknown())
    by_time_.col(i) << omega_ * (i + 1 == M_ ? without_free(problem_, passage.v) : passage.v) * part(i),
        flow_.end_acceleration() * part(i);
  whole_.monodromy = i == 0 ? passage.monodromy : MatrixXd(passage.monodromy * whole_.monodromy);
  whole_.fastest   = std::max(whole_.fastest, passage.fastest);
  whole_.chattering += passage.chattering * part(i);
  whole_.shift = passage.shift;
  whole_.events.insert(whole_.events.end(), passage.events.begin(), passage.events.end());
  whole_.grazing.insert(whole_.grazing.end(), passage.grazing.begin(), passage.grazing.end());
  work_.add({0, 0, passage.work});
}

void SegmentEquations::evaluate(const VectorXd &z)
{
  const Index n           = problem_.turn.size();
  const bool  asks_period = problem_.period_is_unknown();
  MatrixXd    dq(n, M_), dv(n, M_);
  whole_         = {};
  whole_.period  = period_of(z);
  whole_.q_begin = z.head(n) / omega_;
  whole_.v_begin = z.segment(n, n);
  states_.clear();
  steps_ = 0;
  residual_.setZero(z.size());
  parts_.resize(std::size_t(M_));
  by_time_.resize(2 * n, asks_period ? M_ : 0);
  ++work_.periods;
  for (int i = 0; i < M_; ++i)
  {
    const PeriodPassage &passage = pass(z, i, whole_.period, true);
    take(passage, i);
    steps_ += passage.work.steps;
    states_.push_back({problem_.begin + whole_.period * share(i), passage.q_begin, passage.v_begin});
    const Index next = 2 * n * ((i + 1) % M_);
    dq.col(i)        = passage.q - z.segment(next, n) / omega_;
    dv.col(i)        = passage.v - z.segment(next + n, n);
    if (i + 1 == M_)
      dq.col(i) -= problem_.turn;
    else if (flow_.remembers_at_end())
      throw ConvergenceFailure("elements have hysteresis at " +
                               std::to_string(problem_.begin + whole_.period * share(i + 1)) +
                               " s, where a segment ends; use one segment only (shooting)");
    residual_.segment(2 * n * i, 2 * n) << omega_ * dq.col(i), dv.col(i);
  }
  closing_ = closing_error(dq.reshaped(), dv.reshaped(), 2. * M_PI / whole_.period, whole_.fastest);
  if (asks_period)
    residual_.tail(1)[0] = z[problem_.phase] - omega_ * problem_.phase_value;
}

void SegmentEquations::expect_no_more()
{
  constexpr long runs_away = 16; // steps of a segment astray, of those at the start
  problem_.most_steps      = std::max(least_steps, runs_away * steps_ / M_);
}

CyclicSystem SegmentEquations::matrix() const
{
  return CyclicSystem(parts_, by_time_, problem_.phase);
}

PeriodicSolution SegmentEquations::solution() const
{
  PeriodicSolution solution = solution_of(problem_, integration_, whole_, closing_);
  solution.method           = "shooting";
  solution.states           = states_;
  solution.work             = work_;
  return solution;
}

double SegmentEquations::closing_in_one(const VectorXd &z)
{
  const Index    n             = problem_.turn.size();
  const double   period        = period_of(z);
  const long     most          = problem_.most_steps;
  constexpr long all_steps     = 4; // of a period in one go, of those that the segments took
  problem_.most_steps          = std::max(least_steps, all_steps * steps_);
  const PeriodPassage &passage = flow_.pass(z.head(n) / omega_, z.segment(n, n), period, false);
  problem_.most_steps          = most;
  work_.add({0, 1, passage.work});
  return closing_error(passage.q - passage.q_begin - problem_.turn, passage.v - passage.v_begin, 2. * M_PI / period,
                       passage.fastest);
}

namespace
{

/// Length of a Newton step, T as large as the states where the motion is as fast as `speed`.
double length(const PeriodicProblem &problem, double speed, VectorXd dz)
{
  if (problem.period_is_unknown())
    dz.tail(1) *= speed / problem.period;
  return dz.norm();
}

/// What a user should know of a motion that is closed in segments only.
std::string note_of(SegmentEquations &equations, const VectorXd &z)
{
  std::ostringstream text;
  text << "solved by multiple shooting in " << equations.segments() << " segments; ";
  try
  {
    text << "integrated from its initial state in a single pass it misses it by " << equations.closing_in_one(z)
         << " of its speed";
  }
  catch (const SearchInterrupted &)
  {
    text << "integration in a single pass was not tried";
  }
  catch (const ConvergenceFailure &)
  {
    text << "integration from its initial state in a single pass fails";
  }
  return text.str();
}

} // namespace

PeriodicSolution shoot_in_segments(SegmentEquations &equations, const PeriodicProblem &problem, VectorXd z,
                                   const PeriodicOptions &options)
{
  equations.evaluate(z);
  equations.expect_no_more();
  std::optional<CyclicSystem> matrix;
  double                      speed = 0.;
  const auto                  step  = [&](NewtonResult &) -> NewtonStep
  {
    if (equations.closing() <= options.tolerance)
      return {};
    if (problem.interrupted())
      throw SearchInterrupted();
    matrix              = equations.matrix();
    speed               = equations.fastest();
    const VectorXd dz   = -matrix->solve(equations.residual());
    const double   size = length(problem, speed, dz);
    // mean step of a state, of the fastest speed: from one end of a swing to the other
    constexpr double longest_step_of_states = 2.;
    const double     share   = std::min(1., longest_step_of_states * std::sqrt(equations.segments()) * speed / size);
    constexpr double shorter = 0.25; // the next step must be, by this share of the part taken
    return {dz, size, shorter, share};
  };
  const auto size_of_next_step = [&](const VectorXd &next)
  {
    equations.evaluate(next);
    return equations.closing() <= options.tolerance ? 0. : length(problem, speed, matrix->solve(equations.residual()));
  };
  const int        iterations    = solve_by_newton(z, options.iterations, step, size_of_next_step).iterations;
  constexpr double left_by_steps = 1e-7; // gaps that rounding and the steps' tolerance may leave at worst
  if (!(equations.closing() <= std::max(options.tolerance, left_by_steps)))
  {
    std::ostringstream text;
    text << equations.segments() << " gaps between segments are still " << equations.closing() << " after "
         << iterations << " Newton steps";
    throw NoPeriodicMotion(text.str());
  }
  PeriodicSolution solution = equations.solution();
  note_residual(solution, options.tolerance);
  solution.notes.push_back(note_of(equations, z));
  solution.work            = equations.solution().work;
  solution.work.iterations = iterations;
  return solution;
}

PeriodicSolution shoot_in_segments(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                   const PeriodicOptions &options)
{
  constexpr int few_segments  = 8;  // of a period: growth over a segment is the 8th root
  constexpr int many_segments = 32; // tried where few do not converge
  const int     few           = options.segments > 0 ? options.segments : few_segments,
            many              = options.segments > 0 ? options.segments : many_segments;
  std::string failures        = "multiple shooting does not converge";
  for (const auto &[segments, follows] : {std::pair(few, true), std::pair(many, true), std::pair(many, false)})
    try
    {
      if (!follows && problem.period_is_unknown() && problem.turn.isZero(0.))
        continue; // at one place it would be at rest
      SegmentEquations equations(problem, options.integration, segments);
      const VectorXd   z     = follows ? equations.along_motion(guess) : equations.at_one_place(guess);
      PeriodicSolution found = shoot_in_segments(equations, problem, z, options);
      refuse_rest(problem, guess, found);
      return found;
    }
    catch (const SearchInterrupted &)
    {
      throw;
    }
    catch (const NoPeriodicMotion &failure)
    {
      failures += std::string("; ") + failure.what();
    }
    catch (const ConvergenceFailure &failure)
    {
      failures += std::string("; ") + failure.what();
    }
  throw NoPeriodicMotion(failures);
}

} // namespace gestell::coupling

#include "coupling/periodic/recurrence.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/periodic/period_flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::VectorXd;

constexpr double closes = 1e-4; ///< distance of two states, of the fastest speed, at which they are one
/// of periods, for the error of the mean: it is itself known to 1 / sqrt(2 * 15) = 18 %
constexpr int    n_batches    = 16;
constexpr double comes_nearer = 0.01; ///< by which distances fall at least, quarter by quarter, if they do
constexpr double longest_turn = 3.;   ///< of the period expected, within which an angle comes round

/// The periods of a motion one after the other, with a direction d in which a neighbour lies.
class Follower
{
public:
  Follower(const PeriodicProblem &problem, const PeriodicGuess &guess, const MethodOptions &integration)
      : problem_(problem), flow_(problem, integration), omega_(2. * M_PI / problem.period), q_(guess.q), v_(guess.v)
  {
    if (!flow_.has_tangents())
      throw std::invalid_argument(method_name(integration) + " has no tangents; the Lyapunov exponent needs them");
    // No symmetry of a machine is one of this direction: it has a share in all that grows.
    direction_ = VectorXd::NullaryExpr(2 * q_.size(), [](Index i) { return std::cos(1. + double(i * i)); });
    direction_.normalize();
  }

  VectorXd state() const
  {
    VectorXd x(2 * q_.size());
    x << omega_ * q_, v_;
    return x;
  }
  double              fastest() const { return fastest_; }
  double              seconds() const { return seconds_; } ///< of the last period
  const PeriodicWork &work() const { return work_; }

  void pass() { go_on(problem_.period_is_unknown() ? pass_turn() : flow_.pass(q_, v_, problem_.period, false)); }

  /// @return ln of the growth of d
  double pass_with_direction()
  {
    const double         period  = problem_.period_is_unknown() ? pass_turn().period : problem_.period;
    const PeriodPassage &passage = flow_.pass(q_, v_, period, true);
    const Index          n       = q_.size();
    VectorXd             d       = direction_;
    d.head(n) /= omega_;
    d = passage.monodromy * d;
    if (problem_.period_is_unknown())
    {
      // A neighbour comes round by dt earlier: what it does in dt belongs to the next period.
      VectorXd rates(2 * n);
      rates << passage.v, flow_.end_acceleration();
      d -= d[problem_.phase] / rates[problem_.phase] * rates;
    }
    d.head(n) *= omega_;
    const double growth = d.norm();
    direction_          = d / growth;
    go_on(passage);
    return std::log(growth);
  }

private:
  const PeriodPassage &pass_turn() { return flow_.pass_turn(q_, v_, longest_turn * problem_.period); }

  void go_on(const PeriodPassage &passage)
  {
    q_       = passage.q - problem_.turn;
    v_       = passage.v;
    fastest_ = passage.fastest;
    seconds_ = passage.period;
    work_.add({0, 1, passage.work});
    if (!q_.allFinite() || !v_.allFinite())
      throw ConvergenceFailure("the motion diverges");
  }

  const PeriodicProblem &problem_;
  PeriodFlow             flow_;
  double                 omega_;
  VectorXd               q_, v_, direction_;
  double                 fastest_ = 0., seconds_ = 0.;
  PeriodicWork           work_;
};

/// |x_(j+k) - x_j| over all j.
VectorXd distances(const Eigen::MatrixXd &states, int k)
{
  const Index n = states.cols() - k;
  return (states.rightCols(n) - states.leftCols(n)).colwise().norm().transpose();
}

/// How a motion comes back to where it was some periods before.
struct Return
{
  int  repeats = 0; ///< these periods; 0: to no place of up to highest_repeats
  bool closes  = false;
  bool nearer  = false; ///< it comes ever nearer to it
};

/// The largest of each quarter.
std::array<double, 4> quarters(const VectorXd &distances)
{
  std::array<double, 4> largest;
  const Index           length = distances.size() / 4;
  for (Index i = 0; i < 4; ++i)
    largest[std::size_t(i)] = distances.segment(i * length, length).maxCoeff();
  return largest;
}

/// The fewest periods that bring the motion back, now or soon.
Return return_of(const Eigen::MatrixXd &states, double fastest)
{
  bool          falls_slowly    = false;
  constexpr int highest_repeats = 16; // four doublings of the period: beyond them a motion counts as chaotic
  for (int k = 1; k <= highest_repeats; ++k)
  {
    const auto distance = quarters(distances(states, k));
    if (std::max(distance[2], distance[3]) <= closes * fastest)
      return {k, true, false};
    // last distances, of the first, of a motion that settles: it needs as many periods again for each half
    constexpr double soon_there = 0.5;
    if (distance[3] < soon_there * distance[0])
      return {k, false, true};
    falls_slowly = falls_slowly || (std::is_sorted(distance.rbegin(), distance.rend()) &&
                                    distance[3] < (1. - comes_nearer) * distance[0]);
  }
  return {0, false, falls_slowly};
}

/// Diagonal of the box about some states.
double room(const Eigen::MatrixXd &states)
{
  return (states.rowwise().maxCoeff() - states.rowwise().minCoeff()).norm();
}

/// Whether the motion lies ever farther away: a bounded one takes as much room in each half as in all.
/// @param turns  of coordinates in a period, or none: what turns goes on for ever
bool drifts(Eigen::MatrixXd states, const VectorXd &turns, double fastest)
{
  for (Index i = 0; i < turns.size(); ++i)
    if (turns[i] != 0.)
      states.row(i).setZero();
  const Index      half  = states.cols() / 2;
  const double     first = room(states.leftCols(half)), last = room(states.rightCols(half)), all = room(states);
  const VectorXd   moved   = states.rightCols(half).rowwise().mean() - states.leftCols(half).rowwise().mean();
  constexpr double goes_on = 1.5; // room that a motion takes in all, of that in its first half, if it drifts
  return all > closes * fastest && all > goes_on * first && last > (1. - comes_nearer) * first &&
         moved.norm() > all / 3.;
}

/// Mean and its error, of terms that are correlated with their neighbours and may yet fall: the standard error of the
/// mean of batches, and half of what the means of both halves differ by.
std::pair<double, double> mean_of(const VectorXd &terms)
{
  const Index length = terms.size() / n_batches;
  VectorXd    batches(n_batches);
  for (Index i = 0; i < n_batches; ++i)
    batches[i] = terms.segment(i * length, length).mean();
  const double mean  = batches.mean();
  const double falls = batches.head(n_batches / 2).mean() - batches.tail(n_batches / 2).mean();
  const double error = std::sqrt((batches.array() - mean).square().sum() / (n_batches * (n_batches - 1)));
  return {mean, std::max(error, 0.5 * std::abs(falls))};
}

void name(Recurrence &recurrence, const Eigen::MatrixXd &states, const VectorXd &turns, double fastest)
{
  const Return     back    = return_of(states, fastest);
  constexpr double certain = 4.; // standard errors: wrong once in 16000
  const double     doubt   = certain * recurrence.error;
  if (back.closes)
    recurrence.kind = back.repeats == 1 ? "periodic" : "sub-harmonic";
  else if (recurrence.exponent > doubt)
    recurrence.kind = "chaotic";
  else if (recurrence.exponent < -doubt || back.nearer)
    recurrence.kind = "settling";
  else if (drifts(states, turns, fastest))
    recurrence.kind = "drifting";
  else
    recurrence.kind = "quasi-periodic";
  if (back.closes || recurrence.kind == "settling")
    recurrence.repeats = back.repeats;
}

} // namespace

Recurrence recurrence_of(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicOptions &options,
                         int periods)
{
  if (periods < least_section)
    throw std::invalid_argument("a section of " + std::to_string(periods) + " periods is too short; use at least " +
                                std::to_string(least_section));
  const PeriodicProblem one             = problem.of_one_period();
  MethodOptions         integration     = options.integration;
  constexpr double      followed_finely = 1e-9; // tolerance of the steps: a section is not read more finely
  if (!(integration.step > 0.))
    integration.tolerance = std::max(integration.tolerance, followed_finely);
  Follower follower(one, guess, integration);
  for (int k = 0; k < periods - periods / n_batches; ++k)
    follower.pass();
  for (int k = 0; k < periods / n_batches; ++k)
    follower.pass_with_direction(); // until d is the direction that grows most
  const Index     n = guess.q.size();
  Eigen::MatrixXd states(2 * n, periods);
  VectorXd        growth(periods);
  double          fastest = 0., seconds = 0.;
  for (int k = 0; k < periods; ++k)
  {
    states.col(k) = follower.state();
    growth[k]     = follower.pass_with_direction();
    fastest       = std::max(fastest, follower.fastest());
    seconds += follower.seconds();
  }
  Recurrence recurrence;
  recurrence.periods                              = periods;
  std::tie(recurrence.exponent, recurrence.error) = mean_of(growth);
  recurrence.exponent *= periods / seconds;
  recurrence.error *= periods / seconds;
  name(recurrence, states, one.turn, fastest);
  recurrence.section = states;
  recurrence.section.topRows(n) *= one.period / (2. * M_PI);
  recurrence.work = follower.work();
  return recurrence;
}

} // namespace gestell::coupling

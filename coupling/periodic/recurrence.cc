#include "coupling/periodic/recurrence.h"

#include "coupling/periodic/period_flow.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::VectorXd;

constexpr int    highest_repeats = 16;
constexpr double closes          = 1e-4; ///< distance of two states, of the way between all, at which they are one
constexpr double certain         = 3.;   ///< standard errors of the mean

/// Periods after which the states come back; 0: they do not.
int repeats_of(const Eigen::MatrixXd &section)
{
  const double size = (section.colwise() - section.rowwise().mean()).colwise().norm().maxCoeff();
  for (int k = 1; k <= highest_repeats && 2 * k < section.cols(); ++k)
  {
    const Index n = section.cols() - k;
    if ((section.rightCols(n) - section.leftCols(n)).colwise().norm().maxCoeff() <= closes * size)
      return k;
  }
  return 0;
}
} // namespace

Recurrence recurrence_of(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicOptions &options,
                         int periods)
{
  PeriodFlow   flow(problem, options.integration);
  const Index  n     = guess.q.size();
  const double omega = 2. * M_PI / problem.period;
  VectorXd     q = guess.q, v = guess.v, d = VectorXd::Ones(2 * n).normalized();
  const auto   next = [&](bool tangents)
  {
    const PeriodPassage &passage = flow.pass(q, v, problem.period, tangents);
    q                            = passage.q - problem.turn;
    v                            = passage.v;
  };
  for (int k = 0; k < periods; ++k)
    next(false);
  Recurrence recurrence;
  recurrence.section.resize(2 * n, periods);
  VectorXd growth(periods);
  for (int k = 0; k < periods; ++k)
  {
    recurrence.section.col(k) << omega * q, v;
    next(true);
    d         = flow.passage().monodromy * d;
    growth[k] = std::log(d.norm());
    d.normalize();
  }
  const double mean = growth.mean(), spread = std::sqrt((growth.array() - mean).square().mean() / periods);
  recurrence.exponent = mean / problem.period;
  recurrence.repeats  = repeats_of(recurrence.section);
  recurrence.section.topRows(n) /= omega;
  recurrence.kind = recurrence.repeats > 0 ? "sub-harmonic" : mean > certain * spread ? "chaotic" : "quasi-periodic";
  return recurrence;
}

} // namespace gestell::coupling

#include "apps/analysis/periodic/backbone.h"

#include "apps/analysis/periodic/periodic_entry.h"
#include "coupling/periodic/averaging/slow_flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::apps
{

namespace
{
using Eigen::VectorXd;

/// (Omega, parameter) of all solutions, ascending; empty: the parameter does not change Omega one to one.
std::vector<std::pair<double, double>> frequencies_of(const std::vector<PeriodicEntry> &entries)
{
  std::vector<std::pair<double, double>> pairs;
  for (const PeriodicEntry &entry : entries)
    pairs.emplace_back(2. * M_PI * entry.solution.ratio / entry.solution.period, entry.parameter);
  std::sort(pairs.begin(), pairs.end());
  constexpr double same_frequency = 1e-9; // relative: rounding of periods
  if (pairs.empty() || !(pairs.back().first > (1. + same_frequency) * pairs.front().first))
    return {};
  const bool rising = pairs.back().second > pairs.front().second;
  const auto turns  = [&](const auto &a, const auto &b)
  { return b.first > (1. + same_frequency) * a.first && (b.second > a.second) != rising; };
  return std::adjacent_find(pairs.begin(), pairs.end(), turns) == pairs.end()
             ? pairs
             : std::vector<std::pair<double, double>>();
}

/// The parameter at which the load has this frequency; nan beyond those that were seen.
double parameter_at(const std::vector<std::pair<double, double>> &pairs, double omega)
{
  const auto above = std::lower_bound(pairs.begin(), pairs.end(), std::pair(omega, -HUGE_VAL));
  if (above == pairs.end() || above == pairs.begin())
    return std::nan("");
  const auto below = above - 1;
  return below->second + (omega - below->first) / (above->first - below->first) * (above->second - below->second);
}

/// Largest amplitude of the mode in the solutions, from its displacement and rate at their start.
double largest_amplitude(const coupling::Machine &machine, const coupling::SlowFlow &flow, const VectorXd &rest,
                         const std::vector<PeriodicEntry> &entries)
{
  VectorXd weight(machine.size());
  machine.linear().mass_times(flow.shape(), weight);
  double largest = 0.;
  for (const PeriodicEntry &entry : entries)
  {
    const coupling::PeriodicSolution &s     = entry.solution;
    const double                      omega = 2. * M_PI * s.ratio / s.period;
    largest = std::max(largest, std::hypot(weight.dot(s.q - rest), weight.dot(s.v) / omega));
  }
  return largest;
}

/// phi a cos(omega t) about the mean that the mean forces keep.  What the describing functions add to the stiffness of
/// the mode, k(a) = 2 omega_0 (omega(a) - omega_0) of the slow flow, gives omega itself:  omega^2 = omega_0^2 + k(a).
coupling::PeriodicSolution free_motion(const coupling::PeriodicProblem &problem, coupling::SlowFlow &flow, double a)
{
  const double               k     = 2. * flow.omega_0() * (flow.at(a).omega - flow.omega_0());
  const double               omega = std::sqrt(std::max(0., flow.omega_0() * flow.omega_0() + k));
  coupling::FourierSeries    series;
  coupling::PeriodicSolution motion;
  const auto                 n = flow.shape().size();
  series.omega                 = omega;
  series.begin                 = problem.begin;
  series.ramp                  = VectorXd::Zero(n);
  series.cosine                = Eigen::MatrixXd::Zero(n, 2);
  series.sine                  = series.cosine;
  series.cosine.col(0)         = flow.mean();
  series.cosine.col(1)         = a * flow.shape();
  motion.begin                 = problem.begin;
  motion.period                = 2. * M_PI / omega;
  motion.turn                  = VectorXd::Zero(n);
  motion.series                = series;
  return motion;
}

} // namespace

std::vector<PeriodicEntry> backbone_of(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                       const std::vector<PeriodicEntry>    &entries,
                                       const std::vector<coupling::Signal> &signals)
{
  const auto    frequencies      = frequencies_of(entries);
  constexpr int most_coordinates = 3; // in a chart of more, modes interact and cross
  if (frequencies.empty() || machine.size() > most_coordinates || problem.period_is_unknown())
    return {};
  std::vector<PeriodicEntry> backbone;
  try
  {
    coupling::SlowFlow flow(problem);
    constexpr double   beyond_largest = 1.15; // of the solutions' amplitudes: the curve is seen to pass its resonance
    const double       largest        = beyond_largest * largest_amplitude(machine, flow, flow.mean(), entries);
    constexpr int      amplitudes     = 48;     // points of a curve: a chord of a smooth bend is a pixel off at most
    constexpr int      rows_of_amplitude = 128; // of a period: extremes to (pi / 128)^2 / 2 = 0.03 %
    for (int k = 1; k <= amplitudes && largest > 0.; ++k)
    {
      const auto   motion    = free_motion(problem, flow, largest * k / amplitudes);
      const double parameter = parameter_at(frequencies, 2. * M_PI / motion.period);
      if (std::isnan(parameter))
        continue;
      backbone.push_back(entry_of(machine, problem, motion, signals, rows_of_amplitude));
      backbone.back().parameter = parameter;
    }
  }
  catch (const std::invalid_argument &)
  {
    // averaging is not applicable here: no backbone
  }
  catch (const coupling::NoPeriodicMotion &)
  {
    // likewise beyond these amplitudes
  }
  return backbone;
}

} // namespace gestell::apps

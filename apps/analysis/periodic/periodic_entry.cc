#include "apps/analysis/periodic/periodic_entry.h"

#include "coupling/machine/accelerations.h"
#include "coupling/periodic/harmonic/fourier_transform.h"
#include "coupling/periodic/harmonic/signal_harmonics.h"
#include "coupling/periodic/minimising.h"
#include "coupling/periodic/period_flow.h"
#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "coupling/periodic/trace_orbit.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{

namespace
{
constexpr int harmonics_told = 10; ///< of the drive: a line of text; the file has all

using coupling::PeriodicSolution;

/// Mean, amplitudes and phases of column `column` of rows over one period, the last row being the first again.
void take_harmonics(const PeriodicEntry &entry, std::size_t width, std::size_t column, SignalOrbit &signal)
{
  std::vector<double> samples;
  for (std::size_t i = column; i < entry.rows.size(); i += width)
    samples.push_back(entry.rows[i]);
  const PeriodicSolution &of    = entry.solution;
  auto                    found = coupling::signal_harmonics(samples, of.begin / of.period, of.ratio, harmonics_told);
  signal.mean                   = found.mean;
  signal.amplitude              = std::move(found.amplitude);
  signal.phase                  = std::move(found.phase);
}

/// Columns t and signals of a history.
std::vector<double> signal_rows(const coupling::RunResult &run, std::size_t n_signals)
{
  std::vector<double> rows;
  const std::size_t   width = run.columns.size();
  for (std::size_t i = 0; i + width <= run.rows.size(); i += width)
    rows.insert(rows.end(), run.rows.begin() + std::ptrdiff_t(i), run.rows.begin() + std::ptrdiff_t(i + n_signals + 1));
  return rows;
}

/// The signals of a motion that is a series, at instants equally spaced; extremes between them from more.
void trace_signals(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                   const PeriodicSolution &solution, const std::vector<coupling::Signal> &signals, int rows,
                   PeriodicEntry &entry)
{
  machine.will_read(signals);
  auto                             accelerations = coupling::accelerations_for(signals, machine);
  const Eigen::VectorXd            none;
  constexpr int                    least_samples = 4096; // of a period, for extremes: to (pi / 4096)^2 / 2 = 3e-7
  const int                        finer         = std::max(1, least_samples / rows);
  std::vector<std::vector<double>> samples(signals.size());
  int                              k = 0;
  coupling::trace(problem, solution, finer * rows,
                  [&](const coupling::OrbitPoint &point)
                  {
                    const Eigen::VectorXd &a = accelerations ? accelerations->at(point.q, point.v, point.local) : none;
                    const bool             row = k++ % finer == 0;
                    if (row)
                      entry.rows.push_back(point.t);
                    for (std::size_t j = 0; j < signals.size(); ++j)
                    {
                      samples[j].push_back(machine.evaluate(signals[j], point.q, point.v, a, point.local));
                      if (row)
                        entry.rows.push_back(samples[j].back());
                    }
                  });
  for (std::size_t j = 0; j < signals.size(); ++j)
  {
    SignalOrbit signal;
    signal.name                             = signals[j].name;
    signal.unit                             = signals[j].unit;
    const coupling::SignalExtremes extremes = coupling::signal_extremes(samples[j]);
    signal.max                              = extremes.max;
    signal.min                              = extremes.min;
    entry.signals.push_back(signal);
  }
}

} // namespace

void check_options(const PeriodicRequest &request, const coupling::PeriodicMethod &method)
{
  if (const std::string none = coupling::why_no_branch(method); !request.along.empty() && !none.empty())
    throw std::invalid_argument("--along: " + none);
  if (request.check == method.name())
    throw std::invalid_argument("--check " + method.name() + ": the solution is already computed by " + method.name() +
                                "; choose another method for the check");
  const auto takes = [](const coupling::PeriodicMethod &by, const std::string &name)
  {
    const auto own = by.options();
    return std::any_of(own.begin(), own.end(), [&](const auto &option) { return option.name == name; });
  };
  const coupling::PeriodicMethod *check = request.check.empty() ? nullptr : &coupling::periodic_method(request.check);
  for (const auto &[name, value] : request.own)
  {
    const auto all    = coupling::options_of_periodic_methods();
    const auto option = std::find_if(all.begin(), all.end(), [&](const auto &known) { return known.name == name; });
    if (option == all.end())
    {
      std::vector<std::string> names;
      for (const auto &known : all)
        names.push_back(known.name);
      throw std::invalid_argument("periodic: there is no option \"" + name + '"' + suggestion(name, names));
    }
    if (!(value >= option->least && value <= option->most) || (option->whole && value != std::floor(value)))
      throw std::invalid_argument("--" + name + " is " + short_text(value, 12) + "; it must be " +
                                  (option->whole ? "an integer" : "a number") + " from " +
                                  short_text(option->least, 12) + " to " + short_text(option->most, 12));
    if (takes(method, name) || (check && !option->of_lead && takes(*check, name)))
      continue;
    const auto &methods = coupling::periodic_methods();
    const auto  serves =
        std::find_if(methods.begin(), methods.end(), [&](const auto *other) { return takes(*other, name); });
    throw std::invalid_argument("--" + name + " has no effect with the method " + method.name() + "; add --method " +
                                (*serves)->name() + ", or omit the option");
  }
}

PeriodicSolution of_own_period(const coupling::PeriodicMethod &method, const coupling::PeriodicProblem &problem,
                               const PeriodicSolution &solution, const coupling::PeriodicOptions &options)
{
  const int k = coupling::own_ratio(problem, solution);
  if (k == solution.ratio)
    return solution;
  const double              part    = double(k) / solution.ratio;
  coupling::PeriodicProblem shorter = problem;
  shorter.period                    = part * solution.period;
  shorter.turn                      = part * solution.turn;
  shorter.ratio                     = k;
  return method.solve(shorter, {solution.q, solution.v, shorter.period}, without_lead_in(options)).front();
}

coupling::RunResult orbit_run(coupling::Machine &machine, const PeriodicSolution &solution,
                              const std::vector<coupling::Signal> &signals, int rows, OrbitRun keep)
{
  coupling::RunOptions run;
  run.method                  = solution.integration;
  constexpr double fine_steps = 1e-11; // tolerance of the steps that trace a motion
  if (!(run.method.tolerance > 0.) && !(run.method.step > 0.))
    run.method.tolerance = fine_steps;
  run.begin          = solution.begin;
  run.end            = solution.begin + solution.period;
  run.output_step    = solution.period / rows;
  run.picture_step   = keep == OrbitRun::pictures ? solution.period / 60. : 0.;
  run.energy         = keep == OrbitRun::pictures;
  run.force_unstable = true;
  coupling::InitialState initial;
  initial.t       = solution.begin;
  initial.q       = solution.q;
  initial.v       = solution.v;
  initial.settled = true;
  initial.still   = coupling::still_speed(machine, solution.q, solution.v, solution.period);
  return coupling::simulate(machine, initial, run, signals);
}

PeriodicEntry entry_of(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                       const PeriodicSolution &solution, const std::vector<coupling::Signal> &signals, int rows,
                       std::optional<coupling::RunResult> *run_of_it)
{
  PeriodicEntry entry;
  entry.solution           = solution;
  constexpr double neutral = 1e-9; // distance of a multiplier from 1 that is none
  if (const double largest = solution.largest_multiplier(); std::abs(largest - 1.) <= neutral)
    entry.solution.notes.push_back("a multiplier is 1: nearby trajectories neither approach this solution nor diverge "
                                   "from it, as with sticking friction");
  rows = std::max(rows, coupling::power_of_two(4 * harmonics_told * solution.ratio));
  if (solution.series)
    trace_signals(machine, problem, solution, signals, rows, entry);
  else
  {
    coupling::RunResult run =
        orbit_run(machine, solution, signals, rows, run_of_it ? OrbitRun::pictures : OrbitRun::signals);
    if (!run.failure.empty())
      throw coupling::ConvergenceFailure("the solution cannot be integrated over its period: " + run.failure);
    entry.rows = signal_rows(run, signals.size());
    for (const coupling::SignalSummary &summary : run.signals)
    {
      SignalOrbit signal;
      signal.name = summary.name;
      signal.unit = summary.unit;
      signal.max  = summary.max;
      signal.min  = summary.min;
      entry.signals.push_back(signal);
    }
    if (run_of_it)
      *run_of_it = std::move(run);
  }
  for (std::size_t j = 0; j < entry.signals.size(); ++j)
    take_harmonics(entry, signals.size() + 1, j + 1, entry.signals[j]);
  return entry;
}

PeriodicCheck compared(const PeriodicEntry &first, const PeriodicEntry &second, const std::string &method)
{
  PeriodicCheck     check{method, {}, ""};
  const std::size_t width = first.signals.size() + 1;
  for (std::size_t j = 0; j < first.signals.size(); ++j)
  {
    double apart = 0., size = 0.;
    for (std::size_t i = j + 1; i < std::min(first.rows.size(), second.rows.size()); i += width)
    {
      apart = std::max(apart, std::abs(first.rows[i] - second.rows[i]));
      size  = std::max(size, std::abs(first.rows[i] - first.signals[j].mean));
    }
    constexpr double steady = 1e-9; // amplitude that is what steps leave, of the mean: that is the size
    if (const double mean = std::abs(first.signals[j].mean); size <= steady * mean)
      size = mean;
    check.distances.emplace_back(first.signals[j].name, size > 0. ? apart / size : apart);
  }
  return check;
}

} // namespace gestell::apps

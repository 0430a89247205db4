#include "apps/analysis/periodic/long_run.h"

#include "apps/analysis/periodic/phase_planes.h"
#include "apps/scene/build/build_machine.h"
#include "coupling/machine/accelerations.h"
#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/recurrence.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "coupling/periodic/verified_orbit.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace gestell::apps
{

namespace
{
using coupling::PeriodicProblem;
using coupling::PeriodicSolution;
using coupling::Recurrence;
using coupling::Signal;
using Eigen::Index;
using Eigen::VectorXd;

/// Signals of a state at the start of a period, when elements have no history yet.
class BeginReader
{
public:
  BeginReader(coupling::Machine &machine, double begin, const std::vector<Signal> &signals)
      : machine_(machine), signals_(signals), accelerations_(coupling::accelerations_for(signals, machine))
  {
    machine_.will_read(signals);
    local_.resize(machine);
    local_.t = begin;
    machine_.events().follow_history(false);
  }

  void read(const VectorXd &q, const VectorXd &v, std::vector<double> &values)
  {
    machine_.gather(local_.t, q, v, VectorXd::Zero(q.size()), local_);
    machine_.events().start(local_);
    machine_.forces().force(local_, local_.p);
    const VectorXd none;
    const VectorXd a = accelerations_ ? accelerations_->at(q, v, local_) : none;
    for (const Signal &signal : signals_)
      values.push_back(machine_.evaluate(signal, q, v, a, local_));
  }

private:
  coupling::Machine                     &machine_;
  const std::vector<Signal>             &signals_;
  std::optional<coupling::Accelerations> accelerations_;
  coupling::LocalState                   local_;
};

/// Signals at all points of the section, row major.
std::vector<double> read_section(coupling::Machine &machine, double begin, const Eigen::MatrixXd &section,
                                 const std::vector<Signal> &signals)
{
  const Index         n = section.rows() / 2;
  std::vector<double> values;
  BeginReader         reader(machine, begin, signals);
  for (Index k = 0; k < section.cols(); ++k)
    reader.read(section.col(k).head(n), section.col(k).tail(n), values);
  return values;
}

/// Signals whose rate is known, else the coordinates that move farthest.
std::vector<Signal> plane_signals(const coupling::Machine &machine, const Recurrence &motion,
                                  const std::vector<Signal> &signals)
{
  std::vector<Signal>   planes;
  constexpr std::size_t most_planes = 2; // of a section: a row of charts
  for (const Signal &signal : signals)
    if (planes.size() < most_planes && rate_of(signal))
      planes.push_back(signal);
  if (!planes.empty())
    return planes;
  const Index      n      = machine.size();
  const VectorXd   spread = motion.section.rowwise().maxCoeff() - motion.section.rowwise().minCoeff();
  std::vector<int> widest(static_cast<std::size_t>(n));
  std::iota(widest.begin(), widest.end(), 0);
  std::stable_sort(widest.begin(), widest.end(), [&](int a, int b) { return spread[a] > spread[b]; });
  for (std::size_t k = 0; k < std::min(most_planes, widest.size()); ++k)
  {
    Signal coordinate;
    coordinate.name = machine.coordinate_name(widest[k]);
    coordinate.on_q = {{widest[k], coordinate_sign(machine, widest[k])}};
    planes.push_back(coordinate);
  }
  return planes;
}

std::vector<PhasePlane> section_planes(coupling::Machine &machine, double begin, const Recurrence &motion,
                                       const std::vector<Signal> &signals)
{
  std::vector<Signal>     read = plane_signals(machine, motion, signals);
  const std::size_t       n    = read.size();
  std::vector<PhasePlane> planes;
  for (std::size_t j = 0; j < n; ++j)
  {
    planes.push_back({read[j].name, read[j].unit, {PhasePlane::Curve()}});
    read.push_back(*rate_of(read[j]));
  }
  const std::vector<double> values = read_section(machine, begin, motion.section, read);
  for (std::size_t i = 0; i < values.size(); i += 2 * n)
    for (std::size_t j = 0; j < n; ++j)
    {
      planes[j].curves[0].x.push_back(values[i + j]);
      planes[j].curves[0].rate.push_back(values[i + n + j]);
    }
  return planes;
}

/// The motion that the section comes back to, from its last state.
std::vector<PeriodicSolution> repeated(const PeriodicProblem &problem, const Recurrence &motion,
                                       const coupling::PeriodicOptions &options)
{
  PeriodicProblem longer = problem;
  longer.period *= double(motion.repeats) / problem.ratio;
  longer.turn *= double(motion.repeats) / problem.ratio;
  longer.ratio     = motion.repeats;
  const Index n    = motion.section.rows() / 2;
  const auto  last = motion.section.col(motion.section.cols() - 1);
  return coupling::shooting_method().solve(longer, {last.head(n), last.tail(n), 0.}, without_lead_in(options));
}

bool lasts(const std::vector<PeriodicSolution> &solutions)
{
  return std::any_of(solutions.begin(), solutions.end(), [](const auto &solution) { return solution.stable(); });
}

bool all_unstable(const std::vector<PeriodicSolution> &solutions)
{
  return !solutions.empty() &&
         std::all_of(solutions.begin(), solutions.end(),
                     [](const auto &solution) { return solution.stability_is_known() && !solution.stable(); });
}

bool is_wanted(const PeriodicProblem &problem, const PeriodicRequest &request,
               const std::vector<PeriodicSolution> &solutions, const PeriodicResult &found)
{
  if (problem.interrupted() || !request.along.empty())
    return false;
  if (request.section > 0)
    return true;
  const coupling::PeriodicMethod &method  = coupling::periodic_method(found.method);
  const bool                      nothing = !found.failure.empty() && method.integrates();
  return nothing || (method.finds_all() && !lasts(solutions));
}

/// A recognised motion is a result; if it is periodic, the solution is added.
void settle_failure(const PeriodicProblem &problem, const coupling::PeriodicOptions &options, const Recurrence &motion,
                    std::vector<PeriodicSolution> &solutions, PeriodicResult &found)
{
  const std::string by_method = found.failure;
  std::string       failure;
  if (motion.repeats > 0 && !lasts(solutions))
    try
    {
      for (const PeriodicSolution &solution : repeated(problem, motion, options))
        solutions.push_back(solution);
    }
    catch (const std::runtime_error &none)
    {
      failure = none.what();
    }
  if (motion.is_recognised() || lasts(solutions))
  {
    if (!by_method.empty())
      found.notes.push_back("the method found no solution (" + by_method + "); the result is the limit of a long run" +
                            (solutions.empty() ? "" : ", refined by shooting"));
    found.failure.clear();
  }
  if (!failure.empty())
    found.notes.push_back("no periodic solution was found at the end of the long run: " + failure);
}

} // namespace

void check_long_run(const PeriodicRequest &request)
{
  if (request.section > 0 && !request.along.empty())
    throw std::invalid_argument(
        "--section applies to one solution, but --along computes many; omit one of the two options");
  if (request.section > 0 && request.section < coupling::least_section)
    throw std::invalid_argument("--section " + std::to_string(request.section) + ": too few periods; use at least " +
                                std::to_string(coupling::least_section));
}

void follow_long_run(coupling::Machine &machine, const PeriodicProblem &problem, const coupling::PeriodicGuess &start,
                     const coupling::PeriodicOptions &options, const PeriodicRequest &request,
                     const std::vector<Signal> &signals, std::vector<PeriodicSolution> &solutions,
                     PeriodicResult &found)
{
  if (request.along.empty())
    verify_stable(problem, solutions);
  constexpr int usual_periods = 256; // points of a section: its shape shows, and lines of its spectrum
  if (!is_wanted(problem, request, solutions, found))
  {
    if (all_unstable(solutions) && request.along.empty())
      found.notes.push_back("no stable solution was found; --section " + std::to_string(usual_periods) +
                            " computes the long-term behaviour");
    return;
  }
  if (const std::string why = coupling::why_not_propagated(machine, "settling"); !why.empty())
  {
    found.notes.push_back("the long-term behaviour was not computed, because it needs tangents: " +
                          why.substr(0, why.find("; --method")));
    return;
  }
  LongRun run;
  try
  {
    const int periods       = request.section > 0 ? request.section : usual_periods;
    run.motion              = recurrence_of(problem, start, options, periods);
    const bool    may_beat  = run.motion.kind == "drifting"; // more slowly than this section shows
    constexpr int once_more = 4;                             // times as many, where the motion still settles
    if ((!run.motion.is_recognised() || may_beat) && request.section == 0)
      run.motion = recurrence_of(problem, start, options, once_more * periods);
  }
  catch (const std::runtime_error &none)
  {
    found.notes.push_back(std::string("the long-term behaviour was not computed: ") + none.what());
    return;
  }
  found.work.add(run.motion.work);
  settle_failure(problem, options, run.motion, solutions, found);
  verify_stable(problem, solutions);
  for (const Signal &signal : signals)
    run.columns.push_back(signal.name + " [" + signal.unit + "]");
  run.rows = read_section(machine, problem.begin, run.motion.section, signals);
  if (run.motion.kind != "periodic") // otherwise the section is a single point
    run.planes = section_planes(machine, problem.begin, run.motion, signals);
  found.long_run = std::move(run);
}

} // namespace gestell::apps

#include "apps/session/comparison/scene_comparison.h"

#include "apps/session/comparison/shared_measures.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

MachineAt at_modes(Session &session)
{
  coupling::Machine &machine = session.machine().small();
  return {&machine, modes_configuration(session.scene(), machine)};
}

std::string names_of(const std::vector<coupling::Signal> &signals)
{
  std::string names;
  for (const coupling::Signal &signal : signals)
    names += (names.empty() ? "" : ", ") + signal.name + " [" + signal.unit + "]";
  return names.empty() ? "none" : names;
}

void require_shared_signal(Session &session, Session &other)
{
  const auto a    = scene_signals(session.scene(), session.machine().machine);
  const auto b    = scene_signals(other.scene(), other.machine().machine);
  const auto in_b = [&](const coupling::Signal &own)
  {
    return std::any_of(b.begin(), b.end(),
                       [&](const auto &his) { return his.name == own.name && his.unit == own.unit; });
  };
  if (std::none_of(a.begin(), a.end(), in_b))
    throw std::invalid_argument("--compare: \"" + session.scene().name + "\" and \"" + other.scene().name +
                                "\" have no signal of one name and unit; the first has " + names_of(a) +
                                ", the second " + names_of(b) + ": name them alike in [output.signals]");
}

std::string window_text(const coupling::RunResult &run)
{
  return std::isfinite(run.from) ? short_text(run.from, 6) + " s" : "the start of the run";
}

void add_warnings(const Result &of_other, Result &result)
{
  for (const auto &warnings : {of_other.warnings, coupling::texts_of(of_other.run->findings)})
    for (const std::string &warning : warnings)
      if (warning != of_other.run->failure)
        result.warnings.push_back(of_other.scene + ": " + warning);
  if (!of_other.run->failure.empty())
    result.warnings.push_back(of_other.scene + " stopped early: " + of_other.run->failure);
}

} // namespace

void require_comparable_runs(Session &session, Session &other)
{
  other.check_run();
  require_shared_signal(session, other);
}

void add_compared_run(Session &session, Result &result, Session &other)
{
  Result of_other = other.run();
  add_warnings(of_other, result);
  if (result.run && result.run->from != of_other.run->from)
    result.warnings.push_back("the extremes compared are of different windows: output.from of " + result.scene +
                              " is " + window_text(*result.run) + ", that of " + of_other.scene + " " +
                              window_text(*of_other.run));
  result.compared_shapes = compared_shapes(result, at_modes(session), of_other, at_modes(other));
  result.compared_run    = ComparedRun{of_other.scene, std::move(*of_other.run)};
}

void add_compared_modes(Session &session, Result &result, Session &other, const Result &of_other)
{
  const MachineAt own = at_modes(session), his = at_modes(other);
  result.compared_shapes = compared_shapes(result, own, of_other, his);
  if (!result.compared_shapes)
    throw std::invalid_argument(nothing_shared(result, own, of_other, his));
}

} // namespace gestell::apps

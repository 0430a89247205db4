#include "apps/scene/build/build_machine.h"

#include "coupling/periodic/period_search.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gestell::apps
{
namespace
{

/// [s] of loads; 0: none oscillates, or they have no common one.
double period_of_loads(const coupling::Machine &machine)
{
  std::vector<double> omega;
  for (const auto &harmonic : machine.linear().excitation().harmonics())
    omega.push_back(harmonic.omega);
  return omega.empty() ? 0. : coupling::common_period(omega);
}

/// [s] at most `longest`; 0: no rotor turns so fast.
double slowest_revolution(const coupling::Machine &machine, const coupling::InitialState &initial, double longest)
{
  double period = 0.;
  if (initial.v.size() != machine.size() || machine.superposed_frequencies().size() > 0) // modes have no angles
    return period;
  for (const coupling::Body &body : machine.model().bodies())
    if (body.kind == coupling::BodyKind::rotor)
      if (const double speed = std::abs(initial.v[body.coordinate]); speed * longest >= two_pi)
        period = std::max(period, two_pi / speed);
  return period;
}

} // namespace

double result_window(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial)
{
  const coupling::RunOptions &run = scene.run.options;
  if (!scene.run.last_period || initial.v.size() == 0) // no start was found: there is no run
    return run.from;
  const double length = run.end - run.begin;
  double       period = period_of_loads(machine);
  if (period == 0. && !machine.linear().excitation().harmonics().empty())
    throw std::invalid_argument(scene.run.place + ": output.from = \"last period\", but the loads have no common "
                                                  "period; give the time instead, as in output.from = \"1 s\"");
  if (period == 0.)
    period = slowest_revolution(machine, initial, length);
  if (period == 0.)
    throw std::invalid_argument(scene.run.place +
                                ": output.from = \"last period\", but no period is known: no load has harmonics of a "
                                "common period, and no rotor that starts with a speed completes a revolution in the "
                                "run; give the time instead, as in output.from = \"1 s\"");
  if (period > length)
    throw std::invalid_argument(scene.run.place + ": output.from = \"last period\", but the period of the loads, " +
                                short_text(period) + " s, is longer than the run of " + short_text(length) +
                                " s; give a later run.end");
  return run.end - period;
}

} // namespace gestell::apps

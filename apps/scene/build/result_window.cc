#include "apps/scene/build/result_window.h"

#include "coupling/periodic/period_search.h"
#include "coupling/simulation/checks/told_by_time.h"
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

/// The slowest rotor that completes a revolution in the run at the speed it starts with.
struct Revolution
{
  const coupling::Body *rotor = nullptr; ///< null: there is none
  double                speed = 0.;      ///< [rad/s]

  double period() const { return rotor ? two_pi / std::abs(speed) : 0.; } ///< [s]
};

Revolution slowest_revolution(const coupling::Machine &machine, const coupling::InitialState &initial, double longest)
{
  Revolution slowest;
  if (initial.v.size() != machine.size() || machine.superposed_frequencies().size() > 0) // modes have no angles
    return slowest;
  for (const coupling::Body &body : machine.model().bodies())
    if (const double speed = body.kind == coupling::BodyKind::rotor ? initial.v[body.coordinate] : 0.;
        std::abs(speed) * longest >= two_pi && (!slowest.rotor || std::abs(speed) < std::abs(slowest.speed)))
      slowest = {&body, speed};
  return slowest;
}

[[noreturn]] void refuse(const Scene &scene, const std::string &reason, const std::string &remedy)
{
  throw std::invalid_argument(scene.run.place + ": output.from = \"last period\", but " + reason + "; " + remedy);
}

const char *const give_time = "give the time instead, as in output.from = \"1 s\"";

/// Elements with explicit time dependence must be periodic: for loads at the end of the run, for a revolution, whose
/// speed is the initial one, from the start.
void require_repeating(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial,
                       double period, bool of_rotor)
{
  const coupling::RunOptions &run   = scene.run.options;
  const double                whole = std::floor((run.end - run.begin) / period);
  coupling::InitialState      at    = initial;
  at.t                              = of_rotor ? run.begin : run.end - std::min(2., whole) * period;
  const double shift                = of_rotor ? std::max(1., whole - 1.) * period : period;
  auto         names                = coupling::forces_of_time(machine, at, period, shift);
  for (const std::string &joint : coupling::motions_of_time(machine, at, period, shift))
    names.push_back(joint);
  if (!names.empty())
    refuse(scene,
           "\"" + names.front() + "\" depends on the time and does not repeat with the period of " +
               short_text(period) + " s " + (of_rotor ? "of the initial rotor speed" : "of the loads"),
           give_time);
}

} // namespace

double result_window(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial)
{
  const coupling::RunOptions &run = scene.run.options;
  if (!scene.run.last_period || initial.v.size() == 0) // without an initial state there is no run
    return run.from;
  const double length = run.end - run.begin, of_loads = period_of_loads(machine);
  if (of_loads == 0. && !machine.linear().excitation().harmonics().empty())
    refuse(scene, "the loads have no common period", give_time);
  const double period = of_loads > 0. ? of_loads : slowest_revolution(machine, initial, length).period();
  if (period == 0.)
    refuse(scene,
           "the period is unknown: no load has harmonics of a common period, no rotor with an initial speed completes "
           "a revolution in the run, and the rotation of planar bodies is not known in advance",
           give_time);
  if (period > length)
    refuse(scene,
           "the period of the loads, " + short_text(period) + " s, is longer than the run of " + short_text(length) +
               " s",
           "increase run.end");
  if (initial.v.size() == machine.size())
    require_repeating(scene, machine, initial, period, of_loads == 0.);
  return run.end - period;
}

void check_window(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial,
                  coupling::RunResult &run)
{
  const double     length  = scene.run.options.end - scene.run.options.begin;
  const Revolution slowest = slowest_revolution(machine, initial, length);
  if (!scene.run.last_period || period_of_loads(machine) > 0. || !slowest.rotor || !run.failure.empty() ||
      run.interrupted || run.end_state.size() != machine.size())
    return;
  const int        i            = slowest.rotor->coordinate;
  const double     mean         = (run.end_state[i] - initial.q[i]) / length;
  constexpr double equal_speeds = 0.01; // mean and initial speed: a window of a revolution is accurate to 4 degrees
  if (std::abs(mean - slowest.speed) <= equal_speeds * std::abs(slowest.speed))
    return;
  run.warn("result-window", "output.from",
           scene.run.place + ": output.from = \"last period\" is a revolution at the initial speed of \"" +
               slowest.rotor->name + "\", " + short_text(slowest.speed) + " rad/s, but its mean speed is " +
               short_text(mean) + " rad/s, so the window is not a revolution; " + give_time);
}

} // namespace gestell::apps

#include "apps/session/repeating_machine.h"

#include "apps/session/option_value.h"
#include "coupling/periodic/minimising.h"
#include "coupling/periodic/period_search.h"
#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "coupling/periodic/turn_increments.h"
#include "coupling/simulation/checks/told_by_time.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{
using coupling::BodyKind;
using Eigen::VectorXd;

constexpr double equal_speeds = 1e-2; ///< relative difference of speeds by elastic shafts at the start

/// Angles [rad] that may rotate and move initially: of rotors, and of planar bodies, which may also oscillate.
struct MovingAngles
{
  std::vector<int> rotors, planar;

  MovingAngles(const coupling::Machine &machine, const coupling::InitialState &start)
  {
    for (const coupling::Body &body : machine.model().bodies())
      if (body.kind == BodyKind::rotor && start.v[body.coordinate] != 0.)
        rotors.push_back(body.coordinate);
      else if (body.kind == BodyKind::planar && start.v[body.coordinate + 2] != 0.)
        planar.push_back(body.coordinate + 2);
  }

  /// Excludes planar bodies that would need many runs for a revolution.
  void leave_out_drifting(const coupling::InitialState &start, double run)
  {
    constexpr double drifting_runs = 100.; // number of runs in which a rotating body completes at least one revolution
    const auto       drifts        = [&](int i) { return std::abs(start.v[i]) * drifting_runs * run < 2. * M_PI; };
    planar.erase(std::remove_if(planar.begin(), planar.end(), drifts), planar.end());
  }
};

std::vector<double> load_frequencies(const coupling::Machine &machine)
{
  std::vector<double> omega;
  for (const auto &harmonic : machine.linear().excitation().harmonics())
    omega.push_back(harmonic.omega);
  return omega;
}

double common_period_of(const std::vector<double> &omega, const Scene &scene)
{
  if (const double period = coupling::common_period(omega); period > 0.)
    return period;
  std::ostringstream text;
  text << scene.file << ": the loads have no common period; their frequencies are";
  for (const double w : omega)
    text << ' ' << short_text(w / (2. * M_PI), 8) << " Hz";
  text << ": make them commensurate (ratios of integers up to 64), or examine the spectra of a run instead";
  throw std::invalid_argument(text.str());
}

/// Angles that may rotate, and their speeds [rad/s].
struct TurningAngles
{
  std::vector<int> angles;
  VectorXd         speed;                    ///< [n]
  double           tolerance = equal_speeds; ///< of the speeds
};

/// Rotors have their initial speeds.  A few revolutions show whether planar bodies rotate or oscillate.
TurningAngles turning_angles(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &start,
                             const std::atomic<bool> *stop)
{
  TurningAngles turning{{}, start.v};
  MovingAngles  moving(machine, start);
  if (scene.run.given)
    moving.leave_out_drifting(start, scene.run.options.end - scene.run.options.begin);
  for (const coupling::Body &body : machine.model().bodies())
    if (body.kind == BodyKind::rotor)
      turning.angles.push_back(body.coordinate);
  if (moving.planar.empty())
    return turning;
  double fastest = 0.;
  for (const auto *group : {&moving.rotors, &moving.planar})
    for (const int i : *group)
      fastest = std::max(fastest, std::abs(start.v[i]));
  constexpr double turns_tried = 3.; // revolutions of the fastest angle: linkages need two at most
  const double     time        = turns_tried * 2. * M_PI / fastest;
  const VectorXd   way =
      coupling::advance_of(machine, periodic_integration(scene, machine), {start.q, start.v, 0.}, start.t, time, stop);
  for (const int i : moving.planar)
    if (way[i] != 0.)
    {
      turning.angles.push_back(i);
      turning.speed[i]             = way[i] / time;
      constexpr double equal_turns = 5e-2; // of speeds over `turns_tried`; linkages vary within a revolution
      turning.tolerance            = equal_turns;
    }
  return turning;
}

VectorXd of_angles(const VectorXd &x, const std::vector<int> &angles)
{
  return x(angles);
}

/// Reason why rotors that move at the start count as oscillating: something depends on their angles without a period.
std::string held_angles(const coupling::AngleInvariance &invariance, const VectorXd &speed,
                        const coupling::Machine &machine)
{
  for (const coupling::AngleDependence &d : invariance.dependences())
    for (std::size_t k = 0; k < invariance.angles().size(); ++k)
      if (const int i = invariance.angles()[k]; d.turns == 0 && d.of[Eigen::Index(k)] != 0. && speed[i] != 0.)
        return "; " + machine.coordinate_name(i) + " is treated as oscillating: the force of " + d.element +
               " depends on it and is not periodic in it";
  return "";
}

std::string names_of_moving(const coupling::Machine &machine, const Eigen::MatrixXd &free)
{
  std::string names;
  for (Eigen::Index i = 0; i < free.rows(); ++i)
    if (!free.row(i).isZero(1e-9)) // of unit columns
      names += (names.empty() ? "" : ", ") + machine.coordinate_name(int(i));
  return names;
}

std::string joined(const std::vector<std::string> &names)
{
  std::string all;
  for (const std::string &name : names)
    all += (all.empty() ? "'" : ", '") + name + "'";
  return all;
}

/// Number of load periods in a given period; 1 without loads.
/// @throws std::invalid_argument if it is not an integer
int periods_of_loads(double period, const std::vector<double> &omega, const Scene &scene)
{
  if (omega.empty())
    return 1;
  const double     own = common_period_of(omega, scene), times = period / own;
  constexpr double equal_periods = 1e-9; // of loads and a period that is given: ten digits
  if (std::round(times) >= 1. && std::abs(times - std::round(times)) <= equal_periods * times)
    return int(std::round(times));
  throw std::invalid_argument(scene.file + ": --period: the loads do not repeat after " + short_text(period, 8) +
                              " s, but after " + short_text(own, 8) +
                              " s; use that or a multiple of it, or remove --period");
}

double asked_period(const PeriodicRequest &request)
{
  if (request.period.empty())
    return 0.;
  const double period = option_value("--period", request.period, kind::time);
  if (period > 0.)
    return period;
  throw std::invalid_argument("--period " + request.period + ": the period must be a positive time, such as \"0.2 s\"");
}

coupling::FreeOscillation own_oscillation(const Scene &scene, coupling::Machine &machine,
                                          const RepeatingMachine &repeating)
{
  const coupling::MethodOptions method = periodic_integration(scene, machine);
  try
  {
    return coupling::free_oscillation(machine, method, repeating.guess, repeating.problem.begin,
                                      repeating.problem.stop);
  }
  catch (const coupling::SearchInterrupted &)
  {
    throw;
  }
  catch (const coupling::NoPeriodicMotion &none)
  {
    throw std::invalid_argument(scene.file + ": " + none.what() + "; or give --period");
  }
}

/// The period and phase of what the machine does by itself.
void oscillate_freely(const Scene &scene, coupling::Machine &machine, RepeatingMachine &repeating)
{
  const coupling::FreeOscillation own     = own_oscillation(scene, machine, repeating);
  coupling::PeriodicProblem      &problem = repeating.problem;
  repeating.guess                         = own.at;
  problem.period                          = own.at.period;
  problem.phase                           = own.phase;
  problem.phase_value                     = own.phase_value;
  problem.phase_falls                     = own.falls;
  problem.free                            = coupling::without_coordinate(problem.free, own.phase);
  repeating.reason = "the machine is self-excited, so its period is unknown; a period begins where " +
                     machine.coordinate_name(own.phase) + (own.falls ? " falls" : " rises") +
                     " through the middle of its range" +
                     (own.pushed ? " (it was at rest initially and was disturbed)" : "");
}

bool is_driven(const Scene &scene, const coupling::Machine &machine)
{
  const auto &elements = machine.model().elements();
  return !scene.loads.empty() ||
         std::any_of(elements.begin(), elements.end(),
                     [](const auto &placement) { return placement.element->work() == mechanism::Work::input; });
}

/// Computes the angle that each rotating coordinate covers in the period, or the period of a revolution.
/// @return why a coordinate that moves initially does not rotate; empty: all do
std::string turn(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &start,
                 RepeatingMachine &repeating)
{
  coupling::PeriodicProblem      &problem = repeating.problem;
  const TurningAngles             turning = turning_angles(scene, machine, start, problem.stop);
  const coupling::AngleInvariance invariance(machine, turning.angles, repeating.guess, start.t);
  const coupling::AngleIncrements found =
      coupling::increments_of(invariance, turning.speed, problem.period, turning.tolerance, machine.linear());
  if (!found.refusal.empty())
    throw std::invalid_argument(
        scene.file + ": " + found.refusal +
        (problem.period > 0. ? "; load and rotation must have a common period: set --period, or change the speed"
                             : "; such a motion never repeats: examine the spectra of a run"));
  if (const std::string element = invariance.changed_by(of_angles(found.turn, turning.angles)); !element.empty())
    throw std::invalid_argument(scene.file + ": the force of " + element +
                                " does not repeat after one period, so there is no periodic solution; run the scene "
                                "and examine its spectra");
  problem.turn = found.turn;
  problem.free = found.free;
  if (!(problem.period > 0.) && found.phase >= 0)
  {
    problem.period      = found.period;
    problem.phase       = found.phase;
    problem.phase_value = start.q[found.phase];
    repeating.reason    = "the period is determined by the revolution of " + machine.coordinate_name(found.phase) +
                       (is_driven(scene, machine)
                            ? "; its mean speed follows from the balance of motor and resistance"
                            : "; it has no drive, so its speed is arbitrary: set it by --period, or add a motor");
  }
  return problem.turn.isZero(0.) ? held_angles(invariance, turning.speed, machine) : "";
}

} // namespace

coupling::MethodOptions periodic_integration(const Scene &scene, const coupling::Machine &machine)
{
  const std::string why = coupling::why_not_propagated(machine, "settling");
  if (why.empty())
    return coupling::PeriodicOptions().integration;
  if (scene.run.given)
    return scene.run.options.method;
  throw std::invalid_argument(scene.file + ": " + why +
                              ", which is integrated with the settings of [run], but there is no [run]");
}

double load_period(const Scene &scene, const coupling::Machine &machine)
{
  const std::vector<double> omega = load_frequencies(machine);
  return omega.empty() ? 0. : common_period_of(omega, scene);
}

RepeatingMachine repeating_machine(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &start,
                                   const PeriodicRequest &request, const std::atomic<bool> *stop)
{
  RepeatingMachine           repeating;
  coupling::PeriodicProblem &problem = repeating.problem;
  problem.system                     = &machine;
  problem.begin                      = start.t;
  problem.ratio                      = request.ratio;
  problem.stop                       = stop;
  repeating.guess                    = {start.q, start.v, 0.};
  problem.period                     = asked_period(request);
  const std::vector<double> omega    = load_frequencies(machine);
  if (problem.period > 0.)
  {
    problem.ratio *= periods_of_loads(problem.period, omega, scene);
    repeating.reason = "the period is given";
  }
  else if (!omega.empty())
  {
    problem.period   = common_period_of(omega, scene);
    repeating.reason = omega.size() == 1 ? "the period is that of the load" : "the period is common to all loads";
  }
  const std::string held = turn(scene, machine, start, repeating);
  const double      span = problem.period > 0. ? problem.period : 1.;
  if (const auto names = coupling::forces_of_time(machine, start, span, problem.period); !names.empty())
    throw std::invalid_argument(scene.file + ": the force of " + joined(names) + " depends on the time" +
                                (problem.period > 0.
                                     ? " and does not repeat after " + short_text(problem.period, 8) + " s"
                                     : ", which gives no period") +
                                ": set --period \"... s\", or add a load with harmonics");
  if (!(problem.period > 0.))
    oscillate_freely(scene, machine, repeating);
  repeating.reason += held;
  if (problem.has_free_shifts())
    repeating.reason += "; the angle of " + names_of_moving(machine, problem.free) +
                        " is free (no force depends on it): its increment per period is part of the solution";
  problem.period *= request.ratio;
  problem.turn *= request.ratio;
  return repeating;
}

ChosenMethod chosen_method(const RepeatingMachine &repeating, const std::string &name)
{
  const coupling::PeriodicProblem &problem = repeating.problem;
  if (!name.empty())
  {
    const coupling::PeriodicMethod &method = coupling::periodic_method(name);
    if (const std::string why = method.refuses(problem); !why.empty())
      throw std::invalid_argument("--method " + name + ": " + why);
    return {&method, "requested"};
  }
  const std::string why = coupling::shooting_method().refuses(problem);
  if (!why.empty())
    return {&coupling::settling_method(), why};
  constexpr int few_coordinates = 3; // up to which all solutions are searched by default
  if (problem.turn.size() <= few_coordinates && !problem.period_is_unknown())
    return {&coupling::minimising_method(), "few coordinates, so all solutions are searched"};
  return {&coupling::shooting_method(), "it needs few periods and gives the stability"};
}

coupling::PeriodicOptions periodic_options(const Scene &scene, const PeriodicRequest &request,
                                           const coupling::Machine &machine)
{
  coupling::PeriodicOptions options;
  options.own = request.own;
  if (request.tolerance > 0.)
    options.tolerance = request.tolerance;
  options.integration = periodic_integration(scene, machine);
  // Other methods leave larger residuals than exact propagation.
  if (!(request.tolerance > 0.) && options.integration.method != coupling::PeriodicOptions().integration.method)
    options.tolerance = std::max(1e-8, 10. * options.integration.tolerance);
  return options;
}

} // namespace gestell::apps

#include "apps/analysis/frf/response_search.h"

#include "apps/analysis/frf/measured_response.h"
#include "apps/analysis/frf/response_sweep.h"
#include "apps/session/option_value.h"
#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/modes/operating_point.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <utility>

namespace gestell::apps
{

namespace
{

void require_choice(const std::string &option, const std::string &value, const std::vector<std::string> &choices)
{
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    throw std::invalid_argument(option + " is \"" + value + "\"" + suggestion(value, choices));
}

/// The state about which the machine is linearised.
coupling::InitialState operating_state(const Scene &scene, coupling::Machine &machine, const std::string &at)
{
  if (at == "start")
    return initial_state(scene, machine);
  coupling::KnownStart known = modes_position(scene, machine);
  known.state.v.setZero();
  if (at == "equilibrium")
    try
    {
      known.state.q = coupling::held_equilibrium(machine, known).q;
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument("--at equilibrium: " + std::string(error.what()) +
                                  "; fix coordinates with [modes] at = {...}, or use --at start");
    }
  return known.state;
}

/// A signal by its path, by its name in the scene, or of a body or measure that has one.
coupling::Signal named_signal(const std::string &option, const std::string &name, const coupling::Machine &machine,
                              const std::vector<coupling::Signal> &of_scene)
{
  for (const coupling::Signal &signal : of_scene)
    if (signal.name == name)
      return signal;
  try
  {
    return machine.signal(name, name);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(option + ": " + error.what());
  }
}

/// How often an answer is differentiated: displacements and angles only.
int derivatives(const std::string &kind, const std::string &unit)
{
  if (unit != "m" && unit != "rad")
    return 0;
  return kind == "receptance" ? 0 : kind == "mobility" ? 1 : 2;
}

/// Unit of an answer per force along a displacement.
std::string response_unit(const std::string &answer, int derivatives, const std::string &displacement)
{
  const std::string per[] = {"", "/s", "/s^2"};
  return answer + per[derivatives] + (displacement == "m" ? "/N" : "/(N m)");
}

/// Vibrating modes lie within a band of this factor about them.
std::pair<double, double> default_band(const std::vector<coupling::Mode> &modes, double limit)
{
  double lowest = 0., highest = 0., fastest = 0.;
  for (const coupling::Mode &mode : modes)
    fastest = std::max(fastest, mode.frequency_hz);
  constexpr double slow = 1e-3; // of the fastest mode: a drive stabilised by weights, or a foundation
  for (const coupling::Mode &mode : modes)
    if (mode.frequency_hz > slow * fastest)
    {
      lowest  = lowest == 0. ? mode.frequency_hz : std::min(lowest, mode.frequency_hz);
      highest = std::max(highest, mode.frequency_hz);
    }
  if (highest == 0.)
    return {1., 1000.};
  highest *= 1.5;
  if (limit > 2. * lowest)
    highest = std::min(highest, limit);
  return {0.25 * lowest, highest};
}

std::vector<double> grid(double lowest, double highest, int points, bool logarithmic)
{
  std::vector<double> frequencies;
  for (int i = 0; i < points; ++i)
  {
    const double share = double(i) / (points - 1);
    frequencies.push_back(i == 0            ? lowest
                          : i == points - 1 ? highest
                          : logarithmic     ? lowest * std::pow(highest / lowest, share)
                                            : lowest + share * (highest - lowest));
  }
  return frequencies;
}

std::vector<double> asked_frequencies(const FrfOptions &options, const std::vector<coupling::Mode> &modes, double limit)
{
  auto [lowest, highest] = default_band(modes, limit);
  if (!options.lowest.empty())
    lowest = option_value("--lowest", options.lowest, kind::frequency);
  if (!options.highest.empty())
    highest = option_value("--highest", options.highest, kind::frequency);
  if (!(lowest > 0.) || !(highest > lowest) || !std::isfinite(highest))
    throw std::invalid_argument("--lowest is " + short_text(lowest) + " Hz, --highest " + short_text(highest) +
                                " Hz; both must be above zero and the highest above the lowest, such as --lowest "
                                "\"1 Hz\" --highest \"200 Hz\"");
  return grid(lowest, highest, options.points, options.spacing == "log");
}

/// "a vibration of 3.2 Hz that grows with 0.5 1/s (damping ratio -0.02)"
std::string growth_text(const std::complex<double> &s)
{
  const std::string rate = " grows at " + short_text(s.real()) + " 1/s";
  if (s.imag() == 0.)
    return "a non-oscillatory mode that" + rate;
  return "a vibration of " + short_text(s.imag() / two_pi) + " Hz that" + rate + " (damping ratio " +
         short_text(-s.real() / std::abs(s)) + ")";
}

/// Warns where the machine leaves the operating point by itself.
void warn_of_growth(const coupling::LinearResponse &linear, bool moves, std::vector<std::string> &warnings)
{
  const auto growing = linear.growing();
  if (!growing)
  {
    warnings.push_back("stability at this operating point is unknown, because the machine has too many DOFs to compute "
                       "its eigenvalues; the steady-state response exists only if the machine is stable");
    return;
  }
  if (growing->empty())
    return;
  std::string           text;
  constexpr std::size_t most_listed = 3; // motions that grow: one suffices to refuse, more are in `gestell modes`
  for (std::size_t i = 0; i < std::min(growing->size(), most_listed); ++i)
    text += (i > 0 ? ", " : "") + growth_text((*growing)[i]);
  if (growing->size() > most_listed)
    text += " and " + std::to_string(growing->size() - most_listed) + " more";
  const std::string where = moves ? "at this instant of its motion" : "at this operating point";
  warnings.push_back("the machine linearised " + where + " is unstable: " + text +
                     "; the computed steady-state response is never reached");
}

} // namespace

void check_frf_options(const FrfOptions &options)
{
  require_choice("--kind", options.kind, {"receptance", "mobility", "accelerance"});
  require_choice("--at", options.at, {"start", "equilibrium", "undeformed"});
  require_choice("--spacing", options.spacing, {"log", "linear"});
  constexpr int most_points = 1000000; // 16 MB for each pair; no chart or file is read so finely
  if (options.points < 2 || options.points > most_points)
    throw std::invalid_argument("--points is " + std::to_string(options.points) + "; it must be from 2 to " +
                                std::to_string(most_points));
  for (const auto &[option, names] : {std::pair("--from", &options.from), {"--to", &options.to}})
    if (names->empty())
      throw std::invalid_argument(std::string(option) + " is missing; name a displacement or an angle, such as " +
                                  option + " frame.crown.uz");
}

coupling::MachinePoint operating_point(const Scene &scene, coupling::Machine &machine, const std::string &at)
{
  return coupling::machine_point(machine, operating_state(scene, machine, at));
}

std::vector<NamedResponse> named_answers(const Scene &scene, const coupling::Machine &machine,
                                         const FrfOptions &options, const coupling::MachinePoint &point)
{
  const auto                 of_scene = scene_signals(scene, machine);
  std::vector<NamedResponse> answers;
  for (const std::string &to : options.to)
  {
    const coupling::Signal signal = named_signal("--to", to, machine, of_scene);
    answers.push_back(
        {coupling::linear_signal(machine, signal, point), signal.unit, derivatives(options.kind, signal.unit)});
  }
  return answers;
}

std::pair<Eigen::MatrixXd, std::vector<std::string>> named_forces(const Scene &scene, const coupling::Machine &machine,
                                                                  const FrfOptions             &options,
                                                                  const coupling::MachinePoint &point)
{
  const auto               of_scene = scene_signals(scene, machine);
  Eigen::MatrixXd          forces(machine.size(), Eigen::Index(options.from.size()));
  std::vector<std::string> units;
  for (std::size_t i = 0; i < options.from.size(); ++i)
  {
    const coupling::Signal signal = named_signal("--from", options.from[i], machine, of_scene);
    forces.col(Eigen::Index(i))   = coupling::force_along(machine, signal, point);
    units.push_back(signal.unit);
  }
  return {forces, units};
}

FrequencyResponse frequency_response_of(const Scene &scene, PreparedMachine &prepared, const FrfOptions &options,
                                        const coupling::Progress &progress, std::vector<std::string> &warnings)
{
  tell(progress, "frequency response");
  coupling::Machine           &machine = prepared.small();
  const coupling::MachinePoint point   = operating_point(scene, machine, options.at);
  for (const std::string &name : point.touching)
  {
    const bool closed = std::find(point.closed.begin(), point.closed.end(), name) != point.closed.end();
    warnings.push_back("contact \"" + name +
                       "\" just touches at the operating point, where its force has a kink; the response is computed "
                       "with the contact " +
                       (closed ? "closed" : "open") +
                       ", although real vibration opens and closes it; set a clearance above zero, add a load that "
                       "closes it, or choose another --at");
  }
  const coupling::ReducedFrame *frame = machine.model().reduced_frame();
  FrequencyResponse             response;
  response.kind            = options.kind;
  response.at              = options.at;
  response.t               = point.state.t;
  response.moves           = !point.state.v.isZero(0.);
  response.closed_contacts = point.closed;
  response.open_contacts   = point.open;
  response.logarithmic     = options.spacing == "log";
  coupling::LinearResponse linear(machine, point.point);
  warn_of_growth(linear, response.moves, warnings);
  ResponseSweep sweep(std::move(linear), coupling::dense_mass(machine).diagonal());
  const auto    answers      = named_answers(scene, machine, options, point);
  const auto [forces, along] = named_forces(scene, machine, options, point);
  for (const NamedResponse &answer : answers)
    sweep.add_answer(answer.answer, answer.derivatives);
  for (std::size_t j = 0; j < options.from.size(); ++j)
  {
    sweep.add_force(forces.col(Eigen::Index(j)));
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      const int d = answers[i].derivatives;
      response.pairs.push_back(
          {options.from[j], options.to[i], response_unit(answers[i].unit, d, along[j]), d, {}, {}});
    }
  }
  const double limit = frame && frame->frequency_limit_hz > 0. ? frame->frequency_limit_hz : std::nan("");
  const auto   modes = coupling::linearised_modes(machine, point.state.q, {point.open}, scene.modes.number);
  sweep.run(asked_frequencies(options, modes, limit), modes, response, warnings);
  response.not_condensed = sweep.not_condensed();
  response.measured      = measured_responses(options.measured, response);
  if (prepared.in_modes)
    warnings.push_back("the frequency response uses all " + std::to_string(machine.size()) +
                       " DOFs of the machine; runs use " + std::to_string(prepared.machine.size()) + " of its modes");
  else if (prepared.companion)
    warnings.push_back("the frequency response uses the reduced frame with " + std::to_string(machine.size()) +
                       " DOFs; the unreduced model has " + std::to_string(prepared.machine.size()));
  if (!std::isnan(limit) && response.frequencies_hz.back() > limit)
    warnings.push_back(
        "frequencies above " + short_text(limit) +
        " Hz exceed the frequency limit of the reduced frame; raise reduction.frequency or retain more modes");
  return response;
}

} // namespace gestell::apps

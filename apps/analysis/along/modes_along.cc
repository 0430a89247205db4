#include "apps/analysis/along/modes_along.h"

#include "apps/session/option_value.h"
#include "fem/values/available_memory.h"
#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{

namespace
{

coupling::SweptCoordinate named(const std::string &option, const coupling::Machine &machine, const std::string &name)
{
  try
  {
    return coupling::swept_coordinate(machine, name);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(option + ": " + error.what());
  }
}

void set_range(const coupling::SweptCoordinate &coordinate, const ModesOptions &options, coupling::AlongOptions &along)
{
  const bool given = !options.from.empty() || !options.to.empty();
  if (!coordinate.full_turn && (options.from.empty() || options.to.empty()))
    throw std::invalid_argument(
        "--along " + coordinate.name + " is not a full rotation; give a range, such as " +
        (coordinate.unit == "rad" ? "--from \"-20 deg\" --to \"20 deg\"" : "--from \"2.4 m\" --to \"3.1 m\""));
  const Kind &kind = coordinate.unit == "rad" ? kind::angle : kind::length;
  along.from       = options.from.empty() ? 0. : option_value("--from", options.from, kind);
  along.to         = options.to.empty() ? along.from + 2. * M_PI : option_value("--to", options.to, kind);
  if (given && options.from.empty())
    along.from = along.to - 2. * M_PI;
}

/// Initial speed of the coordinate in the scene [rad/s]; 0 if it is not an angle.
double start_speed(const coupling::SweptCoordinate &coordinate, const coupling::InitialState &start)
{
  return coordinate.full_turn && coordinate.coordinate >= 0 ? std::abs(start.v[coordinate.coordinate]) : 0.;
}

} // namespace

std::string position_text(const coupling::SweptCoordinate &coordinate, double x)
{
  return coordinate.unit == "rad" ? short_text(x * 180. / M_PI, 5) + " deg" : short_text(x, 5) + " " + coordinate.unit;
}

AlongResult modes_along_result(const Scene &scene, PreparedMachine &prepared, const ModesOptions &options,
                               const coupling::Progress &progress)
{
  coupling::Machine              &machine    = prepared.small();
  const coupling::SweptCoordinate coordinate = named("--along", machine, options.along);
  coupling::AlongOptions          along;
  AlongResult                     result;
  set_range(coordinate, options, along);
  along.positions = options.positions;
  fem::require_available("--positions " + std::to_string(options.positions) + ": the modes at each",
                         double(options.positions) * std::min(scene.modes.number, machine.size()) *
                             (sizeof(coupling::Mode) + 8. * machine.size()),
                         "Use fewer positions or fewer modes (modes.number).");
  along.configuration           = options.configuration == "undeformed" ? coupling::Configuration::undeformed
                                                                        : coupling::Configuration::equilibrium;
  along.lines                   = scene.modes.number;
  along.linearisation.open      = scene.modes.open;
  along.linearisation.geometric = options.geometric;
  for (const std::string &name : options.hold)
  {
    const coupling::SweptCoordinate held = named("--hold", machine, name);
    if (held.coordinate < 0)
      throw std::invalid_argument("--hold " + name + ": only coordinates of bodies can be fixed, such as " +
                                  machine.coordinate_name(machine.model().n_frame()));
    along.linearisation.fixed.push_back(held.coordinate);
    result.fixed += (result.fixed.empty() ? "" : ", ") + held.name;
  }
  result.orders    = options.orders;
  result.band      = option_value("--band", options.band, kind::number);
  result.geometric = along.linearisation.geometric;
  if (!(result.band > 0.) || !(result.band < 1.))
    throw std::invalid_argument("--band is " + options.band + "; it must be between 0 and 1, such as \"5 %\"");

  const coupling::InitialState start = initial_state(scene, machine);
  result.speed                       = options.speed.empty() ? start_speed(coordinate, start)
                                                             : std::abs(option_value("--speed", options.speed, kind::angular_speed));
  result.modes                       = coupling::modes_along(machine, coordinate, start, along,
                                                             [&](double share) { tell(progress, "modes along " + coordinate.name, share); });
  result.meetings = coupling::order_meetings(result.modes, result.speed / (2. * M_PI), result.orders, result.band);
  return result;
}

std::vector<std::string> along_warnings(const AlongResult &along)
{
  const coupling::SweptCoordinate &coordinate = along.modes.coordinate;
  std::vector<std::string>         warnings;
  int                              gaps = 0, undeformed = 0;
  std::string                      first_gap, first_undeformed;
  for (const coupling::ModesAt &at : along.modes.positions)
  {
    if (!at.gap.empty() && gaps++ == 0)
      first_gap = position_text(coordinate, at.x) + ": " + at.gap;
    if (!at.no_equilibrium.empty() && undeformed++ == 0)
      first_undeformed = position_text(coordinate, at.x) + ": " + at.no_equilibrium;
    constexpr double doubtful = 0.5; // modal assurance below which a line may have changed its shape for another one
    for (std::size_t i = 0; i < at.assurance.size(); ++i)
      if (at.assurance[i] < doubtful && i < at.modes.size() && at.modes[i].frequency_hz > 0.)
        warnings.push_back("line " + std::to_string(i + 1) + " is uncertain at " + position_text(coordinate, at.x) +
                           ": modal assurance criterion " + short_text(at.assurance[i], 2) +
                           "; check the mode shapes, or increase --positions");
  }
  constexpr std::size_t most_listed = 5; // lines of standard error
  if (const std::size_t more = warnings.size(); more > most_listed)
  {
    warnings.resize(most_listed);
    warnings.push_back("lines are uncertain at " + std::to_string(more - most_listed) + " further positions");
  }
  if (gaps > 0)
    warnings.insert(warnings.begin(), std::to_string(gaps) + " of " + std::to_string(along.modes.positions.size()) +
                                          " positions are omitted; first at " + first_gap);
  if (undeformed > 0)
    warnings.insert(warnings.begin(), std::to_string(undeformed) +
                                          " positions are linearised in the undeformed configuration; first at " +
                                          first_undeformed);
  return warnings;
}

} // namespace gestell::apps

#include "coupling/simulation/checks/piston_limits.h"
#include "coupling/integration/system/state_archive.h"

#include "coupling/machine/element_law.h"
#include "mechanism/elements/gas_force.h"
#include "mechanism/elements/hydraulic_cylinder.h"

#include <algorithm>
#include <sstream>

namespace gestell::coupling
{

PistonLimits::PistonLimits(const Machine &machine, const TimeIntegrator &integrator)
    : machine_(machine), integrator_(integrator)
{
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const auto add = [&](const std::string &quantity, double sign, double offset, const std::string &id,
                         const std::string &what, const std::string &advice)
    {
      Limit limit;
      limit.signal = machine.signal(quantity, placement.name + "." + quantity);
      limit.sign   = sign;
      limit.offset = offset;
      limit.object = placement.name;
      limit.id     = id;
      limit.what   = what;
      limit.advice = advice;
      limits_.push_back(limit);
    };
    const std::string end = "the piston reaches the end of its stroke";
    if (const auto *gas = law_of<mechanism::GasForce>(placement))
      add("volume", 1., -gas->least_volume(), "gas-stroke", end,
          "its force law has no end stop: add a \"stop\" there, or increase 'clearance_volume'");
    const auto *cylinder = law_of<mechanism::HydraulicCylinder>(placement);
    if (!cylinder)
      continue;
    constexpr double last_part = 0.01; // of both oil columns together: as near to an end as a piston gets
    const double     a = cylinder->lower_end(), b = cylinder->upper_end(), near = last_part * (b - a);
    for (const std::string chamber : {"a", "b"})
      add("pressure_" + chamber, 1., 0., "hydraulic-pressure",
          "the pressure in chamber " + std::string(chamber == "a" ? "A" : "B") + " falls below zero",
          "real oil cavitates, but the model allows tension: increase the pressure, or support the load");
    const std::string stop = "its force law has no end stop: add a \"stop\" there, or reduce the flow";
    add("stroke", 1., -a - near, "hydraulic-stroke", end + " on the side of chamber A", stop);
    add("stroke", -1., b - near, "hydraulic-stroke", end + " on the side of chamber B", stop);
  }
}

void PistonLimits::step()
{
  if (limits_.empty())
    return;
  const double t = integrator_.time();
  for (Limit &limit : limits_)
  {
    const double value = limit.sign * machine_.evaluate(limit.signal, none_, none_, integrator_.local()) + limit.offset;
    if (value < 0. && !limit.passed)
    {
      const double part = limit.known && limit.value > 0. ? limit.value / (limit.value - value) : 1.;
      limit.first       = limit.known ? limit.t + part * (t - limit.t) : t;
      limit.passed      = true;
    }
    limit.lowest = std::min(limit.lowest, value);
    limit.t      = t;
    limit.value  = value;
    limit.known  = true;
  }
}

void PistonLimits::finish(RunOutcome &outcome)
{
  for (const Limit &limit : limits_)
  {
    if (!limit.passed)
      continue;
    std::ostringstream text;
    text << limit.object << ": " << limit.what << " at t = " << limit.first << " s";
    if (limit.signal.unit == "Pa")
      text << ", to " << limit.lowest << " Pa at minimum";
    text << "; " << limit.advice;
    outcome.warn(limit.id, limit.object, text.str());
  }
}

void PistonLimits::exchange(StateArchive &archive)
{
  for (Limit &limit : limits_)
    archive(limit.t, limit.value, limit.known, limit.passed, limit.first, limit.lowest);
}

} // namespace gestell::coupling

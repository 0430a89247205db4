#include "mechanism/elements/gas_force.h"

#include "mechanism/require.h"

namespace gestell::mechanism
{

GasForce::GasForce(const Parameters &parameters) : parameters_(parameters)
{
  const std::string name = "gas force";
  const auto       &d    = parameters_;
  require(std::isfinite(d.area) && d.area > 0., name, "area [m^2]", d.area, "positive");
  require(std::isfinite(d.clearance_volume) && d.clearance_volume > 0., name, "clearance_volume [m^3]",
          d.clearance_volume, "positive");
  require(std::isfinite(d.dead_centre_at), name, "dead_centre_at [m]", d.dead_centre_at, "finite");
  require(std::isfinite(d.exponent) && d.exponent >= 1., name, "exponent", d.exponent, "at least 1");
  require(d.back_pressure >= 0., name, "back_pressure [Pa]", d.back_pressure, "zero or positive");
  require(d.initial_pressure > 0., name, "initial_pressure [Pa]", d.initial_pressure, "positive");
  if (!d.valves)
    return;
  require(d.valves->suction > 0., name, "suction_pressure [Pa]", d.valves->suction, "positive");
  require(d.valves->delivery > d.valves->suction, name, "delivery_pressure [Pa]", d.valves->delivery,
          "above the suction pressure, " + std::to_string(d.valves->suction) + " Pa");
  require(d.initial_pressure >= d.valves->suction && d.initial_pressure <= d.valves->delivery, name,
          "initial_pressure [Pa]", d.initial_pressure, "between the pressures of suction and delivery");
}

void GasForce::stiffest(const double *, double *K, double *) const
{
  const auto &d = parameters_;
  *K            = d.valves ? d.area * d.area * d.exponent * d.valves->delivery / d.clearance_volume : 0.;
}

void GasForce::start(const LocalMotion &motion, double *history) const
{
  const double V = volume(motion.u[0]);
  require(V > 0., "gas force", "volume at the start [m^3]", V, "positive; check 'dead_centre_at' and 'side'");
  history[0] = closed;
  history[1] = parameters_.initial_pressure * std::pow(V, parameters_.exponent);
}

double GasForce::pressure(const LocalMotion &motion, const double *history) const
{
  const double P      = enclosed(volume(motion.u[0]), history[1]);
  const Branch branch = motion.by_history ? branch_of(history) : branch_at(P);
  return branch == closed ? P : line(branch);
}

/// With an open valve the gas that is in the cylinder changes.
void GasForce::accept(const LocalMotion &motion, double *history) const
{
  if (!parameters_.valves || (motion.by_history && branch_of(history) == closed))
    return;
  history[1] = pressure(motion, history) * std::pow(volume(motion.u[0]), parameters_.exponent);
}

double GasForce::stored_with_valves(double P) const
{
  const double n = parameters_.exponent, P_s = parameters_.valves->suction;
  const double at_suction = P_s * std::pow(P / P_s, 1. / n); // P_s V_s/V
  return (n > 1. ? (P - at_suction) / (n - 1.) : P * std::log(P / P_s)) - at_suction;
}

double GasForce::stored_energy(const LocalMotion &motion, const double *history) const
{
  const double V = volume(motion.u[0]), n = parameters_.exponent, K = history[1];
  if (parameters_.valves)
    return (stored_with_valves(pressure(motion, history)) + parameters_.back_pressure) * V;
  return (n > 1. ? K * std::pow(V, 1. - n) / (n - 1.) : -K * std::log(V)) + parameters_.back_pressure * V;
}

double GasForce::stored_power(const LocalMotion &motion, const double *history) const
{
  const bool delivers = parameters_.valves && pressure(motion, history) == parameters_.valves->delivery;
  if (delivers && (!motion.by_history || branch_of(history) == delivery))
    return (stored_with_valves(parameters_.valves->delivery) + parameters_.back_pressure) * side() * parameters_.area *
           motion.v[0];
  return resistance(motion, history) * motion.v[0];
}

int GasForce::n_guards(const double *history) const
{
  return !parameters_.valves ? 0 : branch_of(history) == closed ? 2 : 1;
}

std::vector<Guard> GasForce::guards(const double *history) const
{
  if (!parameters_.valves)
    return {};
  if (branch_of(history) == closed)
    return {{"delivery_opens", Crossing::rising}, {"suction_opens", Crossing::falling}};
  if (branch_of(history) == delivery)
    return {{"delivery_closes", Crossing::rising}};
  return {{"suction_closes", Crossing::falling}};
}

void GasForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  if (!parameters_.valves)
    return;
  if (branch_of(history) != closed)
  {
    g[0] = side() * motion.v[0];
    return;
  }
  const double P = enclosed(volume(motion.u[0]), history[1]);
  g[0]           = P - parameters_.valves->delivery;
  g[1]           = P - parameters_.valves->suction;
}

void GasForce::transition(int i, const LocalMotion &motion, double *history) const
{
  if (branch_of(history) == closed)
    history[0] = i == 0 ? delivery : suction;
  else
  {
    history[1] = line(branch_of(history)) * std::pow(volume(motion.u[0]), parameters_.exponent);
    history[0] = closed;
  }
}

std::vector<Quantity> GasForce::quantities() const
{
  return {{"force", "N"}, {"pressure", "Pa"}, {"volume", "m^3"}};
}

double GasForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? -resistance(motion, history) : i == 1 ? pressure(motion, history) : volume(motion.u[0]);
}

} // namespace gestell::mechanism

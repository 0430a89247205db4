#include "mechanism/elements/hydraulic_cylinder.h"

#include "mechanism/require.h"

namespace gestell::mechanism
{

HydraulicCylinder::HydraulicCylinder(const Parameters &parameters) : parameters_(parameters)
{
  const std::string name     = "hydraulic cylinder";
  const auto        positive = [&](const std::string &what, double value)
  { require(std::isfinite(value) && value > 0., name, what, value, "positive"); };
  positive("area_a [m^2]", parameters.area_a);
  positive("area_b [m^2]", parameters.area_b);
  positive("volume_a [m^3]", parameters.volume_a);
  positive("volume_b [m^3]", parameters.volume_b);
  positive("bulk_modulus [Pa]", parameters.bulk_modulus);
  require(parameters.leakage >= 0., name, "leakage [m^3/(s Pa)]", parameters.leakage, "zero or positive");
  if (parameters.control == Control::flow)
    return;
  positive("rated_flow [m^3/s]", parameters.rated_flow);
  positive("rated_drop [Pa]", parameters.rated_drop);
  require(parameters.supply > parameters.tank, name, "supply_pressure [Pa]", parameters.supply,
          "above that of the tank, " + std::to_string(parameters.tank));
  for (const double level : parameters.course.levels())
    require(std::abs(level) <= 1., name, "opening of the valve", level, "from -1 to 1");
}

void HydraulicCylinder::engaged(const double *u, double *K, double *) const
{
  const auto  &P   = parameters_;
  const double L_a = P.volume_a / P.area_a, L_b = P.volume_b / P.area_b;
  const double x = u[0] - P.zero;
  K[0]           = P.bulk_modulus * (P.area_a / (L_a + x) + P.area_b / (L_b - x));
}

void HydraulicCylinder::start(const LocalMotion &motion, double *history) const
{
  parameters_.course.start(motion.t, history);
}

int HydraulicCylinder::n_guards(const double *history) const
{
  return parameters_.course.n_guards(history);
}

std::vector<Guard> HydraulicCylinder::guards(const double *history) const
{
  return parameters_.course.guards(history);
}

void HydraulicCylinder::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  parameters_.course.guard_values(motion.t, history, g);
}

void HydraulicCylinder::transition(int i, const LocalMotion &motion, double *history) const
{
  parameters_.course.transition(i, motion.t, history);
}

bool HydraulicCylinder::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  return parameters_.course.command(order, motion.t, history);
}

void HydraulicCylinder::check_order(const SwitchCommand &order) const
{
  if (order.name == "set" && parameters_.control == Control::valve)
    require(std::abs(order.level) <= 1., "hydraulic cylinder", "opening of the valve", order.level, "from -1 to 1");
}

std::vector<Quantity> HydraulicCylinder::quantities() const
{
  return {{"force", "N"}, {"pressure_a", "Pa"}, {"pressure_b", "Pa"}, {"flow", "m^3/s"}, {"stroke", "m"}};
}

double HydraulicCylinder::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const double *u = motion.u, x = u[0] - parameters_.zero;
  if (i == 4)
    return x;
  const auto c = chambers<double>(x, u[1], u[2], course(motion.t, motion.by_history, history));
  return i == 1 ? c.p_a : i == 2 ? c.p_b : i == 3 ? c.q_a : parameters_.area_a * c.p_a - parameters_.area_b * c.p_b;
}

} // namespace gestell::mechanism

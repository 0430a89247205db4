#include "tests/random_machines/laws.h"

namespace gestell::tests
{
namespace
{
void motor_keys(Draft &draft, const Link &link)
{
  lossy(draft);
  nonlinear(draft);
  const double ratio = draft.number("ratio", draft.dice.log_between(1., 50.));
  draft.number("breakdown_torque", link.scale.force() * draft.dice.log_between(0.1, 1.) / ratio);
  draft.number("breakdown_slip", draft.dice.log_between(0.05, 0.5));
  draft.number("synchronous_speed", ratio * link.scale.speed() * draft.dice.log_between(0.1, 1.));
}

} // namespace

void add_blanking(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "sheet", "blanking force");
  lossy(draft);
  nonlinear(draft);
  const double thickness = draft.number("thickness", link.scale.length * draft.dice.log_between(0.1, 1.)),
               force     = link.scale.force() * draft.dice.log_between(0.02, 0.5);
  const double cut       = draft.number("cut_length", 0.1);
  draft.number("shear_resistance", force / (cut * thickness));
  draft.number("rise_exponent", 4.);
  draft.number("elastic_stiffness", 4. * force / (0.35 * thickness) * draft.dice.between(1.05, 3.));
  draft.number("contact_at", link.scale.length * draft.dice.between(0.05, 0.5));
  draft.watch(name + ".force");
  draft.watch(name + ".penetration");
  draft.watch(name + ".largest_penetration");
}

void add_cutting(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "cut", "cutting force");
  lossy(draft);
  nonlinear(draft);
  draft.number("peak_force", link.scale.force() * draft.dice.log_between(0.02, 0.5));
  draft.number("peak_penetration", link.scale.length * draft.dice.log_between(0.1, 0.5));
  draft.number("contact_at", link.scale.length * draft.dice.between(0., 0.5));
  draft.number("speed", link.scale.speed() * draft.dice.log_between(0.01, 0.3));
  draft.watch(name + ".force");
  draft.machine.passive = false; // smooth in speed, it pushes a tool that turns back
}

void add_drawing(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "drawn", "drawing force");
  lossy(draft);
  nonlinear(draft);
  const double force = draft.number("force", link.scale.force() * draft.dice.log_between(0.02, 0.5));
  draft.number("stiffness", link.scale.stiffness() * draft.dice.log_between(1., 30.));
  draft.number("contact_at", link.scale.length * draft.dice.between(0., 0.5));
  if (draft.dice.chance(0.5))
    draft.number("depth", link.scale.length * draft.dice.between(0.3, 1.) + force / link.scale.stiffness());
  draft.watch(name + ".force");
}

void add_gas(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "gas", "gas force");
  nonlinear(draft);
  const double area = draft.number("area", 0.01), length = link.scale.length;
  const double pressure = link.scale.force() * draft.dice.log_between(0.1, 2.) / area;
  draft.number("clearance_volume", area * length * draft.dice.between(2., 5.));
  draft.number("dead_centre_at", -length * draft.dice.between(2., 4.));
  draft.number("back_pressure", pressure);
  if (draft.dice.chance(0.5))
    draft.number("initial_pressure", pressure * draft.dice.between(0.8, 1.2));
  else
  {
    lossy(draft);
    draft.machine.passive = false; // the lines may drive the piston
    draft.number("suction_pressure", pressure * draft.dice.between(0.8, 0.99));
    draft.number("delivery_pressure", pressure * draft.dice.between(1.01, 1.3));
  }
  draft.watch(name + ".force");
  draft.watch(name + ".pressure", pressure);
}

void add_motor(Draft &draft, const Link &link)
{
  const std::string name = begin_motor(draft, link, "asynchronous motor");
  motor_keys(draft, link);
  draft.watch(name + ".torque");
}

void add_dynamic_motor(Draft &draft, const Link &link)
{
  const std::string name = begin_motor(draft, link, "dynamic motor");
  motor_keys(draft, link);
  draft.machine.bdf_only = true;
  draft.number("time_constant", draft.dice.log_between(0.1, 3.) / link.scale.omega);
  draft.watch(name + ".torque");
}

void add_speed_drive(Draft &draft, const Link &link)
{
  const std::string name = begin_motor(draft, link, "speed drive");
  const double      time = 2. * M_PI / link.scale.omega;
  lossy(draft);
  nonlinear(draft);
  draft.machine.bdf_only = true;
  const double gain      = draft.number("proportional_gain", link.scale.damping() * draft.dice.log_between(0.03, 3.));
  if (draft.dice.chance(0.7))
    draft.number("integral_gain", gain * link.scale.omega * draft.dice.log_between(0.1, 3.));
  if (draft.dice.chance(0.4))
    draft.number("largest_torque", link.scale.force() * draft.dice.log_between(0.3, 3.));
  const double speed = link.scale.speed() * draft.dice.log_between(0.05, 1.);
  draft.line(
      "speed = [{ at = " + digits(0.2 * time) + ", to = " + digits(speed) +
      (draft.dice.chance(0.7) ? ", acceleration = " + digits(speed / time * draft.dice.log_between(1., 10.)) : "") +
      " }]");
  draft.watch(name + ".torque");
  draft.watch(name + ".wanted_speed");
}

/// Between supply and tank, with columns of 60 motions, so that oil is hardly compressed; both are a spring of c.
void add_cylinder(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "cylinder", "hydraulic cylinder");
  lossy(draft);
  nonlinear(draft);
  draft.machine.bdf_only = true;
  draft.machine.passive  = false;
  const double c = link.scale.stiffness() * draft.dice.log_between(1., 20.), L = 60. * link.scale.length,
               end = 3. * 2. * M_PI / link.scale.omega;
  const double A = draft.number("area_a", 0.01), B = draft.number("area_b", 0.01 * draft.dice.between(0.5, 1.));
  draft.number("volume_a", A * L);
  draft.number("volume_b", B * L);
  const double K = draft.number("bulk_modulus", c * L / (2. * A)), p = draft.number("pressure_a", 0.1 * K);
  draft.number("pressure_b", p * A / B);
  draft.number("supply_pressure", 0.2 * K * A / B);
  draft.number("tank_pressure", 0.02 * K);
  draft.number("rated_flow", A * link.scale.speed() * draft.dice.log_between(0.01, 0.1));
  draft.number("rated_drop", 0.05 * K);
  if (draft.dice.chance(0.5))
    draft.number("leakage", A * A / link.scale.damping() * draft.dice.log_between(0.01, 1.));
  draft.line("valve = [{ at = " + digits(draft.dice.between(0., 0.4) * end) +
             ", to = " + digits(draft.dice.between(-1., 1.)) +
             (draft.dice.chance(0.7) ? ", rate = \"" + digits(10. / end) + "/s\"" : "") +
             " }, { at = " + digits(draft.dice.between(0.7, 0.9) * end) + ", to = 0 }]");
  draft.watch(name + ".force");
  draft.watch(name + ".pressure_a", p);
  draft.watch(name + ".pressure_b", p * A / B);
}

} // namespace gestell::tests

#include "tests/random_machines/twin_laws.h"

#include "tests/random_machines/laws.h"

#include <algorithm>
#include <cmath>

namespace gestell::tests
{
namespace
{

using Force = std::function<double(double t, double u, double v)>;

std::string with_unit(const Link &link, double value, const char *straight, const char *turning)
{
  return digits(value) + " " + (link.turns ? turning : straight);
}

/// When a law is off, by switches of the time.
struct Pause
{
  double from = 0., to = 0.;
  bool   none() const { return from == to; }
  bool   off(double t) const { return t >= from && t < to; }
};

void write_switch(Draft &draft, const std::string &element, const char *order, double t)
{
  draft.table("switch." + draft.new_name("switch"));
  draft.text("when", "t");
  draft.number("above", t);
  draft.text("tell", element);
  draft.text("order", order);
}

/// Switches that turn the element off, and some back on.
Pause pause(Draft &draft, Twin &twin, const std::string &element)
{
  if (!draft.dice.chance(0.25))
    return {};
  lossy(draft);
  nonlinear(draft);
  const double end = draft.machine.end;
  Pause        pause{rounded(end * draft.dice.between(0.1, 0.6)), 2. * end};
  write_switch(draft, element, "off", pause.from);
  twin.add_break(pause.from);
  if (draft.dice.chance(0.5))
  {
    pause.to = rounded(end * draft.dice.between(0.65, 0.95));
    write_switch(draft, element, "on", pause.to);
    twin.add_break(pause.to);
  }
  return pause;
}

void add_paused(Draft &draft, Twin &twin, const TwinLink &on, const std::string &element, Force force)
{
  const Pause pause = tests::pause(draft, twin, element);
  twin.add_force(on.u, [pause, force = std::move(force)](double t, double u, double v)
                 { return pause.off(t) ? 0. : force(t, u, v); });
}

void cubic(Draft &draft, Twin &twin, const TwinLink &on)
{
  const Scale      &scale = on.link.scale;
  const std::string name  = begin_element(draft, on.link, "hard", "cubic spring");
  const double      c     = scale.stiffness() * draft.dice.log_between(0.1, 3.);
  nonlinear(draft);
  // About zero: of a distance it is a spring of no length.
  const double c3 = draft.number("cubic", c / std::pow(scale.length + std::abs(on.rest), 2)),
               c1 = draft.number("stiffness", 0.3 * c);
  add_paused(draft, twin, on, name, [=](double, double u, double) { return -(c1 + c3 * u * u) * u; });
}

void formula(Draft &draft, Twin &twin, const TwinLink &on)
{
  const Scale      &scale = on.link.scale;
  const std::string name  = begin_element(draft, on.link, "formula", "formula force");
  const double      F = rounded(scale.force() * draft.dice.log_between(0.1, 1.)), L = rounded(scale.length),
               V = rounded(scale.speed()), u_0 = rounded(on.rest),
               w           = rounded(scale.omega * draft.dice.log_between(0.3, 3.));
  const std::string F_text = "(" + with_unit(on.link, F, "N", "N m") + ")",
                    L_text = "(" + with_unit(on.link, L, "m", "rad") + ")",
                    V_text = "(" + with_unit(on.link, V, "m/s", "rad/s") + ")",
                    x      = "((u - (" + with_unit(on.link, u_0, "m", "rad") + "))/" + L_text + ")",
                    w_text = "(" + digits(w) + " rad/s)";
  lossy(draft);
  nonlinear(draft);
  Force       force;
  std::string text;
  switch (draft.dice.whole(3))
  {
  case 0:
    text  = "-" + F_text + "*sin(" + x + ") + " + F_text + "*sin(" + w_text + "*t)";
    force = [=](double t, double u, double) { return -F * std::sin((u - u_0) / L) + F * std::sin(w * t); };
    break;
  case 1:
    text  = "-" + F_text + "*tanh(v/" + V_text + ")*(1 + " + x + "^2)";
    force = [=](double, double u, double v) { return -F * std::tanh(v / V) * (1. + std::pow((u - u_0) / L, 2)); };
    break;
  default:
    text  = F_text + "*exp(-" + w_text + "*t) - " + F_text + "*" + x + "^3";
    force = [=](double t, double u, double) { return F * std::exp(-w * t) - F * std::pow((u - u_0) / L, 3); };
  }
  draft.text("force", text);
  add_paused(draft, twin, on, name, force);
}

void load(Draft &draft, Twin &twin, const TwinLink &on)
{
  const Scale      &scale = on.link.scale;
  const std::string name  = begin_element(draft, on.link, "load", "force");
  draft.machine.loadless  = false;
  lossy(draft);
  const double constant =
                   draft.number("constant", scale.force() * draft.dice.sign() * draft.dice.log_between(0.05, 0.5)),
               amplitude = rounded(scale.force() * draft.dice.log_between(0.05, 1.)),
               frequency = rounded(scale.omega / (2. * M_PI) * draft.dice.log_between(0.2, 4.)),
               phase     = rounded(draft.dice.between(0., 6.));
  draft.line("harmonics = [{ amplitude = " + digits(amplitude) + ", frequency = " + digits(frequency) +
             ", phase = " + digits(phase) + " }]");
  add_paused(draft, twin, on, name,
             [=](double t, double, double)
             { return constant + amplitude * std::sin(2. * M_PI * frequency * t + phase); });
}

void drag(Draft &draft, Twin &twin, const TwinLink &on)
{
  const std::string name = begin_element(draft, on.link, "drag", "friction");
  lossy(draft);
  nonlinear(draft);
  const double F   = draft.number("force", on.link.scale.force() * draft.dice.log_between(0.02, 0.5)),
               v_0 = draft.number("speed", on.link.scale.speed() * draft.dice.log_between(0.1, 1.));
  add_paused(draft, twin, on, name, [=](double, double, double v) { return -F * std::tanh(v / v_0); });
}

/// Two oil columns about u = rest, fed by a flow that may jump once.
void cylinder(Draft &draft, Twin &twin, const TwinLink &on)
{
  const Scale      &scale = on.link.scale;
  const std::string name  = begin_element(draft, on.link, "cylinder", "hydraulic cylinder");
  lossy(draft);
  nonlinear(draft);
  draft.machine.passive  = false;
  draft.machine.bdf_only = true;
  Dice &dice             = draft.dice;
  // Columns of 60 motions, of 180 where a body turns all the way round, so that oil is hardly compressed; both are a
  // spring of c.
  const double c = scale.stiffness() * dice.log_between(1., 20.), L = (on.link.on_measure ? 180. : 60.) * scale.length;
  const double A = draft.number("area_a", 0.01), B = draft.number("area_b", 0.01 * dice.between(0.5, 1.)),
               V_a = draft.number("volume_a", A * L * dice.between(1., 2.)),
               V_b = draft.number("volume_b", B * L * dice.between(1., 2.)),
               K = draft.number("bulk_modulus", c * L / (2. * A)), u_0 = draft.number("zero_at", on.rest),
               p_0 = draft.number("pressure_a", 0.1 * K), p_1 = draft.number("pressure_b", 0.1 * K * A / B),
               k_L = dice.chance(0.5) ? draft.number("leakage", A * A / scale.damping() * dice.log_between(0.01, 1.))
                                      : 0.;
  const double Q   = rounded(A * scale.speed() * dice.sign() * dice.log_between(0.01, 0.3)),
               at  = rounded(draft.machine.end * dice.between(0.2, 0.5));
  draft.line("flow = [{ at = " + digits(at) + ", to = " + digits(Q) + " }]");
  twin.add_break(at);
  draft.watch(name + ".pressure_a", p_0);
  draft.watch(name + ".pressure_b", p_1);
  const double x = twin.at_start(on.u).v - u_0;
  twin.add_law({on.u},
               [=](const Twin::Seen &seen, double *F, double *dz)
               {
                 const double x = seen.u[0] - u_0, flow = seen.t < at ? 0. : Q, leaking = k_L * (seen.z[0] - seen.z[1]);
                 F[0]  = A * seen.z[0] - B * seen.z[1];
                 dz[0] = K / (V_a + A * x) * (flow - leaking - A * seen.v[0]);
                 dz[1] = K / (V_b - B * x) * (-flow * B / A + leaking + B * seen.v[0]);
               },
               // closed until then: what the described pressures have become where the machine starts
               {p_0 - K * std::log1p(A * x / V_a), p_1 - K * std::log1p(-B * x / V_b)}, {0.1 * K, 0.1 * K});
}

struct Motor
{
  double ratio, M_K, s_K, w_s;
  /// After Kloss.
  double torque(double v) const
  {
    const double s = 1. - ratio * v / w_s;
    return ratio * 2. * M_K * s * s_K / (s * s + s_K * s_K);
  }
};

Motor motor(Draft &draft, const Scale &scale)
{
  Motor m;
  m.ratio = draft.number("ratio", draft.dice.log_between(1., 50.));
  m.M_K   = draft.number("breakdown_torque", scale.force() * draft.dice.log_between(0.1, 1.) / m.ratio);
  m.s_K   = draft.number("breakdown_slip", draft.dice.log_between(0.05, 0.5));
  m.w_s   = draft.number("synchronous_speed", m.ratio * scale.speed() * draft.dice.log_between(0.3, 2.));
  return m;
}

} // namespace

void add_twin_spring(Draft &draft, Twin &twin, const TwinLink &on, double stiffness, double damping_ratio)
{
  const std::string name = begin_element(draft, on.link, "spring", "spring-damper");
  const double      c = draft.number("stiffness", stiffness), rest = draft.number("rest", on.rest);
  double            b = 0.;
  if (damping_ratio > 0.)
  {
    lossy(draft);
    b = draft.number("damping", 2. * damping_ratio * std::sqrt(stiffness * on.link.scale.mass));
  }
  // Always on: it is what holds the motion of a body.
  twin.add_force(on.u, [=](double, double u, double v) { return -c * (u - rest) - b * v; });
}

void add_twin_law(Draft &draft, Twin &twin, const TwinLink &on)
{
  switch (draft.dice.whole(on.link.turns ? 5 : 7))
  {
  case 0:
    return cubic(draft, twin, on);
  case 1:
    return formula(draft, twin, on);
  case 2:
    return load(draft, twin, on);
  case 3:
    return drag(draft, twin, on);
  case 4:
    return add_twin_spring(draft, twin, on, on.link.scale.stiffness() * draft.dice.log_between(0.1, 10.),
                           draft.dice.chance(0.3) ? 0. : draft.dice.log_between(0.01, 0.3));
  default:
    return cylinder(draft, twin, on);
  }
}

void add_twin_drive(Draft &draft, Twin &twin, const TwinLink &on)
{
  const Scale             &scale   = on.link.scale;
  const int                kind    = draft.dice.whole(3);
  static const char *const kinds[] = {"asynchronous motor", "dynamic motor", "speed drive"};
  const std::string        name    = begin_motor(draft, on.link, kinds[kind]);
  lossy(draft);
  nonlinear(draft);
  draft.machine.passive = false;
  draft.watch(name + ".torque", scale.force());
  if (kind == 0)
  {
    const Motor m = motor(draft, scale);
    add_paused(draft, twin, on, name, [=](double, double, double v) { return m.torque(v); });
    return;
  }
  draft.machine.bdf_only = true;
  if (kind == 1)
  {
    const Motor  m = motor(draft, scale);
    const double T = draft.number("time_constant", draft.dice.log_between(0.1, 3.) / scale.omega);
    twin.add_law({on.u},
                 [=](const Twin::Seen &seen, double *F, double *dz)
                 {
                   F[0]  = seen.z[0];
                   dz[0] = (m.torque(seen.v[0]) - seen.z[0]) / T;
                 },
                 {0.}, {scale.force()});
    return;
  }
  const double k_p   = draft.number("proportional_gain", scale.damping() * draft.dice.log_between(0.03, 3.)),
               k_i   = draft.number("integral_gain", k_p * scale.omega * draft.dice.log_between(0.1, 3.)),
               speed = rounded(scale.speed() * draft.dice.log_between(0.05, 1.)), w = rounded(scale.omega);
  draft.text("speed", digits(speed) + " rad/s*(1 - exp(-(" + digits(w) + " 1/s)*t))");
  twin.add_law({on.u},
               [=](const Twin::Seen &seen, double *F, double *dz)
               {
                 const double error = speed * (1. - std::exp(-w * seen.t)) - seen.v[0];
                 F[0]               = k_p * error + seen.z[0];
                 dz[0]              = k_i * error;
               },
               {0.}, {scale.force()});
}

void add_twin_follower(Draft &draft, Twin &twin, const Scale &scale, const std::string &entries, Twin::Measure x,
                       Twin::Measure z, Twin::Measure phi)
{
  Dice        &dice  = draft.dice;
  const double angle = dice.between(0., 2. * M_PI), e_x = std::cos(angle), e_z = std::sin(angle);
  char         direction[96];
  std::snprintf(direction, sizeof direction, "direction = [%.17g, 0, %.17g]", e_x, e_z);
  Link link;
  link.entries           = entries + direction + "\n";
  draft.machine.passive  = false;
  draft.machine.loadless = false;
  lossy(draft);
  nonlinear(draft);
  std::function<double(double)> P;
  if (dice.chance(0.5))
  {
    begin_element(draft, link, "thrust", "force");
    const double constant  = draft.number("constant", scale.force() * dice.sign() * dice.log_between(0.1, 1.)),
                 amplitude = rounded(scale.force() * dice.log_between(0.05, 0.5)),
                 frequency = rounded(scale.omega / (2. * M_PI) * dice.log_between(0.3, 3.));
    draft.line("harmonics = [{ amplitude = " + digits(amplitude) + ", frequency = " + digits(frequency) + " }]");
    P = [=](double t) { return constant + amplitude * std::sin(2. * M_PI * frequency * t); };
  }
  else
  {
    begin_element(draft, link, "thrust", "force profile");
    const double force = rounded(scale.force() * dice.sign() * dice.log_between(0.1, 1.)),
                 w     = rounded(scale.omega * dice.log_between(0.3, 3.));
    draft.line("profile = { function = \"" + digits(force) + " N*(1 - cos(" + digits(w) + " rad/s*t))\" }");
    P = [=](double t) { return force * (1. - std::cos(w * t)); };
  }
  twin.add_law({std::move(x), std::move(z), std::move(phi)},
               [=](const Twin::Seen &seen, double *F, double *)
               {
                 const double c = std::cos(seen.u[2]), s = std::sin(seen.u[2]), force = P(seen.t);
                 F[0] = force * (e_x * c + e_z * s);
                 F[1] = force * (e_z * c - e_x * s);
               });
}

Prescribed prescribed_motion(Draft &draft, Twin &twin, const Scale &scale)
{
  Dice        &dice = draft.dice;
  const double w = rounded(scale.omega * dice.log_between(0.3, 2.)), L = rounded(scale.length * dice.between(0.2, 1.)),
               v           = rounded(scale.speed() * dice.sign() * dice.between(0.2, 1.));
  const std::string L_text = digits(L) + " rad", w_text = "(" + digits(w) + " rad/s)";
  switch (dice.whole(4))
  {
  case 0:
    return {"{ speed = " + digits(v) + " }", [=](const Jet *, const Jet &t) { return v * t; }};
  case 1:
    return {"{ function = \"" + L_text + "*sin(" + w_text + "*t)\" }",
            [=](const Jet *, const Jet &t) { return L * sin(w * t); }};
  case 2:
    return {"{ function = \"" + L_text + "*(1 - cos(" + w_text + "*t))\" }",
            [=](const Jet *, const Jet &t) { return L * (Jet(1.) - cos(w * t)); }};
  default:
    break;
  }
  // From rest to the speed v at a constant acceleration.
  const double a     = rounded(std::abs(v) * scale.omega * dice.log_between(0.3, 3.)),
               begin = rounded(draft.machine.end * dice.between(0.05, 0.4)), lasts = std::abs(v) / a;
  twin.add_break(begin);
  twin.add_break(begin + lasts);
  return {"{ speed = [{ at = " + digits(begin) + ", to = " + digits(v) + ", acceleration = " + digits(a) + " }] }",
          [=](const Jet *, const Jet &t)
          {
            const Jet since = t - Jet(begin);
            return since.v < 0.      ? Jet(0.)
                   : since.v < lasts ? 0.5 * std::copysign(a, v) * since * since
                                     : v * (since - Jet(0.5 * lasts));
          }};
}

} // namespace gestell::tests

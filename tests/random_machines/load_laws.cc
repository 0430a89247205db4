#include "tests/random_machines/laws.h"

#include <iterator>

namespace gestell::tests
{
namespace
{
/// A number with its unit: of lengths and angles, of forces and torques.
std::string force_text(const Link &link, double value)
{
  return digits(value) + (link.turns ? " N m" : " N");
}
std::string motion_text(const Link &link, double value)
{
  return digits(value) + (link.turns ? " rad" : " m");
}
std::string speed_text(const Link &link, double value)
{
  return digits(value) + (link.turns ? " rad/s" : " m/s");
}

} // namespace

void add_force(Draft &draft, const Link &link)
{
  const std::string name  = begin_element(draft, link, "load", "force");
  const double      force = link.scale.force(), frequency = link.scale.omega / (2. * M_PI);
  draft.machine.loadless     = false;
  draft.machine.conservative = false; // its potential is counted among the stored energy, but not watched here
  if (draft.dice.chance(0.5))
    draft.number("constant", force * draft.dice.sign() * draft.dice.log_between(0.05, 1.));
  std::string harmonics;
  for (int i = 0, n = 1 + draft.dice.whole(2); i < n; ++i)
    harmonics += std::string(i ? ", " : "") + "{ amplitude = " + digits(force * draft.dice.log_between(0.05, 1.)) +
                 ", frequency = " + digits(frequency * draft.dice.log_between(0.2, 4.)) +
                 ", phase = " + digits(draft.dice.between(0., 6.)) + " }";
  draft.line("harmonics = [" + harmonics + "]");
}

void add_cubic_spring(Draft &draft, const Link &link)
{
  begin_element(draft, link, "hard", "cubic spring");
  nonlinear(draft);
  const double stiffness = link.scale.stiffness() * draft.dice.log_between(0.1, 3.);
  draft.number("cubic", stiffness / (link.scale.length * link.scale.length));
  if (draft.dice.chance(0.5))
    draft.number("stiffness", stiffness * draft.dice.between(0., 1.));
}

void add_formula(Draft &draft, const Link &link)
{
  begin_element(draft, link, "formula", "formula force");
  lossy(draft);
  nonlinear(draft);
  const Scale      &scale = link.scale;
  const double      size  = draft.dice.log_between(0.1, 2.);
  const std::string F = force_text(link, scale.force() * size), L = motion_text(link, scale.length),
                    V          = speed_text(link, scale.speed()),
                    gap        = motion_text(link, scale.length * draft.dice.between(-0.3, 0.6)),
                    omega      = digits(scale.omega * draft.dice.log_between(0.3, 3.)) + " rad/s";
  const std::string formulas[] = {"-(" + F + ")*(u/(" + L + ") + (u/(" + L + "))^3)",
                                  "-(" + F + ")*max((u - " + gap + ")/(" + L + "), 0)",
                                  "-(" + F + ")*if(u > " + gap + ", (u - " + gap + ")/(" + L + "), 0)",
                                  "(" + F + ")*sin(" + omega + "*t)",
                                  "-(" + F + ")*v*abs(v)/(" + V + ")^2",
                                  "-(" + F + ")*tanh(v/(0.1*" + V + "))*step(u - " + gap + ")",
                                  "(" + F + ")*min(1, t*" + omega + ")",
                                  "(" + F + ")*exp(-t*" + omega + ") - (" + F + ")*sin(u/(" + L + "))"};
  draft.text("force", formulas[draft.dice.whole(int(std::size(formulas)))]);
}

void add_table_force(Draft &draft, const Link &link)
{
  static const char *const kinds[] = {"time", "displacement", "rate"};
  const int                kind    = draft.dice.whole(3);
  const double x_scale = kind == 0 ? 2. * M_PI / link.scale.omega : kind == 1 ? link.scale.length : link.scale.speed();
  begin_element(draft, link, "table", "table force");
  nonlinear(draft);
  if (kind != 1)
    lossy(draft);
  draft.text("against", kinds[kind]);
  double      x = kind == 0 ? 0. : -x_scale, F = link.scale.force() * draft.dice.between(0., 0.5);
  std::string rows;
  for (int i = 0, n = 2 + draft.dice.whole(5); i < n; ++i)
  {
    rows += (i ? ", [" : "[") + digits(x) + ", " + digits(F) + "]";
    // resists: falls as the rate or the displacement rises; over the time any value
    const double change = link.scale.force() * draft.dice.between(0., 0.6);
    F                   = kind == 0 ? change * draft.dice.sign() : F - change;
    const bool jumps    = kind != 2 && i % 3 == 1 && draft.dice.chance(0.5);
    if (!jumps)
      x += x_scale * draft.dice.between(0.1, 1.);
  }
  draft.line("table = [" + rows + "]");
}

void add_profile(Draft &draft, const Link &link)
{
  begin_element(draft, link, "course", "force profile");
  lossy(draft);
  nonlinear(draft);
  const double force = link.scale.force(), time = 2. * M_PI / link.scale.omega;
  double       at = draft.dice.between(0., 0.5) * time;
  std::string  ramps;
  for (int i = 0, n = 1 + draft.dice.whole(3); i < n; ++i)
  {
    const double rate = 2. * force / time * draft.dice.log_between(1., 20.);
    const int    kind = draft.dice.whole(3);
    ramps += (i ? ", { at = " : "{ at = ") + digits(at) + ", to = " + digits(force * draft.dice.between(-0.5, 0.5));
    if (kind > 0)
      ramps += ", rate = " + digits(rate);
    if (kind > 1)
      ramps += ", rate_of_rate = " + digits(rate * 10. / time);
    ramps += " }";
    at += time * (1.2 + draft.dice.share());
  }
  draft.line("profile = [" + ramps + "]");
}

} // namespace gestell::tests

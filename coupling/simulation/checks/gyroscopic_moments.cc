#include "coupling/simulation/checks/gyroscopic_moments.h"

#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// w [n] of the rotation about e.
Eigen::VectorXd rotation_about(const Machine &machine, const Marker &marker, const Vector3 &e)
{
  Eigen::VectorXd w = Eigen::VectorXd::Zero(machine.size());
  for (int d = 0; d < 3; ++d)
    for (const auto &[coordinate, weight] : marker.rotation[d])
      w[coordinate] += e[d] * weight;
  return w;
}

} // namespace

void check_tilting_rotors(const Machine &machine, const Eigen::VectorXd &v, RunOutcome &outcome)
{
  if (machine.model().full_frame())
    return; // to factorise that would take longer than many a run
  for (const Body &body : machine.model().bodies())
  {
    const double speed = body.kind == BodyKind::rotor ? std::abs(v[body.coordinate]) : 0.;
    const auto [a, b]  = plane_across(body.axis);
    Eigen::VectorXd w_a, w_b;
    if (speed > 0.)
    {
      w_a = rotation_about(machine, body.marker, a);
      w_b = rotation_about(machine, body.marker, b);
    }
    if (!(speed > 0.) || w_a.isZero() || w_b.isZero())
      continue;
    const auto      solver = machine.linear().factorise(speed * speed, 0., 1.);
    Eigen::VectorXd unit   = Eigen::VectorXd::Unit(machine.size(), body.coordinate), column(machine.size());
    machine.linear().mass_times(unit, column);
    const auto flexibility = [&](const Eigen::VectorXd &w)
    {
      Eigen::VectorXd x(machine.size());
      solver->solve(w, x);
      return w.dot(x);
    };
    const double kappa =
        column[body.coordinate] * speed * speed * std::sqrt(std::max(0., flexibility(w_a) * flexibility(w_b)));
    // kappa: 2 % of the moments that keep the axis, twice the error of reduced frames
    constexpr double considerable = 0.02;
    if (!(kappa > considerable))
      continue;
    std::ostringstream text;
    text.precision(2);
    text << "the carrier of the rotor " << body.name
         << " tilts, but a rotor has no gyroscopic moments; at its speed they would be " << 100. * kappa
         << " % of the moments on its axis. If this is relevant, use a body of type \"rigid\" in revolute joints";
    outcome.warn("gyroscopic-moments", body.name, text.str());
  }
}

} // namespace gestell::coupling

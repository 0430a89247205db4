#pragma once

#include "mechanism/facets.h"

#include <Eigen/Core>

namespace gestell::tests
{

/// A motion of an element's measures that owns its numbers.
struct Probe
{
  double          t = 0.;
  Eigen::VectorXd u, v, a;

  mechanism::LocalMotion motion(bool by_history = false, const double *p = nullptr) const
  {
    return {t, u.data(), v.data(), a.data(), p, by_history};
  }

  /// The motion of constant acceleration through this one, dt later.
  Probe moved(double dt) const { return {t + dt, u + dt * v + 0.5 * dt * dt * a, v + dt * a, a}; }
};

inline Probe probe1(double u, double v, double a = 0.)
{
  return {0.3, Eigen::VectorXd::Constant(1, u), Eigen::VectorXd::Constant(1, v), Eigen::VectorXd::Constant(1, a)};
}

inline Eigen::VectorXd force(const mechanism::ForceLaw &element, const Probe &probe, const double *history,
                             bool by_history = false)
{
  Eigen::VectorXd p(element.n_measures());
  element.force(probe.motion(by_history), history, p.data());
  return p;
}

/// Value of a guard, turned so that it is open while negative and due when it has become positive.  p: force of a
/// branch that holds.
inline double past(const mechanism::Element &element, int guard, const Probe &probe, const double *history,
                   const double *p = nullptr)
{
  const auto      guards = element.branches()->guards(history);
  Eigen::VectorXd g(guards.size());
  element.branches()->guard_values(probe.motion(true, p), history, g.data());
  return guards[guard].crossing == mechanism::Crossing::rising ? g[guard] : -g[guard];
}

/// History of a motion that starts at the probe.
inline Eigen::VectorXd started(const mechanism::Element &element, const Probe &probe)
{
  const std::vector<double> history = mechanism::started(element, probe.motion());
  return Eigen::Map<const Eigen::VectorXd>(history.data(), Eigen::Index(history.size()));
}

} // namespace gestell::tests

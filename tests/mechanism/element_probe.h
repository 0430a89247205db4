#pragma once

#include "mechanism/force_element.h"

#include <Eigen/Core>

namespace gestell::tests
{

/// A motion of an element's measures that owns its numbers.
struct Probe
{
  double          t = 0.;
  Eigen::VectorXd u, v, a;

  mechanism::LocalMotion motion() const { return {t, u.data(), v.data(), a.data()}; }
};

inline Eigen::VectorXd force(const mechanism::ForceElement &element, const Probe &probe, const double *history)
{
  Eigen::VectorXd p(element.n_measures());
  element.force(probe.motion(), history, p.data());
  return p;
}

/// History of a motion that starts at the probe.
inline Eigen::VectorXd started(const mechanism::ForceElement &element, const Probe &probe)
{
  Eigen::VectorXd history = Eigen::VectorXd::Zero(element.n_history() + 1);
  element.start(probe.motion(), history.data());
  return history;
}

} // namespace gestell::tests

#include "coupling/integration/step/load_breakpoints.h"

#include <cmath>

namespace gestell::coupling
{

namespace
{

/// f_t + W p at t, for the initial measures.
class Loads
{
public:
  Loads(const SecondOrderSystem &system, const LocalState &at)
      : system_(system), state_(at), begin_(Eigen::VectorXd::Zero(system.linear().size())), f_(begin_)
  {
    state_.p.setZero();
    load(at.t, begin_);
  }

  const Eigen::VectorXd &change(double t)
  {
    load(t, f_);
    f_ -= begin_;
    return f_;
  }

private:
  void load(double t, Eigen::VectorXd &f)
  {
    state_.t = t;
    system_.linear().excitation().at(t, f);
    system_.forces().force(state_, state_.p);
    f.noalias() += system_.forces().directions() * state_.p;
  }

  const SecondOrderSystem &system_;
  LocalState               state_;
  Eigen::VectorXd          begin_, f_;
};

} // namespace

LoadedMotion load_breakpoints(const SecondOrderSystem &system, const LocalState &at, double end)
{
  constexpr int instants = 64; // a load that acts only between two of them is missed
  const double  tau      = (end - at.t) / instants;
  if (!(tau > 0.) || !std::isfinite(tau))
    return {};
  Loads           loads(system, at);
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(system.linear().size());
  for (int k = 1; k <= instants; ++k)
    largest = largest.cwiseMax(loads.change(at.t + k * tau).cwiseAbs());
  if (!largest.allFinite() || largest.isZero(0.))
    return {};

  const Eigen::VectorXd inverse = largest.unaryExpr([](double f) { return f > 0. ? 1. / f : 0.; });
  double                most    = 0.;
  Eigen::VectorXd       f(system.linear().size()), x(f), product(f);
  for (int k = 1; k <= instants; ++k)
    if (const double size = loads.change(at.t + k * tau).cwiseProduct(inverse).squaredNorm(); size > most)
    {
      most = size;
      f    = loads.change(at.t + k * tau);
    }
  f *= tau * tau;
  system.linear().factorise(1., tau, tau * tau)->solve(f, x);
  system.linear().mass_times(x, product);
  const double energy = x.dot(product);
  if (!std::isfinite(energy) || !(energy > 0.))
    return {};
  return {std::sqrt(energy), std::sqrt(energy) / tau};
}

} // namespace gestell::coupling

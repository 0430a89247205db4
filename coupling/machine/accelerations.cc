#include "coupling/machine/accelerations.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

[[noreturn]] void refuse_singular(const SecondOrderSystem &system)
{
  const auto     &lags = system.linear().virtual_coordinates();
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.linear().size()), column = unit;
  std::string     massless = "a combination of coordinates";
  for (int i = 0; i < system.linear().size(); ++i)
  {
    unit[i] = 1.;
    system.linear().mass_times(unit, column);
    unit[i] = 0.;
    if (column.isZero(0.) && std::find(lags.begin(), lags.end(), i) == lags.end())
    {
      massless = "\"" + system.linear().coordinate_name(i) + "\"";
      break;
    }
  }
  throw std::invalid_argument(
      "accelerations are undefined for this machine: " + massless +
      " has no mass; give it a mass, or remove accelerations and forces of supports and cuts from output.signals");
}

} // namespace

Accelerations::Accelerations(const SecondOrderSystem &system) : system_(system)
{
  for (Eigen::VectorXd *x : {&f_, &product_, &a_})
    x->setZero(system.linear().size());
  p_.setZero(system.forces().directions().cols());
  try
  {
    mass_ = system.linear().factorise(1., 0., 0.);
  }
  catch (const std::invalid_argument &)
  {
    refuse_singular(system);
  }
  f_.setOnes();
  mass_->solve(f_, a_);
  if (!a_.allFinite()) // of a solver without a check of its own
    refuse_singular(system);
}

const Eigen::VectorXd &Accelerations::at(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const LocalState &local)
{
  p_ = local.p;
  system_.forces().force(local, p_);
  system_.linear().excitation().at(local.t, f_);
  f_.noalias() += system_.forces().directions() * p_;
  system_.linear().damping_times(v, product_);
  f_ -= product_;
  system_.linear().stiffness_times(q, product_);
  f_ -= product_;
  for (const int i : system_.linear().virtual_coordinates())
    f_[i] = 0.;
  mass_->solve(f_, a_);
  return a_;
}

const Eigen::VectorXd &Accelerations::at(double t, const TimeIntegrator &integrator, const LocalState &local,
                                         Eigen::VectorXd &q, Eigen::VectorXd &v)
{
  if (t != integrator.time())
    integrator.interpolate(t, q, v);
  else
  {
    const Instant &now = integrator.instant();
    q                  = now.q;
    v                  = now.v;
  }
  return at(q, v, local);
}

} // namespace gestell::coupling

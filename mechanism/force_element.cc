#include "mechanism/force_element.h"

#include <algorithm>
#include <cassert>

namespace gestell::mechanism
{

void ForceElement::derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                               double *dp_dv) const
{
  tangent(motion, history, {1., 0., 0.}, p, dp_du);
  tangent(motion, history, {0., 1., 0.}, p, dp_dv);
}

bool ForceElement::holds(const double *, double &) const
{
  return false;
}

void ForceElement::no_structure(double *K, double *D) const
{
  const int k = n_measures();
  std::fill_n(K, k * k, 0.);
  std::fill_n(D, k * k, 0.);
}

void ForceElement::engaged(const double *, double *K, double *D) const
{
  no_structure(K, D);
}

bool ForceElement::closure(const double *, const double *, double &, double *, double &) const
{
  return false;
}

double ForceElement::stored_energy(const LocalMotion &, const double *) const
{
  return 0.;
}

double ForceElement::stored_power(const LocalMotion &, const double *) const
{
  return 0.;
}

std::vector<Guard> ForceElement::guards(const double *) const
{
  return {};
}

void ForceElement::guard_values(const LocalMotion &, const double *, double *) const {}

void ForceElement::transition(int, const LocalMotion &, double *) const {}

double ForceElement::resistance(const LocalMotion &motion, const double *history) const
{
  assert(n_measures() == 1);
  double p;
  force(motion, history, &p);
  return -p;
}

void ForceElement::geometric(const LocalMotion &, const double *, double *K) const
{
  std::fill(K, K + n_measures() * n_measures(), 0.);
}

void ForceElement::constraint(const LocalMotion &, const double *, double *, double *) const {}

void ForceElement::constraint_rates(const LocalMotion &, const double *, double *, double *) const {}

bool ForceElement::command(const SwitchCommand &, const LocalMotion &, double *) const
{
  return false;
}

} // namespace gestell::mechanism

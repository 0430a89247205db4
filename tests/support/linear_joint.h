#pragma once

#include "mechanism/facets.h"

#include <utility>
#include <vector>

namespace gestell::tests
{

/// An ideal joint sum g_i u_i = 0: gears on sliders.
class LinearJoint final : public mechanism::Constraint
{
public:
  explicit LinearJoint(std::vector<double> ratios) : ratios_(std::move(ratios)) {}

  int  n_measures() const override { return int(ratios_.size()); }
  int  n_constraints() const override { return 1; }
  void constraint(const mechanism::LocalMotion &motion, const double *, double *g, double *G) const override
  {
    *g = 0.;
    for (std::size_t i = 0; i < ratios_.size(); ++i)
      *g += (G[i] = ratios_[i]) * motion.u[i];
  }
  void constraint_rates(const mechanism::LocalMotion &, const double *, double *rate, double *bias) const override
  {
    *rate = *bias = 0.;
  }
  std::vector<mechanism::Quantity> quantities() const override { return {}; }
  double quantity(int, const mechanism::LocalMotion &, const double *) const override { return 0.; }

private:
  std::vector<double> ratios_;
};

} // namespace gestell::tests

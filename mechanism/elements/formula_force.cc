#include "mechanism/elements/formula_force.h"

#include "mechanism/require.h"

#include <cmath>
#include <limits>

namespace gestell::mechanism
{

FormulaForce::FormulaForce(const Parameters &parameters) : parameters_(parameters)
{
  require(parameters.force.n_variables() <= n_variables, "formula force", "number of variables",
          parameters.force.n_variables(), "3 or fewer: time, displacement, rate");
}

// --- as structure

void FormulaForce::derivatives_at(double u, const double *sides, double &K, double &D) const
{
  using Direction     = Eigen::Vector2d;
  const Dual<2> x[]   = {Dual<2>(0.), Dual<2>(u, Direction::UnitX()), Dual<2>(0., Direction::UnitY())};
  const Dual<2> force = parameters_.force.value(x, sides);
  K                   = -force.derivatives()[0];
  D                   = -force.derivatives()[1];
}

void FormulaForce::engaged(const double *u, double *K, double *D) const
{
  derivatives_at(*u, nullptr, *K, *D);
}

/// Chooses the side of each kink, one after the other, for which K or D is largest or smallest.
void FormulaForce::extreme(bool largest, double u, double &K, double &D) const
{
  const double zero = 0., sign = largest ? 1. : -1.;
  const int    n = n_kinks();
  for (const bool damping : {false, true})
  {
    double sides[Formula::max_kinks + 1], both[2];
    start({0., &u, &zero, &zero}, sides);
    derivatives_at(u, sides, both[0], both[1]);
    double best = both[damping];
    for (int i = 0; i < n; ++i)
    {
      sides[i] = -sides[i];
      derivatives_at(u, sides, both[0], both[1]);
      if (sign * both[damping] > sign * best)
        best = both[damping];
      else
        sides[i] = -sides[i];
    }
    (damping ? D : K) = best;
  }
}

void FormulaForce::stiffest(const double *u, double *K, double *D) const
{
  extreme(true, *u, *K, *D);
}

void FormulaForce::open_branch(const double *u, double *K, double *D) const
{
  extreme(false, *u, *K, *D);
}

// --- kinks

void FormulaForce::start(const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]}, rates[] = {1., motion.v[0], motion.a[0]};
  kinks().start(x, rates, history);
  history[n_kinks()] = 0.;
}

void FormulaForce::accept(const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  if (std::isnan(parameters_.force.value(x)))
    history[n_kinks()] = std::numeric_limits<double>::quiet_NaN();
}

void FormulaForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  kinks().guard_values(x, history, g);
}

void FormulaForce::transition(int i, const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]}, rates[] = {1., motion.v[0], motion.a[0]};
  kinks().transition(i, x, rates, history);
}

// --- quantities

std::vector<Quantity> FormulaForce::quantities() const
{
  if (parameters_.along == Along::angle)
    return {{"torque", "N m"}, {"angle", "rad"}, {"rate", "rad/s"}};
  return {{"force", "N"}, {"displacement", "m"}, {"rate", "m/s"}};
}

double FormulaForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? -resistance(motion, history) : i == 1 ? motion.u[0] : motion.v[0];
}

} // namespace gestell::mechanism

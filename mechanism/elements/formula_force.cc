#include "mechanism/elements/formula_force.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::mechanism
{
namespace
{

constexpr double at_rest = std::numeric_limits<double>::quiet_NaN(); ///< argument of a kink that was not passed

} // namespace

FormulaForce::FormulaForce(const Parameters &parameters) : parameters_(parameters)
{
  require(parameters.force.n_variables() <= n_variables, "formula force", "number of variables",
          parameters.force.n_variables(), "3 or fewer: time, displacement, rate");
}

// --- as structure

void FormulaForce::structure(double u, const double *sides, double &K, double &D) const
{
  using Direction     = Eigen::Vector2d;
  const Dual<2> x[]   = {Dual<2>(0.), Dual<2>(u, Direction::UnitX()), Dual<2>(0., Direction::UnitY())};
  const Dual<2> force = parameters_.force.value(x, sides);
  K                   = -force.derivatives()[0];
  D                   = -force.derivatives()[1];
}

void FormulaForce::engaged(const double *u, double *K, double *D) const
{
  structure(*u, nullptr, *K, *D);
}

void FormulaForce::stiffest(const double *u, double *K, double *D) const
{
  const double zero = 0.;
  const int    n    = n_kinks();
  for (const bool damping : {false, true})
  {
    double sides[Formula::max_kinks + 1], stiffness, rate;
    start({0., u, &zero, &zero}, sides);
    structure(*u, sides, stiffness, rate);
    double &largest = damping ? rate : stiffness;
    for (int i = 0; i < n; ++i)
    {
      const double before = largest;
      double       other[2];
      sides[i] = -sides[i];
      structure(*u, sides, other[0], other[1]);
      if (other[damping] > before)
        largest = other[damping];
      else
        sides[i] = -sides[i];
    }
    (damping ? *D : *K) = largest;
  }
}

// --- kinks

/// Sets the sides of all kinks on the way through the formula that are not settled, in its order: the argument of a
/// kink may depend on the kinks before it.
void FormulaForce::settle(const LocalMotion &motion, Kinks settled, double *history) const
{
  const int n       = n_kinks();
  using Direction   = Eigen::Matrix<double, 1, 1>;
  const Dual<1> x[] = {Dual<1>(motion.t, Direction(1.)), Dual<1>(motion.u[0], Direction(motion.v[0])),
                       Dual<1>(motion.v[0], Direction(motion.a[0]))};
  for (bool changed = n > 0; changed;)
  {
    Dual<1> arguments[Formula::max_kinks];
    std::fill_n(arguments, n, Dual<1>(at_rest));
    parameters_.force.kink_arguments(x, history, arguments);
    changed = false;
    for (int i = 0; i < n && !changed; ++i)
    {
      const double argument = arguments[i].value(), rate = arguments[i].derivatives()[0];
      if (settled[i] || std::isnan(argument))
        continue;
      const double side = argument > 0. || (argument == 0. && rate >= 0.) ? 1. : -1.; // where it goes, if at zero
      changed           = side != history[i];
      history[i]        = side;
      settled.set(i);
    }
  }
}

void FormulaForce::start(const LocalMotion &motion, double *history) const
{
  if (n_kinks() == 0)
    return;
  std::fill_n(history, n_kinks(), 1.);
  history[n_kinks()] = 0.;
  settle(motion, Kinks(), history);
}

void FormulaForce::accept(const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  if (n_kinks() > 0 && std::isnan(parameters_.force.value(x)))
    history[n_kinks()] = std::numeric_limits<double>::quiet_NaN();
}

std::vector<Guard> FormulaForce::guards(const double *history) const
{
  std::vector<Guard> guards;
  for (int i = 0; i < n_kinks(); ++i)
  {
    const bool        above = history[i] > 0.;
    const std::string name  = parameters_.force.kinks()[i] + "_" + std::to_string(i + 1);
    guards.push_back({name + (above ? "_falls" : "_rises"), above ? Crossing::falling : Crossing::rising});
  }
  return guards;
}

void FormulaForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  std::copy_n(history, n_kinks(), g); // the side itself: kinks at rest are open
  parameters_.force.kink_arguments(x, history, g);
}

/// The kink itself changes sides; kinks that were at rest behind it may come into play.
void FormulaForce::transition(int i, const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  double       arguments[Formula::max_kinks];
  std::fill_n(arguments, n_kinks(), at_rest);
  parameters_.force.kink_arguments(x, history, arguments);
  Kinks in_play;
  for (int k = 0; k < n_kinks(); ++k)
    in_play[k] = !std::isnan(arguments[k]);
  in_play.set(i);
  history[i] = -history[i];
  settle(motion, in_play, history);
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

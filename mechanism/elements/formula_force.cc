#include "mechanism/elements/formula_force.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::mechanism
{
namespace
{

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// Share of the time that is one instant: events are located to 1e-11 of a step, and no step is longer than all of it.
constexpr double instant = 1e-9;

enum BehindSides ///< of the history
{
  validity,
  last_u,
  left_zero
};

/// Friction holds u, and the argument of a kink rests at zero.
bool is_held(const LocalMotion &motion, const double *sides, int n_kinks)
{
  return motion.v[0] == 0. && std::find(sides, sides + n_kinks, 0.) != sides + n_kinks;
}

} // namespace

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

/// Each kink in turn on the side where K, or D, is larger, or smaller.
void FormulaForce::extreme(bool largest, double u, double &K, double &D) const
{
  const double zero = 0., sign = largest ? 1. : -1.;
  const int    n = n_kinks();
  for (const bool damping : {false, true})
  {
    double sides[Formula::max_kinks + 3], both[2];
    start({0., &u, &zero, &zero}, sides);
    std::replace(sides, sides + n, 0., 1.);
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
  history[n_kinks() + validity]  = 0.;
  history[n_kinks() + last_u]    = motion.u[0];
  history[n_kinks() + left_zero] = -unbounded;
}

/// A side that was left for zero and is come back to in one instant stays: the value there pushes the motion off, and
/// that of the side pushes it back, as that of dry friction does.
void FormulaForce::accept(const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]}, held[] = {1., motion.v[0], 0.};
  double      &left = history[n_kinks() + left_zero];
  if (std::isnan(parameters_.force.value(x)))
    history[n_kinks() + validity] = std::numeric_limits<double>::quiet_NaN();
  if (!is_held(motion, history, n_kinks()))
    history[n_kinks() + last_u] = motion.u[0];
  if (!kinks().is_at_zero(x, held, history))
    left = left == unbounded ? -unbounded : left;
  else if (motion.t - left <= instant * std::abs(motion.t))
    left = unbounded;
  else
    kinks().rest(x, held, history);
}

/// Rounding of u moves no argument that rests where u is held.
void FormulaForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  kinks().guard_values(x, history, g);
  if (!is_held(motion, history, n_kinks()))
    return;
  const double at_rest[] = {motion.t, history[n_kinks() + last_u], motion.v[0]};
  double       own[2 * Formula::max_kinks];
  kinks().guard_values(at_rest, history, own);
  for (int i = 0; i < n_kinks(); ++i)
    if (history[i] == 0.)
      std::copy_n(own + 2 * i, 2, g + 2 * i);
}

void FormulaForce::transition(int i, const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]}, rates[] = {1., motion.v[0], motion.a[0]};
  if (history[i / 2] == 0.)
    history[n_kinks() + left_zero] = motion.t;
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

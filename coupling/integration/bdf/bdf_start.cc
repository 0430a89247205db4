#include "coupling/integration/bdf/bdf.h"

#include <sstream>
#include <vector>

namespace gestell::coupling
{

namespace
{
[[noreturn]] void fail_divided(const ConvergenceFailure &reason, int halvings, double step)
{
  std::ostringstream message;
  message << reason.what() << "; the step was halved " << halvings << " times, to " << step << " s";
  throw ConvergenceFailure(message.str(), reason.id(), reason.place());
}
} // namespace

/// Implicit Euler; the prediction is that of a constant rate.
void Bdf::euler_step(const Point &from, double length, Point &to)
{
  const Point *points[] = {&from};
  local_.u              = from.u + length * from.u_rate;
  if (implicit_.is_sparse())
    to.q = from.q + length * from.v;
  load(from.t + length);
  formula_step(1, points, from.t + length, length, to);
}

void Bdf::divided_step(const Point &from, double length, int halvings, Point &to)
{
  const double half   = 0.5 * length;
  const Point  start  = from;
  Point        middle = from;
  for (int part = 0; part < 2; ++part)
  {
    const Point *begin = part == 0 ? &start : &middle;
    Point       &end   = part == 0 ? middle : to;
    const Point  base  = *begin;
    try
    {
      euler_step(base, half, end);
    }
    catch (const ConvergenceFailure &failure)
    {
      if (halvings == options_.max_halvings)
        fail_divided(failure, halvings, half);
      ++work_.rejected;
      divided_step(base, half, halvings + 1, end);
    }
  }
}

void Bdf::euler_chain(const Point &from, double length, int n, Point &to)
{
  Point        base = from;
  const double step = length / n;
  for (int i = 0; i < n; ++i)
  {
    try
    {
      euler_step(base, step, to);
    }
    catch (const ConvergenceFailure &)
    {
      ++work_.rejected;
      divided_step(base, step, 1, to);
    }
    base = to;
  }
}

void Bdf::start_value(double t)
{
  // One order more for BDF 2: after an event the acceleration may start at zero (slip from rest), and then the
  // displacement of the first step consists of local error.
  const int          order = options_.order == 2 ? 3 : options_.order;
  const double       h     = options_.step;
  std::vector<Point> table(order, past(0)); // Neville's table, newest column in place
  for (int j = 0; j < order; ++j)
  {
    euler_chain(past(0), h, j + 1, table[j]);
    for (int k = j - 1; k >= 0; --k)
    {
      // table[k] becomes the value of order j - k + 1 from the chains k + 1 .. j + 1
      const double weight = 1. / (static_cast<double>(j + 1) / (k + 1) - 1.);
      const auto   refine = [&](Eigen::VectorXd Point::*x)
      { table[k].*x = table[k + 1].*x + weight * (table[k + 1].*x - table[k].*x); };
      for (auto x : {&Point::q, &Point::v, &Point::w, &Point::u, &Point::u_rate, &Point::a, &Point::p, &Point::lambda})
        refine(x);
    }
  }
  push();
  past(0)   = table[0];
  past(0).t = t;
  if (is_implied())
    find_implied(past(0));
  present(past(0));
}

} // namespace gestell::coupling

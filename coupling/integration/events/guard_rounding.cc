#include "coupling/integration/events/guard_rounding.h"

#include <cmath>
#include <limits>

namespace gestell::coupling
{

double guard_rounding(const SecondOrderSystem &system, const TimeIntegrator &integrator, int guard,
                      const LocalState &at, double h)
{
  const EventSystem &events = system.events();
  const double       eps    = std::numeric_limits<double>::epsilon();
  const double       share  = std::sqrt(eps); // of each term: the quotient of a difference keeps half of its digits
  Eigen::VectorXd    values(events.n_guards());
  LocalState         moved = at;
  const auto         value = [&]
  {
    events.guard_values(moved, values);
    return values[guard];
  };
  const double here = value();
  for (Eigen::VectorXd *found : {&moved.a, &moved.p, &moved.lambda})
    found->array() += 1.;
  if (value() != here)
    return std::numeric_limits<double>::infinity();

  Eigen::VectorXd q(system.linear().size()), v(system.linear().size());
  integrator.interpolate(integrator.step_begin(), q, v);
  const Eigen::SparseMatrix<double> W      = system.forces().directions().cwiseAbs();
  Eigen::VectorXd                   size_u = W.transpose() * q.cwiseAbs();
  const Eigen::VectorXd             size_v = W.transpose() * (v.cwiseAbs() + q.cwiseAbs() / h);
  for (const ForceBlock &block : system.forces().blocks())
    size_u.segment(block.first_measure, block.n_measures).array() += block.size;

  double     sum   = 0.;
  const auto moves = [&](double &x, double size)
  {
    const double own = x;
    x += share * size;
    sum += std::abs(value() - here);
    x = own;
  };
  for (Eigen::Index j = 0; j < size_u.size(); ++j)
  {
    moves(moved.u[j], size_u[j]);
    moves(moved.v[j], size_v[j]);
  }
  moves(moved.t, std::abs(at.t));
  // A sum of a few terms, its value in an element, and the difference from a threshold.
  constexpr double roundings = 16.;
  return roundings * eps / share * sum;
}

std::vector<std::string> guard_owners(const EventSystem &events)
{
  std::vector<std::string> names;
  for (int i = 0; i < events.n_guards(); ++i)
    names.push_back(events.guard(i).name);
  return names;
}

} // namespace gestell::coupling

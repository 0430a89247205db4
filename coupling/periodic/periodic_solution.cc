#include "coupling/periodic/periodic_solution.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

void FourierSeries::at(double t, Eigen::VectorXd &q, Eigen::VectorXd &v, Eigen::VectorXd &a) const
{
  q = cosine.col(0) + (t - begin) * ramp;
  v = ramp;
  a.setZero(q.size());
  for (int h = 1; h <= harmonics(); ++h)
  {
    const double w = h * omega, c = std::cos(w * t), s = std::sin(w * t);
    q += c * cosine.col(h) + s * sine.col(h);
    v += w * (c * sine.col(h) - s * cosine.col(h));
    a -= w * w * (c * cosine.col(h) + s * sine.col(h));
  }
}

void PeriodicWork::add(const PeriodicWork &other)
{
  iterations += other.iterations;
  periods += other.periods;
  integration.steps += other.integration.steps;
  integration.rejected += other.integration.rejected;
  integration.newton += other.integration.newton;
  integration.factorisations += other.integration.factorisations;
  integration.solves += other.integration.solves;
  integration.evaluations += other.integration.evaluations;
}

double PeriodicSolution::largest_multiplier() const
{
  if (!stability_is_known())
    return std::numeric_limits<double>::quiet_NaN();
  Eigen::Index trivial = -1;
  if (trivial_multiplier)
    (multipliers.array() - 1.).abs().minCoeff(&trivial);
  double largest = 0.;
  for (Eigen::Index i = 0; i < multipliers.size(); ++i)
    if (i != trivial)
      largest = std::max(largest, std::abs(multipliers[i]));
  return largest;
}

double closing_error(const Eigen::VectorXd &dq, const Eigen::VectorXd &dv, double omega, double fastest)
{
  const double F = dq.squaredNorm() * omega * omega + dv.squaredNorm();
  return F == 0. ? 0. : std::sqrt(F) / fastest;
}

Eigen::VectorXcd largest_first(Eigen::VectorXcd multipliers)
{
  std::sort(multipliers.data(), multipliers.data() + multipliers.size(),
            [](const auto &a, const auto &b)
            { return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag(); });
  return multipliers;
}

} // namespace gestell::coupling

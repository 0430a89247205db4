#include "coupling/simulation/checks/element_scales.h"

#include "mechanism/facets.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

double ElementScale::frequency_hz() const
{
  return mass > 0. && stiffness > 0. ? std::sqrt(stiffness / mass) / (2. * M_PI) : 0.;
}

double ElementScale::ratio() const
{
  return mass > 0. && stiffness > 0. ? 0.5 * damping / std::sqrt(stiffness * mass) : 0.;
}

double mass_on(const Machine &machine, const Measure &w)
{
  Eigen::VectorXd x         = Eigen::VectorXd::Zero(machine.size()), y(machine.size());
  double          lightness = 0.;
  for (const auto &[coordinate, weight] : w)
  {
    x[coordinate] = 1.;
    machine.linear().mass_times(x, y);
    x[coordinate] = 0.;
    if (y[coordinate] > 0. && weight != 0.)
      lightness += weight * weight / y[coordinate];
  }
  return lightness > 0. ? 1. / lightness : 0.;
}

std::vector<ElementScale> element_scales(const Machine &machine, const Eigen::VectorXd &q)
{
  std::vector<ElementScale> scales;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int n = placement.element->n_measures();
    if (!placement.element->force_law())
      continue;
    Eigen::VectorXd u = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < n; ++i)
      for (const auto &[coordinate, weight] : placement.measures[std::size_t(i)])
        u[i] += weight * q[coordinate];
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n), D = K;
    try
    {
      mechanism::engaged(*placement.element, u.data(), K.data(), D.data());
    }
    catch (const std::invalid_argument &) // a law without a derivative there
    {
      continue;
    }
    if (!K.allFinite() || !(K.norm() > 0.))
      continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(0.5 * (K + K.transpose()));
    const Eigen::VectorXd                                stiffest = directions.eigenvectors().col(n - 1);
    Measure                                              w;
    for (int i = 0; i < n; ++i)
      w = w + stiffest[i] * placement.measures[std::size_t(i)];
    scales.push_back(
        {placement.name, directions.eigenvalues()[n - 1], stiffest.dot(D * stiffest), mass_on(machine, w)});
  }
  return scales;
}

} // namespace gestell::coupling

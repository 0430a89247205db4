#include "coupling/integration/step/virtual_rates.h"

namespace gestell::coupling
{

VirtualRates::VirtualRates(const SecondOrderSystem &system)
{
  const auto     &W    = system.forces().directions();
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.linear().size()), product = unit;
  for (const int i : system.linear().virtual_coordinates())
  {
    Row row{i, 0., 0., {}};
    unit[i] = 1.;
    system.linear().damping_times(unit, product);
    row.b = product[i];
    system.linear().stiffness_times(unit, product);
    row.c   = product[i];
    unit[i] = 0.;
    for (int j = 0; j < W.outerSize(); ++j)
      if (const double weight = W.coeff(i, j); weight != 0.)
        row.measures.emplace_back(j, weight);
    rows_.push_back(std::move(row));
  }
}

void VirtualRates::settle(const Eigen::Ref<const Eigen::VectorXd> &q, Eigen::Ref<Eigen::VectorXd> v,
                          LocalState &local) const
{
  for (const Row &row : rows_)
  {
    double p = -row.c * q[row.coordinate];
    for (const auto &[measure, weight] : row.measures)
      p += weight * local.p[measure];
    const double rate = p / row.b;
    for (const auto &[measure, weight] : row.measures)
      local.v[measure] += weight * (rate - v[row.coordinate]);
    v[row.coordinate] = rate;
  }
}

} // namespace gestell::coupling

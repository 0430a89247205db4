#include "coupling/integration/step/rounding_floors.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
bool is_virtual(const SecondOrderSystem &system, int measure)
{
  const auto &all = system.linear().virtual_coordinates();
  return std::any_of(all.begin(), all.end(),
                     [&](int i) { return system.forces().directions().coeff(i, measure) != 0.; });
}
} // namespace

void allow_for_rounding(const Compliance &S, const Eigen::VectorXd &p, double left, Eigen::VectorXd &scale)
{
  scale = scale.cwiseMax(left * S.magnitudes(p));
}

void allow_for_closing(const SecondOrderSystem &system, const Compliance &S, const std::vector<ForceBlock> &blocks,
                       const Eigen::VectorXd &tangent, double left, Eigen::VectorXd &scale)
{
  double size = 0.;
  for (const ConstraintBlock &joint : system.joints().blocks())
    size = std::max(size, joint.size);
  if (size == 0. || system.linear().virtual_coordinates().empty())
    return;
  const double *first = tangent.data();
  for (const ForceBlock &block : blocks)
  {
    const int                               n = block.n_measures;
    const Eigen::Map<const Eigen::MatrixXd> law(first, n, n);
    for (int i = 0; i < n; ++i)
      if (const int j = block.first_measure + i; is_virtual(system, j))
      {
        const double by_others = law.row(i).cwiseAbs().sum() - std::abs(law(i, i));
        scale[j]               = std::max(scale[j], left * size * std::abs(S.own(j)) * by_others);
      }
    first += n * n;
  }
}

} // namespace gestell::coupling

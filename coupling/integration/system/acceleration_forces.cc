#include "coupling/integration/system/acceleration_forces.h"

#include <stdexcept>

namespace gestell::coupling
{

bool depend_on_accelerations(const SecondOrderSystem &system, const LocalState &at)
{
  Eigen::VectorXd p      = Eigen::VectorXd::Zero(system.forces().directions().cols()),
                  blocks = Eigen::VectorXd::Zero(tangent_size(system.forces().blocks()));
  if (p.size() == 0)
    return false;
  system.forces().tangent_blocks(at, 0., 0., 1., p, blocks);
  return !blocks.isZero(0.);
}

void refuse_acceleration_forces(const SecondOrderSystem &system, const LocalState &at, const std::string &method)
{
  if (depend_on_accelerations(system, at))
    throw std::invalid_argument(method + " does not support forces that depend on accelerations, such as an unbalance; "
                                         "use the method bdf or one of the Newmark family");
}

} // namespace gestell::coupling

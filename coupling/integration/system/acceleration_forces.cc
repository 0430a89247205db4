#include "coupling/integration/system/acceleration_forces.h"

#include <stdexcept>

namespace gestell::coupling
{

void refuse_acceleration_forces(const SecondOrderSystem &system, const LocalState &at, const std::string &method)
{
  Eigen::VectorXd p      = Eigen::VectorXd::Zero(system.forces().directions().cols()),
                  blocks = Eigen::VectorXd::Zero(tangent_size(system.forces().blocks()));
  if (p.size() == 0)
    return;
  system.forces().tangent_blocks(at, 0., 0., 1., p, blocks);
  if (!blocks.isZero(0.))
    throw std::invalid_argument(method + " does not carry accelerations, on which a force depends, such as that of an "
                                         "unbalance; take the method bdf or one of the Newmark family");
}

} // namespace gestell::coupling

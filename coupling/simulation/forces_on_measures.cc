#include "coupling/simulation/forces_on_measures.h"

namespace gestell::coupling
{

void forces_on_measures(const Machine &machine, const LocalState &local, Eigen::VectorXd &p)
{
  p = local.p;
  machine.forces().force(local, p);
}

} // namespace gestell::coupling

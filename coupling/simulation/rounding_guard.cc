#include "coupling/simulation/rounding_guard.h"

#include "coupling/integration/system/state_archive.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

void RoundingGuard::step(const Eigen::VectorXd &q)
{
  if (least_.size() != q.size())
  {
    least_ = most_ = q;
    return;
  }
  least_ = least_.cwiseMin(q);
  most_  = most_.cwiseMax(q);
}

void RoundingGuard::finish(const LinearSystem &system, double exchanged, double at_begin, RunOutcome &outcome) const
{
  Eigen::MatrixXd M, B, C;
  if (least_.size() == 0 || !system.dense_matrices(M, B, C))
    return;
  const Eigen::VectorXd size  = least_.cwiseAbs().cwiseMax(most_.cwiseAbs()),
                        force = std::numeric_limits<double>::epsilon() * (C.cwiseAbs() * size),
                        work  = force.cwiseProduct(most_ - least_);
  // of the exchanged energy, and of the energy at the start: largest work of rounding
  constexpr double share_of_motion = 0.01, share_of_begin = 1e-6;
  if (!(work.sum() > share_of_motion * exchanged && work.sum() > share_of_begin * std::abs(at_begin)))
    return;
  Eigen::Index worst;
  work.maxCoeff(&worst);
  std::ostringstream text;
  text.precision(2);
  text << "forces on " << system.coordinate_name(int(worst)) << " are dominated by rounding: with a stiffness of "
       << C(worst, worst) << " (N/m or N m/rad) and a displacement of " << size[worst]
       << " (m or rad) their accuracy is " << force[worst] << " (N or N m), equivalent to " << work.sum()
       << " J of work, while the motion exchanges " << exchanged
       << " J; replace the stiff connection by a joint, or reduce its stiffness";
  outcome.warn("rounding", system.coordinate_name(int(worst)), text.str());
}

void RoundingGuard::exchange(StateArchive &archive)
{
  archive(least_, most_);
}

} // namespace gestell::coupling

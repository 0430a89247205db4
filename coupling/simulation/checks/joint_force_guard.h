#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"

#include <vector>

namespace gestell::coupling
{

/**
 * Ends a run whose joints carry forces that nothing in the machine could cause: equations of joints that depend on each
 * other are met by forces of any size, which balance each other or act by a lever that is rounding.
 *
 * A multiplier is compared with all other forces of the machine together, their largest sum so far,
 *
 *     |lambda| > 1/sqrt(epsilon) max(L, 1/L) sum( |f_t| + |p| + |m a| + |C q| + |B v| + m epsilon L/h^2 ),
 *
 * N and N m alike: L, the size of the largest joint, makes the one the other.  A linkage that enlarges a force so much
 * is within 1e-8 rad of a dead position, where half of all digits are lost.  The last term is what rounding leaves
 * where a machine does not move.  The sum is formed only where a multiplier exceeds max(L, 1/L) times the largest one
 * so far, which most steps do not.
 *
 * Source: docs/theory/joints.md (4a).
 */
class JointForceGuard : public RunObserver
{
public:
  JointForceGuard(const Machine &machine, const TimeIntegrator &integrator);

  /// Once per step.
  /// @throws ConvergenceFailure with the joint and its force
  void step() override;

  void exchange(StateArchive &archive) override;

private:
  /// A measure that is one coordinate of bodies in joints.
  struct Inertia
  {
    int    measure;
    double mass; ///< [kg or kg m^2] per unit of the measure
  };

  void   find_inertias();
  double known_forces();
  double elastic_forces();

  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  std::vector<int>      of_forces_; ///< measures of elements
  std::vector<Inertia>  inertias_;
  double                size_ = 1., masses_ = 0.; ///< L [m]; their sum
  double                largest_ = 0.;            ///< sum of forces so far
  Eigen::VectorXd       load_, product_;
};

} // namespace gestell::coupling

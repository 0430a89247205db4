#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"

#include <vector>

namespace gestell::coupling
{

/**
 * Ends a run whose joint forces have no physical cause.  Redundant joint equations admit forces of any size that
 * balance each other, or act with a lever that is only a rounding error.
 *
 * A multiplier is compared with all other forces of the machine together, their largest sum so far,
 *
 *     |lambda| > 1/sqrt(epsilon) max(L, 1/L) sum( |f_t| + |p| + |m a| + |C q| + |B v| + m epsilon L/h^2 ),
 *
 * where the size L of the largest joint converts between N and N m.  A linkage that amplifies a force so much is within
 * 1e-8 rad of a dead position, where half of all digits are lost.  The last term is the rounding error in a machine at
 * rest.  The sum is formed only if a multiplier exceeds max(L, 1/L) times the largest sum so far, which is rare.
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
  /// A measure that is a single coordinate of bodies with joints.
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

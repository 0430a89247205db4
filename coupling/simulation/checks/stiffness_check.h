#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/modes/linear_spectrum.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Checks elements whose stiffness grows with the motion (Hertzian contact, cubic spring) against the stability limit of
 * a method with a fixed step: the guard before the run knows only their initial stiffness.
 *
 * With the weights m, b, c < 0 of the motion x (-1)^k (step_weights()) and the stiffness K(u) of these elements the
 * balance A + c h^2 W K(u) W^T, A = m M + b h B + c h^2 C with all others in the stiffest branch of their laws, must
 * stay positive definite:
 *
 *     largest eigenvalue of  -c h^2 K(u) F  below 1,     F = W^T A^-1 W.
 *
 * The trace is an upper bound, which suffices in most steps.  Source: docs/theory/stability.md.
 */
class StiffnessCheck : public RunObserver
{
public:
  /// Not active for other methods, and for machines too large for dense matrices.
  StiffnessCheck(const Machine &machine, const TimeIntegrator &integrator, const InitialState &start,
                 const MethodOptions &options);

  /// Called after every step.
  /// @throws ConvergenceFailure with the element, its stiffness and a step that would be stable
  void step() override;
  void exchange(StateArchive &archive) override;

private:
  struct Watched
  {
    const ElementPlacement *placement;
    int                     first, size; ///< of its measures
    int                     row;         ///< first row in F
  };

  Eigen::MatrixXd   stiffness(const Watched &watched, const Eigen::VectorXd &u) const;
  double            largest(const Eigen::VectorXd &u, std::size_t &most) const;
  double            frequency_at_peak(const Watched &watched, const Eigen::VectorXd &now) const;
  [[noreturn]] void fail(const LocalState &state, double share, const Watched &watched) const;

  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  MethodOptions         options_;
  std::vector<Watched>  watched_;
  Eigen::MatrixXd       F_;         ///< -c h^2 W^T A^-1 W of the watched measures
  Eigen::MatrixXd       lightness_; ///< W^T M^-1 W of these
  LocalState            last_;      ///< after the previous step
};

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Compares the modes of the averaged system, which a machine in modes uses, with those of the instantaneous system,
 *
 *     (C + W K(t) W^T - omega^2 M) v = 0,     K = -dp/du,
 *
 * at several instants of a run, because contacts open and close, and linkages move.  The modes chosen for one system
 * may be too few for the other (5.5.3).
 */
class InstantaneousModes : public RunObserver
{
public:
  /// Only active for machines in modes.
  InstantaneousModes(const Machine &machine, const TimeIntegrator &integrator, double begin, double end);

  void step() override;
  void finish(RunOutcome &outcome) override; ///< no finding if frequencies differ by less than a tenth
  void exchange(StateArchive &archive) override;

private:
  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  Eigen::VectorXd       averaged_; ///< [m] rad/s; empty: not active
  Eigen::MatrixXd       M_, C_;
  double                pace_, next_;
  int                   looks_ = 0, apart_ = 0; ///< number of instants; of those with more than a tenth difference
  int                   mode_ = 0;              ///< mode with the largest difference
  double                t_ = 0., omega_ = 0., difference_ = 0.;
};

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * A machine that is superposed of modes of its averaged system against the system of the moment,
 *
 *     (C + W K(t) W^T - omega^2 M) v = 0,     K = -dp/du,
 *
 * at a number of instants of a run: contacts open and close, linkages move on.  Modes chosen for the one may be too few
 * for the other (5.5.3).
 */
class InstantaneousModes : public RunObserver
{
public:
  /// Looks at nothing but machines in modes.
  InstantaneousModes(const Machine &machine, const TimeIntegrator &integrator, double begin, double end);

  void step() override;
  void finish(RunOutcome &outcome) override; ///< nothing where frequencies stay within a tenth
  void exchange(StateArchive &archive) override;

private:
  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  Eigen::VectorXd       averaged_; ///< [m] rad/s; empty: nothing to do
  Eigen::MatrixXd       M_, C_;
  double                pace_, next_;
  int                   looks_ = 0, apart_ = 0; ///< instants; those more than a tenth away
  int                   mode_ = 0;              ///< that differed most
  double                t_ = 0., omega_ = 0., difference_ = 0.;
};

} // namespace gestell::coupling

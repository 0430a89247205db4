#pragma once

#include "coupling/machine/machine.h"

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

class StateArchive;

/**
 * A machine that is superposed of modes of its averaged system against the system of the moment,
 *
 *     (C + W K(t) W^T - omega^2 M) v = 0,     K = -dp/du,
 *
 * at a number of instants of a run: contacts open and close, linkages move on.  Modes chosen for the one may be too few
 * for the other (5.5.3).
 */
class MomentaryModes
{
public:
  /// Looks at nothing but machines in modes.
  MomentaryModes(const Machine &machine, double begin, double end);

  void step(const LocalState &state);

  /// Empty where frequencies stay within a tenth.
  std::string warning() const;

  void exchange(StateArchive &archive);

private:
  const Machine  &machine_;
  Eigen::VectorXd averaged_; ///< [m] rad/s; empty: nothing to do
  Eigen::MatrixXd M_, C_;
  double          pace_, next_;
  int             looks_ = 0, apart_ = 0; ///< instants; those more than a tenth away
  int             mode_ = 0;              ///< that differed most
  double          t_ = 0., omega_ = 0., difference_ = 0.;
};

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/system/local_forces.h"

namespace gestell::coupling
{

/// Energy and power of the elements.  This one has none.
class EnergyAccount
{
public:
  virtual ~EnergyAccount() = default;

  /// Energy [J] stored in the elements.
  virtual double stored(const LocalState &) const { return 0.; }
  /// Power [W] input by drives, including prescribed motions of joints, and power that all other laws take beyond the
  /// energy they store.  Errors of the integrator are in neither: ideal joints do no work except that of prescribed
  /// motion.
  virtual void power(const LocalState &, const Eigen::VectorXd &, double &input, double &dissipated) const
  {
    input = dissipated = 0.;
  }
};

} // namespace gestell::coupling

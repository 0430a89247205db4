#pragma once

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/energy_account.h"
#include "coupling/integration/system/event_system.h"
#include "coupling/integration/system/ideal_joints.h"
#include "coupling/integration/system/linear_system.h"
#include "coupling/integration/system/local_forces.h"

namespace gestell::coupling
{

/**
 * The machine as seen by every integrator (5.5.2/1), in five parts:
 *
 *     M q'' + B q' + C q = f_t(t) + W p,     u = W^T q,     g(t, u) = 0,     G = dg/du,
 *     p = p(t, u, u', u'', history) of the elements,     p = G^T lambda of the ideal joints.
 *
 * A search for steady states uses only linear() and forces().  The default parts have no joints, no events and no
 * energy account.
 */
class SecondOrderSystem
{
public:
  virtual ~SecondOrderSystem() = default;

  virtual const LinearSystem  &linear() const = 0;
  virtual const LocalForces   &forces() const = 0;
  virtual const IdealJoints   &joints() const;
  virtual const EventSystem   &events() const;
  virtual EventSystem         &events();
  virtual const EnergyAccount &energy() const;
};

} // namespace gestell::coupling

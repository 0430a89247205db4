#pragma once

#include "coupling/integration/system/second_order_system.h"

namespace gestell::coupling
{

/**
 * A second-order system with more damping in its linear base: B + beta C.  A mode of omega [rad/s] gets beta omega/2
 * of critical more; motions without stiffness, such as that of a drive, are not braked.
 */
class RaisedDamping final : public SecondOrderSystem
{
public:
  RaisedDamping(SecondOrderSystem &system, double beta);
  ~RaisedDamping() override;

  const LinearSystem  &linear() const override;
  const LocalForces   &forces() const override { return system_.forces(); }
  const IdealJoints   &joints() const override { return system_.joints(); }
  const EventSystem   &events() const override { return static_cast<const SecondOrderSystem &>(system_).events(); }
  EventSystem         &events() override { return system_.events(); }
  const EnergyAccount &energy() const override { return system_.energy(); }

private:
  class Base;

  SecondOrderSystem    &system_;
  std::unique_ptr<Base> base_;
};

} // namespace gestell::coupling

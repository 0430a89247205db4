#pragma once

namespace gestell::coupling
{

/// Interface of integrators that can control the error of their steps.
class ErrorControl
{
public:
  virtual ~ErrorControl() = default;

  /// False: steps are fixed.
  virtual bool controls_error() const = 0;

  /// Sets the motion predicted from future loads: distance and speed in the energy norm, sqrt(sum m_i x_i^2) [sqrt(kg)
  /// m], [sqrt(kg) m/s].  A motion that is small compared with this needs no relative accuracy of its own.  Valid until
  /// the next begin().
  virtual void expect(double way, double speed) = 0;
};

} // namespace gestell::coupling

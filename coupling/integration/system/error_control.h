#pragma once

namespace gestell::coupling
{

/// What integrators have besides that can control the error of their steps.
class ErrorControl
{
public:
  virtual ~ErrorControl() = default;

  /// False: steps are fixed.
  virtual bool controls_error() const = 0;

  /// Loads to come would lead so far and make so fast a motion, in the norm of the energy, sqrt(sum m_i x_i^2)
  /// [sqrt(kg) m], [sqrt(kg) m/s]: a motion that is small beside that need not be exact against itself.  Holds up to
  /// the next begin().
  virtual void expect(double way, double speed) = 0;
};

} // namespace gestell::coupling

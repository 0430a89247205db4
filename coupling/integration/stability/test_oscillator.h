#pragma once

namespace gestell::coupling
{

/// Whose spring makes the test oscillator vibrate.  It matters for exact propagation only, which carries the base
/// system exactly and interpolates the forces of elements.
enum class Spring
{
  base,   ///< of the linear base system
  contact ///< of an element that is closed: the base system is a free mass
};

/// A method with a fixed step on the test oscillator  x'' + 2 zeta omega x' + omega^2 x = 0.
struct TestOscillator
{
  double zeta;    ///< >= 0
  double omega_h; ///< > 0
  Spring spring = Spring::base;
};

/// The first steps of a method that has no past yet.
enum class FirstSteps
{
  as_integrated, ///< as the integrator begins: BDF with chains of implicit Euler steps
  order_ramp     ///< orders 1, 2, ... p, as tables of the literature have it
};

} // namespace gestell::coupling

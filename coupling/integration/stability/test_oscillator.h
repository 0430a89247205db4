#pragma once

namespace gestell::coupling
{

/// Origin of the test oscillator's stiffness.  It matters only for exact propagation, which propagates the base system
/// exactly and interpolates the forces of elements.
enum class Spring
{
  base,   ///< of the linear base system
  contact ///< of a closed element: the base system is a free mass
};

/// A method with a fixed step on the test oscillator  x'' + 2 zeta omega x' + omega^2 x = 0.
struct TestOscillator
{
  double zeta;    ///< >= 0
  double omega_h; ///< > 0
  Spring spring = Spring::base;
};

/// The first steps of a method without past points.
enum class FirstSteps
{
  as_integrated, ///< as the integrator starts: BDF with chains of implicit Euler steps
  order_ramp     ///< orders 1, 2, ... p, as in tables of the literature
};

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/stability/test_oscillator.h"

namespace gestell::coupling
{

/// Largest |x| / x_0 or, for a start with velocity, |x| omega / v_0, and largest |x'| / omega likewise.
struct Overshoot
{
  double displacement, velocity;
  int    displacement_step, velocity_step; ///< where they occur
};

enum class OscillatorStart
{
  displaced, ///< x = 1, x' = 0
  moving     ///< x = 0, x' = omega
};

/// In the first 20 steps, from consistent accelerations.
Overshoot overshoot(const MethodOptions &options, const TestOscillator &oscillator, OscillatorStart start,
                    FirstSteps first_steps = FirstSteps::as_integrated);

} // namespace gestell::coupling
